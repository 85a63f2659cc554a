#include "lod/machine_figures.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "lod/scene/folder.hpp"

namespace relevo::lod {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kPiece = std::size_t{128} << 10;  // about a block of heights
constexpr std::size_t kMostPieces = 128;
// Less than both is too little to tell from.
constexpr std::size_t kLeastRead = std::size_t{1} << 20;
constexpr double kLeastS = 0.02;
constexpr auto kTime = std::chrono::milliseconds(60);

/// "MemAvailable:   123456 kB", of /proc/meminfo.
std::optional<std::uint64_t> meminfo(const fs::path& root, const std::string& name) {
    std::ifstream file(root / "proc/meminfo");
    for (std::string line; std::getline(file, line);) {
        if (line.compare(0, name.size() + 1, name + ":") != 0) continue;
        return std::strtoull(line.c_str() + name.size() + 1, nullptr, 10) << 10;
    }
    return std::nullopt;
}

/// Nothing where there is none: "max".
std::optional<std::uint64_t> number_in(const fs::path& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (file >> number) return number;
    return std::nullopt;
}

/// "inactive_file 4096", of a group's memory.stat.
std::uint64_t stat_of(const fs::path& group, const std::string& wanted) {
    std::ifstream file(group / "memory.stat");
    std::string name;
    std::uint64_t number = 0;
    while (file >> name >> number) {
        if (name == wanted) return number;
    }
    return 0;
}

/// The process's own group of cgroup v2: "0::/user.slice/..." of /proc/self/cgroup.
fs::path own_group(const fs::path& root) {
    std::ifstream file(root / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        if (line.compare(0, 4, "0::/") == 0) return line.substr(4);
    }
    return {};
}

/// Every group's limit binds those inside it. In a container the own group is often the root that is seen.
void apply_limits(const fs::path& root, MachineFigures& found) {
    const fs::path top = root / "sys/fs/cgroup";
    for (fs::path inside = own_group(root);; inside = inside.parent_path()) {
        const fs::path group = top / inside;
        if (const auto limit = number_in(group / "memory.max")) {
            // What the group has read from files and not used lately makes room when it must.
            const std::uint64_t used = number_in(group / "memory.current").value_or(0);
            const std::uint64_t busy = used - std::min(used, stat_of(group, "inactive_file"));
            found.memory_total = std::min(found.memory_total, *limit);
            found.memory_available = std::min(found.memory_available, *limit - std::min(*limit, busy));
        }
        if (inside.empty()) break;
    }
}

struct Piece {
    fs::path file;
    off_t offset = 0;
};

/// Evenly over the folder's larger files.
std::vector<Piece> pieces_of(const fs::path& folder) {
    constexpr int kMostEntries = 10000;  // the folder may be anything: it has not been opened yet
    std::vector<std::pair<fs::path, std::uintmax_t>> files;
    std::uintmax_t pieces = 0;
    int seen = 0;
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end;
         at.increment(failed)) {
        if (++seen > kMostEntries) break;
        std::error_code unknown;
        const auto bytes = at->is_regular_file(unknown) ? at->file_size(unknown) : 0;
        if (unknown || bytes < kPiece) continue;
        files.emplace_back(at->path(), bytes / kPiece);
        pieces += bytes / kPiece;
    }
    const std::uintmax_t step = std::max<std::uintmax_t>(1, (pieces + kMostPieces - 1) / kMostPieces);
    std::vector<Piece> chosen;
    std::uintmax_t next = 0;
    for (const auto& [file, count] : files) {
        for (; next < count; next += step) chosen.push_back({file, static_cast<off_t>(next * kPiece)});
        next -= count;
    }
    return chosen;
}

/// Is any of it in memory?
bool is_cached(int file, off_t offset) {
    void* mapped = mmap(nullptr, kPiece, PROT_READ, MAP_SHARED, file, offset);
    if (mapped == MAP_FAILED) return true;
    std::vector<unsigned char> resident(kPiece / 4096 + 1);
    const bool known = mincore(mapped, kPiece, resident.data()) == 0;
    munmap(mapped, kPiece);
    return !known ||
           std::any_of(resident.begin(), resident.end(), [](unsigned char page) { return page & 1; });
}

void time_reading(const fs::path& folder, MachineFigures& found) {
    std::vector<char> bytes(kPiece);
    std::size_t cached = 0, read = 0;
    Clock::duration reading{};
    const auto start = Clock::now();
    for (const Piece& piece : pieces_of(folder)) {
        if (Clock::now() - start > kTime) break;
        const Descriptor file(open(piece.file.c_str(), O_RDONLY | O_CLOEXEC));
        if (file.number() < 0) continue;
        posix_fadvise(file.number(), piece.offset, kPiece, POSIX_FADV_DONTNEED);
        posix_fadvise(file.number(), 0, 0, POSIX_FADV_RANDOM);  // no more than is asked for
        if (is_cached(file.number(), piece.offset)) {
            cached += kPiece;
            continue;
        }
        const auto before = Clock::now();
        const ssize_t got = pread(file.number(), bytes.data(), kPiece, piece.offset);
        reading += Clock::now() - before;
        read += got > 0 ? static_cast<std::size_t>(got) : 0;
    }
    if (cached + read > 0)
        found.cached_part = static_cast<double>(cached) / static_cast<double>(cached + read);
    const double seconds = std::chrono::duration<double>(reading).count();
    if (read > 0 && (read >= kLeastRead || seconds >= kLeastS))
        found.read_mib_s = static_cast<double>(read) / static_cast<double>(1 << 20) / seconds;
}

}  // namespace

MachineFigures find_memory(const fs::path& root) {
    MachineFigures found;
    found.cores = std::max(std::thread::hardware_concurrency(), 1U);
    const auto pages = static_cast<std::uint64_t>(std::max(sysconf(_SC_PHYS_PAGES), 0L));
    found.memory_total =
        meminfo(root, "MemTotal").value_or(pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
    found.memory_available = meminfo(root, "MemAvailable").value_or(found.memory_total / 2);
    apply_limits(root, found);
    return found;
}

MachineFigures find_machine(const fs::path& folder) {
    MachineFigures found = find_memory();
    time_reading(folder, found);
    return found;
}

}  // namespace relevo::lod
