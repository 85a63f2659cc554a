#include "viewer/ui/background_import.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace relevo::viewer {
namespace {

using Path = std::filesystem::path;

Result<Path> result_of(const BackgroundImport& import) {
    for (int i = 0; i < 1000; ++i) {
        if (auto result = import.result()) return *std::move(result);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return Error{ErrorKind::internal, "never over"};
}

TEST(BackgroundImport, TellsHowFarItIsAndWhatCameOfIt) {
    std::atomic<bool> go_on = false;
    const BackgroundImport import("hill.tif", [&](const Path& file, const auto& progress) -> Result<Path> {
        progress(0.25);
        while (!go_on) std::this_thread::yield();
        return Path(file.stem().string() + ".relevo");
    });
    while (import.progress() == 0) std::this_thread::yield();
    EXPECT_EQ(import.progress(), 0.25);
    EXPECT_FALSE(import.result());
    go_on = true;
    const auto result = result_of(import);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(*result, "hill.relevo");
}

Result<Path> until_stopped(const Path&, const std::function<bool(double)>& progress) {
    while (progress(0.5)) std::this_thread::yield();
    return Error{ErrorKind::internal, "interrupted"};
}

TEST(BackgroundImport, IsStoppedByItsUserAndByItsEnd) {
    BackgroundImport import("hill.tif", until_stopped);
    import.cancel();
    const auto result = result_of(import);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "interrupted");
    BackgroundImport("hill.tif", until_stopped);  // comes back
}

TEST(BackgroundImport, ThatThrowsIsAnError) {
    const BackgroundImport import("hill.tif", [](const Path&, const auto&) -> Result<Path> {
        throw std::runtime_error("no memory for it");
    });
    const auto result = result_of(import);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "hill.tif: no memory for it");
}

}  // namespace
}  // namespace relevo::viewer
