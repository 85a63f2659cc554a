#include "viewer/bench/machine.hpp"

#include <cstdlib>
#include <fstream>
#include <thread>

#include <sys/utsname.h>
#include <unistd.h>

namespace relevo::viewer {

Machine describe_machine() {
    Machine machine;
    machine.cores = std::thread::hardware_concurrency();
    std::ifstream cpus("/proc/cpuinfo");
    for (std::string line; std::getline(cpus, line);) {
        if (line.compare(0, 10, "model name") != 0) continue;
        const std::size_t colon = line.find(": ");
        if (colon != std::string::npos) machine.cpu = line.substr(colon + 2);
        break;
    }
    machine.memory_mib = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024);
    utsname names{};
    if (uname(&names) == 0)
        machine.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
    if (getloadavg(&machine.load_average, 1) != 1) machine.load_average = 0;
    return machine;
}

double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    double total = 0;
    double resident = 0;
    statm >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024);
}

}  // namespace relevo::viewer
