#include "lod/soar/level_tables.hpp"

namespace relevo::lod {

LevelTables::LevelTables(const geo::PostPositions& positions, int levels) {
    if (positions.polar() != nullptr) return;
    constexpr int kBehind = 8;  // read by the last group of vertices, and not used
    const int last = 1 << levels;
    for (int level = 0; level < levels; ++level) {
        const int step = 1 << level;
        const auto line = [&](int first) {
            Line made;
            for (int column = first; column <= last; column += 2 * step) {
                made.cos_lon.push_back(positions.column(column).cos_lon);
                made.sin_lon.push_back(positions.column(column).sin_lon);
            }
            made.cos_lon.resize(made.cos_lon.size() + kBehind);
            made.sin_lon.resize(made.sin_lon.size() + kBehind);
            return made;
        };
        odd_.push_back(line(step));
        even_.push_back(line(0));
        rows_.emplace_back();
        for (int row = 0; row <= last; row += step) rows_.back().push_back(positions.row(row));
    }
}

}  // namespace relevo::lod
