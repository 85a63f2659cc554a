#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "geo/result.hpp"
#include "lod/error_metric.hpp"
#include "lod/tiles/tile.hpp"

namespace relevo::lod {

/// For whom a tile is asked for.
enum class TileNeed {
    now,   ///< a frame would draw with it
    soon,  ///< a frame may draw with it before long: read after all that is needed now, and where there is
           ///< room
};

/// A tile that is not there and should be.
struct TileWish {
    TileId id;
    double urgency = 0;  ///< larger is sooner
    TileNeed need = TileNeed::now;
};

/// Reads blocks of a pyramid in the background, those of the most urgent tiles first, and makes tiles of
/// them.
class TileReader {
  public:
    /// The references outlive this. \param threads  that read; 0: whoever waits
    /// \param delay_s  added to each read, for trials
    TileReader(const Pyramid& pyramid, const geo::PostPositions& positions, const UndulationGrid& undulations,
               ErrorMetric metric, int threads, double delay_s);
    ~TileReader();
    TileReader(const TileReader&) = delete;
    TileReader& operator=(const TileReader&) = delete;

    /// What is to be read from now on, the most urgent last, in place of what was asked before; what is being
    /// read goes on. \param whole_blocks  of each block that is read, make all tiles
    void ask(std::vector<TileWish> wishes, bool whole_blocks);

    /// What a read of a block brought.
    struct Arrival {
        std::vector<Tile> tiles;
        std::vector<TileId> asked;
        std::optional<Error> failure;
    };
    std::vector<Arrival> take();

    /// Waits until a read is finished; false where none is under way or to be begun.
    bool wait();

    std::uint64_t read_blocks() const;  ///< since the start

  private:
    void run(const std::stop_token& stop);
    bool read_next(std::unique_lock<std::mutex>& lock);
    std::vector<TileId> tiles_in(const PyramidBlock& block) const;

    const Pyramid& pyramid_;
    const geo::PostPositions& positions_;
    const UndulationGrid& undulations_;
    const ErrorMetric metric_;
    const double delay_s_;
    const TileGrid grid_;

    mutable std::mutex mutex_;
    std::condition_variable_any work_;
    std::condition_variable_any news_;
    std::vector<TileWish> queue_;  // least urgent first
    std::set<TileId> under_way_;
    std::vector<Arrival> arrivals_;
    std::uint64_t read_blocks_ = 0;
    bool whole_blocks_ = true;
    std::vector<std::jthread> threads_;
};

}  // namespace relevo::lod
