#pragma once

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relevo::test {

/// What a run of the program left behind.
struct Run {
    int status = -1;
    std::string out;
    std::string err;
};

/// Runs `relevo` with arguments as one writes them in a shell; `before` may set variables of the environment.
inline Run relevo(const std::string& arguments, const std::string& before = "") {
    static std::atomic<int> count = 0;
    const auto base =
        std::filesystem::temp_directory_path() / fmt::format("relevo-run-{}-{}", getpid(), count++);
    const std::string out = base.string() + ".out";
    const std::string err = base.string() + ".err";
    const std::string line =
        fmt::format("{} '{}' {} >'{}' 2>'{}' </dev/null", before, RELEVO_PROGRAM, arguments, out, err);
    Run run;
    const int status = std::system(line.c_str());
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    const auto take = [](const std::string& file) {
        std::ifstream stream(file, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        std::filesystem::remove(file);
        return text;
    };
    run.out = take(out);
    run.err = take(err);
    return run;
}

}  // namespace relevo::test
