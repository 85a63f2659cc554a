#include "app/command.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <unistd.h>

namespace relevo::app {

void add_common(CLI::App& command, Common& common) {
    command.add_flag("--json", common.json, "Print the result as one JSON object");
    command.add_flag("--quiet", common.quiet, "No progress and no notes on stderr");
}

std::function<void(double)> progress_bar(const Common& common, std::string what) {
    if (common.quiet || isatty(STDERR_FILENO) == 0) return [](double) {};
    auto shown = std::make_shared<int>(-1);
    return [what = std::move(what), shown](double done) {
        const int percent = static_cast<int>(std::floor(100 * done));
        if (percent == *shown) return;
        *shown = percent;
        fmt::print(stderr, "\r{} {:3d} %{}", what, percent, percent >= 100 ? "\n" : "");
        std::fflush(stderr);
    };
}

}  // namespace relevo::app
