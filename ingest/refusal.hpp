#pragma once

#include <string>
#include <string_view>

#include "geo/result.hpp"

namespace relevo::ingest {

/// An input that cannot be used: which file, what is wrong, what to do.
inline Error refusal(std::string_view file, std::string_view problem, std::string_view remedy) {
    std::string message{file};
    message.append(": ").append(problem);
    if (!remedy.empty()) message.append(". ").append(remedy);
    return {ErrorKind::input, std::move(message)};
}

}  // namespace relevo::ingest
