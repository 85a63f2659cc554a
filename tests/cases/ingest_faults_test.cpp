// Hard case 6 while a scene is being written: killed, interrupted, no room, a second writer, a source that
// goes away. In each the scene that was there stays as it was, the message says what happened, and --resume
// gives the bytes of an import that nothing happened to. tests/bench/kill_resume.sh does the same with
// hundreds of kills and real data.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ingest/job.hpp"
#include "tests/ingest/importing.hpp"

namespace relevo {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::SceneFolder;
using test::SyntheticRaster;
using Clock = std::chrono::steady_clock;

/// `relevo` with arguments, running; killed at the latest when this goes.
class Running {
  public:
    /// \param prepare  called in the new process before the program is in it
    explicit Running(
        std::vector<std::string> arguments, const std::function<void()>& prepare = [] {}) {
        static int count = 0;
        messages_ = fs::temp_directory_path() / fmt::format("relevo-running-{}-{}", getpid(), count++);
        arguments.insert(arguments.begin(), RELEVO_PROGRAM);
        std::vector<char*> words;
        for (std::string& word : arguments) words.push_back(word.data());
        words.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
            dup2(open(messages_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
            prepare();
            execv(RELEVO_PROGRAM, words.data());
            _exit(127);
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() {
        if (process_ > 0) {
            signal(SIGKILL);
            wait();
        }
        std::error_code ignored;
        fs::remove(messages_, ignored);
    }

    void signal(int number) const { ::kill(process_, number); }

    /// Its exit status, or 128 and the number of the signal that ended it.
    int wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    /// As wait(), or -1 where that takes longer: then it is killed.
    int wait_for(std::chrono::seconds longest) {
        for (const auto end = Clock::now() + longest; Clock::now() < end; std::this_thread::sleep_for(5ms)) {
            siginfo_t info{};
            waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
            if (info.si_pid == process_) return wait();
        }
        signal(SIGKILL);
        wait();
        return -1;
    }

    std::string messages() const { return test::contents(messages_); }

  private:
    pid_t process_ = 0;
    fs::path messages_;
};

class IngestFaults : public testing::Test {
  protected:
    void SetUp() override {
        SyntheticRaster raster;
        raster.columns = 600;
        raster.rows = 540;
        raster.geotransform = {10, 0.001, 0, 50, 0, -0.001};
        raster.nodata = -999;
        raster.value = [](int c, int r) {
            if (c < 150) return 0.0;                       // the sea
            if (c % 97 == 0 && r % 3 == 0) return -999.0;  // voids to fill
            const auto mixed = static_cast<std::uint32_t>(c * 7919 + r * 104729) * 2654435761U;
            return 1.0 + (mixed >> 16U) % 1000;  // nothing that compresses well
        };
        file_ = raster.write(sources_ / "a.tif");
        old_file_ = SyntheticRaster{}.write(sources_ / "old.tif");
        good_ = import_to(sources_ / "good.relevo", {}, file_);
        old_ = import_to(sources_ / "old.relevo", {}, old_file_);
        ASSERT_FALSE(HasFailure());
    }

    std::vector<std::string> command(const fs::path& scene, const std::vector<std::string>& flags,
                                     const fs::path& file) const {
        std::vector<std::string> words{"ingest", file, "--fill", "3", "--sea", "auto", "-o", scene};
        words.insert(words.end(), flags.begin(), flags.end());
        return words;
    }

    std::map<std::string, std::string> import_to(const fs::path& scene, const std::vector<std::string>& flags,
                                                 const fs::path& file) const {
        Running import(command(scene, flags, file));
        EXPECT_EQ(import.wait(), 0) << import.messages();
        return test::all_files(scene);
    }

    void put_old_scene(const fs::path& place) const {
        fs::remove_all(place);
        fs::copy(sources_ / "old.relevo", place, fs::copy_options::recursive);
    }

    /// Starts an import over the old scene and stops it when it has begun to write.
    /// \param job  what must be in its note of what it makes
    std::unique_ptr<Running> stopped_in_the_middle(const fs::path& place, const std::string& job = "") const {
        put_old_scene(place);
        auto import = std::make_unique<Running>(command(place, {"--overwrite"}, file_));
        const auto begun = [&] {
            for (const auto& entry : fs::directory_iterator(place.parent_path()))
                if (entry.path().filename().string().starts_with(".a.relevo.partial-") &&
                    fs::exists(entry.path() / "raw-heights.journal") &&
                    test::says(test::contents(entry.path() / "job"), {job.c_str()}))
                    return true;
            return false;
        };
        for (const auto end = Clock::now() + 60s; !begun() && Clock::now() < end;)
            std::this_thread::sleep_for(1ms);
        import->signal(SIGSTOP);
        EXPECT_TRUE(begun()) << import->messages();
        return import;
    }

    /// Is there nothing in the folder but a whole scene?
    static void expect_alone(const fs::path& place) {
        for (const auto& entry : fs::directory_iterator(place.parent_path()))
            EXPECT_EQ(entry.path(), place) << "left behind";
    }

    SceneFolder sources_;
    fs::path place_ = sources_ / "place" / "a.relevo";
    fs::path file_;
    fs::path old_file_;
    std::map<std::string, std::string> good_;
    std::map<std::string, std::string> old_;
};

// EXPECT_TRUE(a == b) on scenes: a failure of EXPECT_EQ would print megabytes.

TEST_F(IngestFaults, KilledAnywhereAndResumed) {
    fs::create_directories(place_.parent_path());
    const auto start = Clock::now();
    import_to(place_, {}, file_);
    const auto uninterrupted = Clock::now() - start;
    fs::remove_all(place_);
    constexpr int kKills = 8;
    int killed = 0;
    const auto kill_after = [&](double part, const std::vector<std::string>& flags) {
        Running import(command(place_, flags, file_));
        std::this_thread::sleep_for(part * uninterrupted);
        import.signal(SIGKILL);
        const int status = import.wait();
        EXPECT_TRUE(status == 0 || status == 128 + SIGKILL) << import.messages();
        if (status != 0) ++killed;
        return status != 0;
    };
    for (int i = 0; i < kKills; ++i) {
        SCOPED_TRACE(i);
        const bool over = i % 2 == 1;
        fs::remove_all(place_);
        if (over) put_old_scene(place_);
        std::vector<std::string> flags;
        if (over) flags.emplace_back("--overwrite");
        const auto untouched = [&] { return over ? test::all_files(place_) == old_ : !fs::exists(place_); };
        // Killed after its last step, the scene is there.
        const auto whole = [&] { return fs::exists(place_) && test::all_files(place_) == good_; };

        kill_after((i + 0.5) / kKills, flags);
        EXPECT_TRUE(untouched() || whole());
        flags.emplace_back("--resume");
        if (i % 3 == 2 && !whole()) {
            kill_after(0.4, flags);
            EXPECT_TRUE(untouched() || whole());
        }
        if (!whole()) import_to(place_, flags, file_);
        EXPECT_TRUE(whole());
    }
    EXPECT_GT(killed, 0);
    RecordProperty("killed", killed);
}

TEST_F(IngestFaults, InterruptedItSaysHowToGoOn) {
    fs::create_directories(place_.parent_path());
    for (const int number : {SIGINT, SIGTERM}) {
        SCOPED_TRACE(number);
        const auto import = stopped_in_the_middle(place_);
        import->signal(number);
        import->signal(SIGCONT);
        EXPECT_EQ(import->wait(), 1);
        EXPECT_TRUE(test::says(import->messages(), {"interrupted", "--resume"}));
        EXPECT_TRUE(test::all_files(place_) == old_);
        EXPECT_TRUE(import_to(place_, {"--overwrite", "--resume"}, file_) == good_);
        expect_alone(place_);
    }
}

// A post at the end shows that whole numbers do not fit int16: the import begins anew, once.
TEST_F(IngestFaults, WiderThanInt16IsFoundOnce) {
    SyntheticRaster raster;
    raster.type = GDT_Int32;
    raster.columns = raster.rows = 1200;
    raster.geotransform = {10, 0.001, 0, 50, 0, -0.001};
    raster.value = [](int c, int r) { return c == 1199 && r == 1199 ? 40000.0 : (c * 31 + r * 17) % 1000; };
    file_ = raster.write(sources_ / "wide.tif");
    const auto good = import_to(sources_ / "wide.relevo", {}, file_);
    fs::create_directories(place_.parent_path());
    const auto import = stopped_in_the_middle(place_, "float32");
    import->signal(SIGINT);
    import->signal(SIGCONT);
    ASSERT_EQ(import->wait(), 1) << import->messages();
    Running again(command(place_, {"--overwrite", "--resume"}, file_));
    EXPECT_EQ(again.wait(), 0);
    EXPECT_FALSE(test::says(again.messages(), {"begun anew"})) << again.messages();
    EXPECT_TRUE(test::all_files(place_) == good);
}

TEST_F(IngestFaults, ASecondWriterIsRefused) {
    fs::create_directories(place_.parent_path());
    const auto first = stopped_in_the_middle(place_);
    const std::vector<std::vector<std::string>> others{{"--overwrite"}, {"--overwrite", "--resume"}};
    for (const auto& flags : others) {
        Running second(command(place_, flags, file_));
        EXPECT_EQ(second.wait(), 1);
        EXPECT_TRUE(test::says(second.messages(), {"another Relevo is writing", "a.relevo"}));
    }
    first->signal(SIGCONT);
    EXPECT_EQ(first->wait(), 0) << first->messages();
    EXPECT_TRUE(test::all_files(place_) == good_);
    expect_alone(place_);
}

/// A file system of its own, of a given size.
class SmallDisk {
  public:
    SmallDisk(fs::path folder, const char* size) : folder_(std::move(folder)) {
        fs::create_directories(folder_);
        mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, size) == 0;
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
    }
    bool mounted() const { return mounted_; }
    bool resize(const char* size) const {
        return mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, size) == 0;
    }

  private:
    fs::path folder_;
    bool mounted_ = false;
};

TEST_F(IngestFaults, DiskFull) {
    const SmallDisk disk(place_.parent_path(), "size=64m");
    if (!disk.mounted()) GTEST_SKIP() << "a small file system cannot be mounted here: that needs root";
    int full = 0;
    for (const int size : {100, 200, 300, 400, 600, 800}) {
        SCOPED_TRACE(size);
        put_old_scene(place_);
        ASSERT_TRUE(disk.resize(fmt::format("size={}k", size).c_str()));
        Running import(command(place_, {"--overwrite"}, file_));
        if (import.wait() == 0) {
            EXPECT_TRUE(test::all_files(place_) == good_);
            continue;
        }
        ++full;
        EXPECT_TRUE(test::says(import.messages(), {"cannot write", "place/", "No space left", "--resume"}));
        EXPECT_TRUE(test::all_files(place_) == old_);
        ASSERT_TRUE(disk.resize("size=64m"));
        EXPECT_TRUE(import_to(place_, {"--overwrite", "--resume"}, file_) == good_);
        expect_alone(place_);
    }
    EXPECT_GE(full, 2);
    RecordProperty("full", full);
}

TEST_F(IngestFaults, NoRoomToBegin) {
    const SmallDisk disk(place_.parent_path(), "size=64m");
    if (!disk.mounted()) GTEST_SKIP() << "a small file system cannot be mounted here: that needs root";
    put_old_scene(place_);
    ASSERT_TRUE(disk.resize("size=1m"));
    const fs::path filler = place_.parent_path() / "filler";
    test::replace(filler, std::string(2 << 20, 'x'));  // as much of it as there is room for
    Running import(command(place_, {"--overwrite"}, file_));
    EXPECT_EQ(import.wait(), 1);
    EXPECT_TRUE(test::says(import.messages(), {"cannot write", "place/", "No space left"}));
    EXPECT_TRUE(test::all_files(place_) == old_);
    fs::remove(filler);
    expect_alone(place_);
}

// The limit's signal, SIGXFSZ, once ended the program without a word.
TEST_F(IngestFaults, FilesMayNotBeLarge) {
    fs::create_directories(place_.parent_path());
    put_old_scene(place_);
    Running import(command(place_, {"--overwrite"}, file_), [] {
        const rlimit limit{20000, 20000};
        setrlimit(RLIMIT_FSIZE, &limit);
    });
    EXPECT_EQ(import.wait(), 1);
    EXPECT_TRUE(test::says(import.messages(), {"cannot write", "place/", "File too large", "--resume"}));
    EXPECT_TRUE(test::all_files(place_) == old_);
    EXPECT_TRUE(import_to(place_, {"--overwrite", "--resume"}, file_) == good_);
    expect_alone(place_);
}

// Where all was read already, the import once went well, with the checksum of the damaged file in the scene.
TEST_F(IngestFaults, ASourceCutShortWhileItIsRead) {
    fs::create_directories(place_.parent_path());
    const auto import = stopped_in_the_middle(place_);
    fs::resize_file(file_, fs::file_size(file_) / 10);
    import->signal(SIGCONT);
    EXPECT_EQ(import->wait(), 3) << import->messages();
    EXPECT_TRUE(test::says(import->messages(), {"a.tif"}));
    EXPECT_TRUE(test::all_files(place_) == old_);
}

TEST_F(IngestFaults, ASourceThatVanishesWhileItIsReadAndComesBack) {
    fs::create_directories(place_.parent_path());
    const auto import = stopped_in_the_middle(place_);
    const fs::path elsewhere = sources_ / "elsewhere.tif";
    fs::rename(file_, elsewhere);
    import->signal(SIGCONT);
    // What is open stays readable; but its checksum is of the file that has the name.
    EXPECT_EQ(import->wait(), 3) << import->messages();
    EXPECT_TRUE(test::says(import->messages(), {"a.tif", "--resume"}));
    EXPECT_TRUE(test::all_files(place_) == old_);
    fs::rename(elsewhere, file_);
    EXPECT_TRUE(import_to(place_, {"--overwrite", "--resume"}, file_) == good_);
    expect_alone(place_);
}

TEST_F(IngestFaults, APipeIsNotWaitedFor) {
    fs::create_directories(place_.parent_path());
    put_old_scene(place_);
    ASSERT_EQ(mkfifo((sources_ / "pipe.tif").c_str(), 0666), 0);
    Running import(command(place_, {"--overwrite"}, sources_ / "pipe.tif"));
    EXPECT_EQ(import.wait_for(20s), 3);
    EXPECT_TRUE(test::says(import.messages(), {"pipe.tif"}));
    EXPECT_TRUE(test::all_files(place_) == old_);
    expect_alone(place_);
}

// Once --resume went on with the posts of another band, and with those of a VRT's source as it was before.
TEST_F(IngestFaults, AnotherJobIsNotResumed) {
    const auto text = [&](const std::function<void(ingest::SourceRequest&)>& change) {
        auto options = test::options_for(file_);
        change(options.mosaic.sources[0]);
        return ingest::job_text(options, ingest::states_of({file_}), lod::HeightType::int16);
    };
    const auto plain = text([](auto&) {});
    EXPECT_EQ(text([](auto&) {}), plain);
    EXPECT_NE(text([](auto& source) { source.band = 2; }), plain);
    EXPECT_NE(text([](auto& source) { source.variable = "depth"; }), plain);
    EXPECT_NE(text([](auto& source) { source.raw = ingest::RawLayout{2, 2, "int16", true}; }), plain);
    EXPECT_NE(text([](auto& source) { source.encoding = ingest::HeightEncoding::terrarium; }), plain);

    fs::create_directories(place_.parent_path());
    test::replace(sources_ / "a.vrt",
                  "<VRTDataset rasterXSize='600' rasterYSize='540'><SRS>EPSG:4326</SRS>"
                  "<GeoTransform>10, 0.001, 0, 50, 0, -0.001</GeoTransform>"
                  "<VRTRasterBand dataType='Int16' band='1'><SimpleSource>"
                  "<SourceFilename relativeToVRT='1'>a.tif</SourceFilename><SourceBand>1</SourceBand>"
                  "</SimpleSource></VRTRasterBand></VRTDataset>");
    const fs::path tif = std::exchange(file_, sources_ / "a.vrt");
    auto import = stopped_in_the_middle(place_);
    import->signal(SIGKILL);
    import->wait();
    fs::last_write_time(tif, fs::last_write_time(tif) + 1s);
    Running again(command(place_, {"--overwrite", "--resume"}, file_));
    EXPECT_EQ(again.wait(), 0);
    EXPECT_TRUE(test::says(again.messages(), {"begun anew"}));
}

TEST_F(IngestFaults, BadInputLeavesNothingBeside) {
    fs::create_directories(place_.parent_path());
    put_old_scene(place_);
    SyntheticRaster voids;
    voids.nodata = -999;
    voids.value = [](int, int) { return -999.0; };
    voids.write(sources_ / "voids.tif");  // which is known only when all of it was read
    test::replace(sources_ / "text.tif", "no raster");
    std::string cut = test::contents(file_);
    cut.resize(cut.size() / 2);
    test::replace(sources_ / "cut.tif", cut);
    for (const char* name : {"voids.tif", "text.tif", "cut.tif", "none.tif"}) {
        SCOPED_TRACE(name);
        Running import(command(place_, {"--overwrite", "--resume"}, sources_ / name));
        EXPECT_EQ(import.wait(), 3);
        EXPECT_TRUE(test::says(import.messages(), {name}));
        EXPECT_TRUE(test::all_files(place_) == old_);
        expect_alone(place_);
    }
}

}  // namespace
}  // namespace relevo
