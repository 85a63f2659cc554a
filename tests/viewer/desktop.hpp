#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "viewer/picture.hpp"

namespace relevo::test {

/// An X display in memory on a free number, and the one program that a test runs on it. All ends with it.
class Desktop {
  public:
    Desktop() = default;
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;
    ~Desktop() {
        for (const pid_t process : {program_, server_}) {
            if (process <= 0) continue;
            kill(process, SIGTERM);
            waitpid(process, nullptr, 0);
        }
    }

    bool start() {
        int ends[2];
        if (pipe(ends) != 0) return false;
        server_ = fork();
        if (server_ == 0) {
            close(ends[0]);
            const int nowhere = open("/dev/null", O_WRONLY);
            dup2(nowhere, 1);
            dup2(nowhere, 2);
            const std::string write_end = std::to_string(ends[1]);
            execlp("Xvfb", "Xvfb", "-displayfd", write_end.c_str(), "-screen", "0", "1000x800x24",
                   "-nolisten", "tcp", nullptr);
            _exit(127);
        }
        close(ends[1]);
        // The server says its number when it is ready, or closes the pipe when it fails.
        char letter = 0;
        while (read(ends[0], &letter, 1) == 1 && letter != '\n') number_ += letter;
        close(ends[0]);
        return !number_.empty();
    }

    pid_t run(std::vector<std::string> words, const std::string& flags, const std::filesystem::path& out,
              const std::filesystem::path& err) {
        std::istringstream more(flags);
        for (std::string word; more >> word;) words.push_back(word);
        program_ = fork();
        if (program_ == 0) {
            setenv("DISPLAY", (":" + number_).c_str(), 1);
            unsetenv("WAYLAND_DISPLAY");
            setenv("XDG_CONFIG_HOME", out.parent_path().c_str(), 1);  // the user's own settings stay
            dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 1);
            dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 2);
            std::vector<char*> arguments;
            for (std::string& word : words) arguments.push_back(word.data());
            arguments.push_back(nullptr);
            execv(arguments[0], arguments.data());
            _exit(127);
        }
        return program_;
    }

    /// As programs are told of it: ":7".
    std::string display() const { return ":" + number_; }

    int xdotool(const std::string& what) const {
        return std::system(
            fmt::format("DISPLAY=:{} timeout 30 xdotool {} >/dev/null 2>&1", number_, what).c_str());
    }

    /// Waits for the window, and then for the first frames in it: keys pressed before that could be lost.
    bool wait_for_window() const {
        if (xdotool("search --sync --onlyvisible --name Relevo windowfocus --sync") != 0) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        return true;
    }

    /// The exit status within 30 seconds; -1 where it was killed or is still there.
    int wait_for_exit(pid_t process) {
        for (int i = 0; i < 300; ++i) {
            int status = 0;
            if (waitpid(process, &status, WNOHANG) == process) {
                if (process == program_) program_ = 0;
                return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return -1;
    }

  private:
    pid_t server_ = 0;
    pid_t program_ = 0;
    std::string number_;
};

/// Reads a picture by another program than ours; empty where there is none that can.
inline viewer::Picture read_ppm(const std::filesystem::path& file, const std::filesystem::path& by_way_of) {
    const std::string line = fmt::format(
        "gdal_translate -q -of PNM -b 1 -b 2 -b 3 '{0}' '{1}' 2>/dev/null || "
        "convert '{0}' ppm:'{1}' 2>/dev/null",
        file.string(), by_way_of.string());
    if (std::system(line.c_str()) != 0) return {};
    std::ifstream stream(by_way_of, std::ios::binary);
    std::string magic;
    int width = 0;
    int height = 0;
    int most = 0;
    stream >> magic >> width >> height >> most;
    stream.get();
    if (magic != "P6" || most != 255) return {};
    viewer::Picture picture(width, height);
    stream.read(reinterpret_cast<char*>(picture.rgb.data()),
                static_cast<std::streamsize>(picture.rgb.size()));
    return picture;
}

}  // namespace relevo::test
