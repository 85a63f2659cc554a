#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace relevo::test {

/// A real elevation file of the developers' data folder, which users do not have: tests that need it skip.
inline std::filesystem::path shared_data(const std::string& name) {
    return std::filesystem::path(RELEVO_SHARED_DATA) / name;
}

}  // namespace relevo::test

/// Skips the test where the developers' data folder is absent.
#define RELEVO_NEEDS_DATA(name)                                    \
    if (!std::filesystem::exists(relevo::test::shared_data(name))) \
    GTEST_SKIP() << "no " << name << " in the developers' data folder"
