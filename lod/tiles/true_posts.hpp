#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "geo/result.hpp"
#include "lod/pyramid/pyramid.hpp"

namespace relevo::lod {

/// The heights of a terrain's finest posts as the data has them, read where they are asked for. A bounded
/// part of them is kept. What judges, picks and follows the ground looks here, never at the mesh.
class TruePosts {
  public:
    static constexpr std::size_t kMemoryBytes = std::size_t{64} << 20;

    /// \param pyramid  outlives this
    explicit TruePosts(const Pyramid& pyramid, std::size_t memory_bytes = kMemoryBytes)
        : pyramid_(pyramid), memory_bytes_(memory_bytes) {}

    /// For one thread. Neighbouring posts cost a few nanoseconds.
    class Reader {
      public:
        explicit Reader(const TruePosts& posts) : posts_(posts) {}

        /// H, metres; NaN where there is none: voids and what is not of the data.
        float H(int column, int row);
        bool is_valid(int column, int row);

        /// A cell is ground where its four posts are valid: the rule of measuring, drawing and picking alike.
        bool is_valid_cell(int column, int row);

      private:
        using Block = std::shared_ptr<const Raster<float>>;
        struct Held {
            int column = -1;
            int row = -1;
            Block block;
        };
        const TruePosts& posts_;
        std::array<Held, 4> held_;
    };

    /// The first read that failed; what it would have told counts as void.
    std::optional<Error> failure() const;

  private:
    using Block = std::shared_ptr<const Raster<float>>;
    using Place = std::pair<int, int>;  // row, column
    struct Kept {
        Block block;
        std::list<Place>::iterator age;
    };

    Block block(int column, int row) const;

    const Pyramid& pyramid_;
    const std::size_t memory_bytes_;
    mutable std::mutex mutex_;
    mutable std::map<Place, Kept> kept_;
    mutable std::list<Place> by_age_;  // the one used last first
    mutable std::size_t bytes_ = 0;
    mutable std::optional<Error> failure_;
};

}  // namespace relevo::lod
