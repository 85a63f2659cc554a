#pragma once

#include <ostream>

namespace relevo::test {

/// A file of the developers' data folder.
struct RealDem {
    const char* name;
    const char* file;
    const char* crs;  // where the file does not say
};

inline void PrintTo(const RealDem& dem, std::ostream* out) {
    *out << dem.file;
}

}  // namespace relevo::test
