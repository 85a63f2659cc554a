#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "ingest/source/source.hpp"

namespace relevo::ingest {

/// What stays known of a source while its file is closed.
struct SourceFacts {
    std::string name;
    std::filesystem::path file;
    std::vector<std::filesystem::path> all_files;  ///< as Source::all_files()
    int columns = 0;
    int rows = 0;
    Affine posts;
    std::string crs_name;
    std::string crs_wkt;
    std::string step_unit;
    std::shared_ptr<const Crs> crs;  ///< one for all sources whose CRSs mean the same
    HeightRule heights;
    bool whole_metres = false;
    std::string value_type;
    std::vector<std::string> notes;
};

/// Any number of sources, of which a bounded number is open at a time. Any thread may read; a file is read by
/// one at a time.
class SourcePool {
  public:
    /// File descriptors are few (256 on some systems, and a VRT takes several).
    static constexpr int kMostOpen = 64;

    /// Opens and checks them all, on all cores; of several that cannot be used the first is told.
    static Result<SourcePool> open(std::vector<SourceRequest> requests);

    int count() const { return static_cast<int>(facts_.size()); }
    const SourceFacts& facts(int source) const { return facts_[static_cast<std::size_t>(source)]; }

    /// As Source::read.
    Result<lod::Raster<double>> read(int source, Window window) const;

  private:
    struct Slot {
        std::mutex reading;
        std::optional<Source> source;
        std::uint64_t last_use = 0;  // under `choosing`
    };
    struct Slots {
        explicit Slots(std::size_t count) : all(count) {}
        std::vector<Slot> all;
        std::mutex choosing;
        std::vector<int> open;
        std::uint64_t uses = 0;
    };

    SourcePool() = default;
    Result<void> make_open(int source) const;
    void make_room() const;

    std::vector<SourceRequest> requests_;
    std::vector<SourceFacts> facts_;
    std::unique_ptr<Slots> slots_;
};

}  // namespace relevo::ingest
