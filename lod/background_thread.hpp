#pragma once

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace relevo::lod {

/// Lets a thread that reads ahead stand back behind those that draw. (On Linux a thread has its own priority;
/// elsewhere nothing is done.)
inline void stand_back() {
#ifdef __linux__
    constexpr int kBehind = 10;
    setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kBehind);
#endif
}

}  // namespace relevo::lod
