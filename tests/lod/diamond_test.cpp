#include "lod/soar/diamond.hpp"

#include <set>

#include <gtest/gtest.h>

#include "lod/soar/cell.hpp"

namespace relevo::lod {
namespace {

class DiamondTest : public testing::TestWithParam<int> {};

TEST_P(DiamondTest, EveryPostButTheCornersHasOneLevel) {
    const int n = GetParam();
    const int side = 1 << n;
    std::multiset<std::pair<int, int>> seen;
    for (int level = 0; level < 2 * n; ++level) {
        for (int row = 0; row <= side; ++row) {
            for_each_vertex_in_row(n, level, row, [&](const GridPoint& v) {
                seen.insert({v.column, v.row});
            });
        }
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>((side + 1) * (side + 1) - 4));
    EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), seen.size());
    EXPECT_FALSE(seen.contains({0, 0}));
}

// The parents of a vertex are the apexes of its diamond: the two relations must be each other's inverse.
TEST_P(DiamondTest, ChildrenAndApexesAreInverse) {
    const int n = GetParam();
    const int side = 1 << n;
    std::set<std::array<int, 4>> from_children;
    std::set<std::array<int, 4>> from_apexes;
    for (int level = 0; level < 2 * n; ++level) {
        for (int row = 0; row <= side; ++row) {
            for_each_vertex_in_row(n, level, row, [&](const GridPoint& v) {
                for (const GridPoint& c : children(v, level, n))
                    from_children.insert({v.column, v.row, c.column, c.row});
                if (level == 0) return;
                const Diamond d = diamond(v, level, n);
                EXPECT_EQ(midpoint(d.left, d.right), v);
                for (const GridPoint& p : d.apexes) from_apexes.insert({p.column, p.row, v.column, v.row});
            });
        }
    }
    EXPECT_EQ(from_children, from_apexes);
}

INSTANTIATE_TEST_SUITE_P(Sizes, DiamondTest, testing::Values(1, 2, 3, 5));

// Bisection from the four base triangles down to the last level must end in exactly the triangles of the
// cells.
TEST(CellTriangles, AreTheLastLevelOfTheBisection) {
    constexpr int n = 3;
    std::set<std::array<int, 6>> bisected;
    const auto split = [&](auto&& self, GridPoint l, GridPoint r, GridPoint a, int level) -> void {
        if (level == 2 * n) {
            bisected.insert({l.column, l.row, r.column, r.row, a.column, a.row});
            return;
        }
        const GridPoint v = midpoint(l, r);
        self(self, a, l, v, level + 1);
        self(self, r, a, v, level + 1);
    };
    const GridPoint corners[] = {{0, 0}, {0, 8}, {8, 8}, {8, 0}};
    for (int k = 0; k < 4; ++k) split(split, corners[k], corners[(k + 1) % 4], {4, 4}, 1);

    std::set<std::array<int, 6>> cells;
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            for (const auto& [l, r, a] : cell_triangles({column, row})) {
                cells.insert({l.column, l.row, r.column, r.row, a.column, a.row});
            }
        }
    }
    EXPECT_EQ(bisected, cells);
}

}  // namespace
}  // namespace relevo::lod
