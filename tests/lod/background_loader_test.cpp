#include "lod/background_loader.hpp"

#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace relevo::lod {
namespace {

TEST(BackgroundLoader, LoadsTheMostUrgentFirstAndForgetsWhatIsNotAskedForAnyMore) {
    std::mutex gate;
    std::vector<char> loaded;
    gate.lock();
    BackgroundLoader<char, int> loader(
        [&](char key) -> Result<int> {
            const std::lock_guard lock(gate);
            loaded.push_back(key);
            return static_cast<int>(key);
        },
        1);
    EXPECT_FALSE(loader.wait()) << "nothing was asked for";
    loader.request({'a'});
    while (loader.is_waiting('a')) std::this_thread::yield();
    loader.request({'a', 'b', 'c'});  // a is begun
    loader.request({'c', 'a'});
    gate.unlock();
    EXPECT_EQ(loader.wait()->key, 'a');
    EXPECT_EQ(loader.wait()->key, 'c');
    EXPECT_FALSE(loader.wait());
    EXPECT_EQ(loaded, (std::vector<char>{'a', 'c'}));
}

}  // namespace
}  // namespace relevo::lod
