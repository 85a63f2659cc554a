#pragma once

#include <chrono>
#include <cstdlib>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/viewer/desktop.hpp"
#include "tests/viewer/scene_for_pictures.hpp"

namespace relevo::test {

/// The window for real: a display of its own, keys and mouse by xdotool, what it wrote and what it shows.
class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* tool : {"Xvfb", "xdotool"}) {
            if (std::system(fmt::format("command -v {} >/dev/null", tool).c_str()) != 0) {
                GTEST_SKIP() << tool << " is not installed";
            }
        }
        scene_ = (folder_ / "mountains.relevo").string();
        write_mountains(scene_);
        ASSERT_TRUE(desktop_.start()) << "Xvfb does not start";
    }

    void start(const std::string& flags) { start({scene_}, flags); }
    /// \param what  scenes or elevation files
    void start(const std::vector<std::string>& what, const std::string& flags) {
        std::vector<std::string> words{RELEVO_PROGRAM, "view"};
        words.insert(words.end(), what.begin(), what.end());
        for (const char* word : {"--size", "800x600", "--screenshot-dir"}) words.emplace_back(word);
        words.push_back(folder_.path().string());
        program_ = desktop_.run(words, flags, folder_ / "out", folder_ / "err");
    }

    /// Opens the window, and waits until it has shown its first frames.
    void open(const std::string& flags) {
        start(flags);
        ASSERT_TRUE(desktop_.wait_for_window()) << contents(folder_ / "err");
    }

    /// Waits until the program has said something that matches, up to 20 seconds; the first group of the
    /// match.
    std::string said(const std::string& pattern) {
        std::smatch match;
        for (int i = 0; i < 200; ++i) {
            text_ = contents(folder_ / "out") + contents(folder_ / "err");
            if (std::regex_search(text_, match, std::regex(pattern))) return match.str(match.size() - 1);
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        ADD_FAILURE() << "nothing like " << pattern << " in:\n" << text_;
        return {};
    }

    void close() {
        press("ctrl+q");
        EXPECT_EQ(desktop_.wait_for_exit(program_), 0) << contents(folder_ / "err");
    }

    void point_at(int x, int y) { desktop_.xdotool(fmt::format("mousemove {} {}", x, y)); }
    void press(const std::string& keys) { desktop_.xdotool("key " + keys); }

    SceneFolder folder_;
    std::string scene_;
    Desktop desktop_;
    std::string text_;
    pid_t program_ = 0;
};

}  // namespace relevo::test
