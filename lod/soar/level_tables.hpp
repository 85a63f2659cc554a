#pragma once

#include <vector>

#include "geo/post_positions.hpp"

namespace relevo::lod {

/// What positions of a geographic grid's posts are made of (geo::PostPositions), for each level side by side:
/// every 2^level-th row, and of the columns those at odd and at even posts of the level apart. As many
/// numbers again as the grid's sides have posts, so that a tile finds its own in a few lines of cache.
class LevelTables {
  public:
    LevelTables(const geo::PostPositions& positions, int levels);

    struct Columns {
        const double* cos_lon;
        const double* sin_lon;
    };
    /// From an odd post of a level on, at every second post. There are some more numbers behind the last.
    Columns odd_columns(int level, int post) const {
        return from(odd_[static_cast<std::size_t>(level)], post / 2);
    }
    /// Likewise from an even one.
    Columns even_columns(int level, int post) const {
        return from(even_[static_cast<std::size_t>(level)], post / 2);
    }
    const geo::PostPositions::Row& row(int level, int post) const {
        return rows_[static_cast<std::size_t>(level)][static_cast<std::size_t>(post)];
    }

  private:
    struct Line {
        std::vector<double> cos_lon;
        std::vector<double> sin_lon;
    };
    static Columns from(const Line& line, int at) {
        return {line.cos_lon.data() + at, line.sin_lon.data() + at};
    }

    std::vector<Line> odd_;
    std::vector<Line> even_;
    std::vector<std::vector<geo::PostPositions::Row>> rows_;
};

}  // namespace relevo::lod
