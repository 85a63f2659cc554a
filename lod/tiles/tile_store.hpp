#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "geo/result.hpp"
#include "lod/tiles/tile.hpp"
#include "lod/tiles/tile_reader.hpp"

namespace relevo::lod {

/// How tiles are kept and loaded.
struct TileStoreOptions {
    std::size_t memory_bytes = std::size_t{256}
                               << 20;  ///< of tiles; those of the coarsest levels come on top
    int threads = 2;                   ///< that read; 0: whoever waits
    double fade_s = 0.5;               ///< in which an arriving tile's vertices come in; 0: at once
    double read_delay_s = 0;           ///< added to each read, for trials
};

/// The tiles of a terrain that are in memory, bounded, and those that are on their way.
///
/// Between two calls of start_frame() what is there does not change: refinement reads it from many threads
/// without locks. A tile is *usable* when all that its vertices' ancestors may lie in is: its parent, and the
/// parent's neighbours across the sides that they have in common with the tile. So a vertex can be drawn only
/// where its parents can, and meshes stay conforming whatever is missing (docs/design.md, "Paging").
class TileStore {
  public:
    /// A tile in memory.
    struct Resident {
        Tile tile;
        /// How far its vertices may have come in, in [0, 1]; 0: not usable. Never more than that of a tile
        /// that it depends on.
        double presence = 0;
        /// The same of vertices on the tile's sides, which both tiles have: north, south, west, east.
        std::array<double, 4> side_presence{};

        std::chrono::steady_clock::time_point arrived = {};
        std::uint64_t used_in_frame = 0;  ///< the store's own
    };

    struct Figures {
        std::size_t resident_bytes = 0;
        std::size_t resident_tiles = 0;
        std::size_t pending_tiles = 0;  ///< wanted by the last frame and not there
        double memory_load = 0;         ///< what the last frame draws with and wants, over the memory
        std::uint64_t read_blocks = 0;  ///< since the start

        /// What the last frame wants does not fit in the memory.
        bool starved() const { return memory_load > 1; }
    };

    /// Reads the coarsest block of the pyramid. The arguments outlive this.
    static Result<std::unique_ptr<TileStore>> open(const Pyramid& pyramid,
                                                   const geo::PostPositions& positions,
                                                   const UndulationGrid& undulations, ErrorMetric metric,
                                                   const TileStoreOptions& options);
    TileStore(const TileStore&) = delete;
    TileStore& operator=(const TileStore&) = delete;

    const TileGrid& grid() const { return grid_; }

    /// Heights H and undulations of the grid's corners: north-west, south-west, south-east, north-east.
    struct Corner {
        GridPoint post;
        double H;
        double N;
    };
    const std::array<Corner, 4>& corners() const { return corners_; }

    /// Takes in what has been read, lets go of what has long not been used, and tells the readers what the
    /// last frame wanted.
    void start_frame();

    /// A usable tile, or null. May be called from several threads, as use() and want().
    const Resident* find(const TileId& id) const {
        const Resident* tile = slot(id).get();
        return tile != nullptr && tile->presence > 0 ? tile : nullptr;
    }

    /// A frame draws with this tile.
    void use(const Resident& tile) const;

    /// A tile is not usable and should be. \param urgency  larger is sooner
    void want(const TileId& id, double urgency, TileNeed need = TileNeed::now) const;

    /// Are vertices still coming in?
    bool is_fading() const { return fading_; }

    /// Waits until a read is finished; false where none is under way. To be followed by start_frame().
    bool wait() { return reader_.wait(); }

    /// The first read that failed. Its tiles stay away: the ground is drawn as coarse as their parents.
    std::optional<Error> failure() const;

    Figures figures() const;

  private:
    using Clock = std::chrono::steady_clock;

    TileStore(const Pyramid& pyramid, const geo::PostPositions& positions, const UndulationGrid& undulations,
              ErrorMetric metric, const TileStoreOptions& options);

    std::size_t index(const TileId& id) const {
        const auto level = static_cast<std::size_t>(id.level);
        return static_cast<std::size_t>(id.row) * static_cast<std::size_t>(across_[level]) +
               static_cast<std::size_t>(id.column);
    }
    const std::unique_ptr<Resident>& slot(const TileId& id) const {
        return levels_[static_cast<std::size_t>(id.level)][index(id)];
    }
    std::unique_ptr<Resident>& slot(const TileId& id) {
        return levels_[static_cast<std::size_t>(id.level)][index(id)];
    }

    /// Calls visit(TileId) for what a tile depends on.
    template <class Visit>
    void for_each_dependence(const TileId& id, Visit visit) const;
    void take_in(std::vector<TileReader::Arrival> arrivals);
    void update_presence();
    void keep_dependences();
    void make_room(std::size_t bytes);
    std::vector<TileWish> take_wishes();
    void pass_on(std::vector<TileWish> wishes);

    const TileStoreOptions options_;
    const TileGrid grid_;
    std::array<Corner, 4> corners_{};

    // What a frame sees.
    std::vector<std::vector<std::unique_ptr<Resident>>> levels_;
    std::vector<int> across_;
    std::size_t resident_bytes_ = 0;
    std::vector<Resident*> residents_;  // coarsest first; without those of the coarsest block, which stay
    std::uint64_t frame_ = 1;           // that is drawn next
    std::uint64_t last_drawn_ = 0;      // the last that drew with anything
    mutable std::atomic<bool> used_{false};
    bool fading_ = false;
    double memory_load_ = 0;
    std::set<TileId> failed_;
    std::optional<Error> failure_;

    mutable std::mutex wishes_mutex_;
    mutable std::vector<TileWish> wishes_;  // of the frame under way
    std::size_t pending_ = 0;

    TileReader reader_;
};

}  // namespace relevo::lod
