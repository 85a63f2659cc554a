#pragma once

#include <string>

namespace relevo::viewer {

/// What figures were measured on. Unknown numbers are 0, unknown texts empty.
struct Machine {
    std::string cpu;
    unsigned cores = 0;  ///< that may run at a time
    double memory_mib = 0;
    std::string system;       ///< kernel and architecture
    double load_average = 0;  ///< of the last minute: others at work make frames slow
    std::string gl_renderer;
};

/// Of this machine now, but for OpenGL.
Machine describe_machine();

/// Memory of this process that is in RAM now, MiB.
double resident_mib();

}  // namespace relevo::viewer
