#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

namespace relevo::test {

/// A folder of its own for one test, gone with it.
class ScratchFolder {
  public:
    explicit ScratchFolder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() / fmt::format("relevo-{}-{}", name, getpid())) {
        std::filesystem::create_directories(path_);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

/// The lines that another program answers to lines of input; empty where it is not installed. Truth by
/// another way.
inline std::vector<std::string> ask(const std::string& command, const std::vector<std::string>& input) {
    const ScratchFolder scratch("ask");
    const auto in = scratch / "in.txt";
    const auto out = scratch / "out.txt";
    {
        std::ofstream file(in);
        for (const std::string& line : input) file << line << '\n';
    }
    const std::string whole = fmt::format("{} < '{}' > '{}' 2>/dev/null", command, in.string(), out.string());
    if (std::system(whole.c_str()) != 0) return {};
    std::vector<std::string> lines;
    std::ifstream file(out);
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// The numbers of a line.
inline std::vector<double> numbers(const std::string& line) {
    std::istringstream in(line);
    in.imbue(std::locale::classic());
    std::vector<double> found;
    for (double value = 0; in >> value;) found.push_back(value);
    return found;
}

}  // namespace relevo::test
