#include "lod/machine_figures.hpp"

#include <gtest/gtest.h>

#include "tests/lod/scratch_scene.hpp"

namespace relevo::test {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

/// A made-up /proc and /sys of a machine of 16 GiB, of which 8 are available.
class MachineFigures : public testing::Test {
  protected:
    MachineFigures() {
        put("proc/meminfo", "MemTotal:       16777216 kB\nMemFree:  1 kB\nMemAvailable:    8388608 kB\n");
    }
    void put(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((folder_ / file).parent_path());
        replace(folder_ / file, text);
    }
    lod::MachineFigures found() const { return lod::find_memory(folder_.path()); }

    SceneFolder folder_;
};

TEST_F(MachineFigures, MemoryIsThatOfTheMachine) {
    EXPECT_EQ(found().memory_total, 16384 * kMiB);
    EXPECT_EQ(found().memory_available, 8192 * kMiB);
    EXPECT_GE(found().cores, 1U);
    EXPECT_FALSE(found().read_mib_s);
}

// Docker, Podman and Kubernetes: the container sees its own group as the root.
TEST_F(MachineFigures, AContainersLimitBinds) {
    put("proc/self/cgroup", "0::/\n");
    put("sys/fs/cgroup/memory.max", "2147483648\n");
    put("sys/fs/cgroup/memory.current", "1073741824\n");
    put("sys/fs/cgroup/memory.stat", "anon 536870912\nfile 1\ninactive_file 536870912\n");
    EXPECT_EQ(found().memory_total, 2048 * kMiB);
    EXPECT_EQ(found().memory_available, 1536 * kMiB);  // files not used lately make room
    put("sys/fs/cgroup/memory.current", "9073741824\n");
    EXPECT_EQ(found().memory_available, 0U);
    put("sys/fs/cgroup/memory.max", "max\n");
    EXPECT_EQ(found().memory_available, 8192 * kMiB);
}

TEST_F(MachineFigures, SoDoesThatOfAGroupAroundTheOwnOne) {
    put("proc/self/cgroup", "12:cpu:/old\n0::/user.slice/job.scope\n");
    put("sys/fs/cgroup/user.slice/memory.max", "1073741824");
    put("sys/fs/cgroup/user.slice/job.scope/memory.max", "max");
    EXPECT_EQ(found().memory_total, 1024 * kMiB);
    put("sys/fs/cgroup/user.slice/job.scope/memory.max", "536870912");
    EXPECT_EQ(found().memory_total, 512 * kMiB);
}

TEST(ReadingRate, CountsWhatWasReadOrSaysThatItWasInMemory) {
    const SceneFolder folder;
    replace(folder / "block.bin", std::string(8 * kMiB, 'x'));
    const auto machine = lod::find_machine(folder.path());
    EXPECT_GE(machine.cached_part, 0);
    EXPECT_LE(machine.cached_part, 1);
    if (machine.read_mib_s) {
        EXPECT_GT(*machine.read_mib_s, 0.1);
    } else {
        EXPECT_GT(machine.cached_part, 0);  // just written
    }
    EXPECT_GT(machine.memory_available, kMiB);
}

TEST(ReadingRate, IsUnknownOfSmallFilesAndOfNone) {
    const SceneFolder folder;
    replace(folder / "small", "x");
    EXPECT_FALSE(lod::find_machine(folder.path()).read_mib_s);
    EXPECT_FALSE(lod::find_machine(folder / "none").read_mib_s);
    EXPECT_EQ(lod::find_machine(folder / "none").cached_part, 0);
}

}  // namespace
}  // namespace relevo::test
