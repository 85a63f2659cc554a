// Object-space errors and radii of a real scene: the shipped builder on one and on two threads, and in the
// same run the textbook on one thread, a flat grid in metres: the reference's vertical midpoint error with
// its spheres, and for the bounded error a plain scan of all posts at each level.
//
//   metrics_bench SCENE [RUNS]
//
// The runs (5 unless said otherwise) of all of them take turns; medians, and the range of the ratios to the
// textbook. Timed is everything from heights in memory to codes in memory, the posts' positions included; not
// timed are reading the scene and MeshHeights, which an import collects while it writes the heights. CPU time
// is what to look at where other programs run.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "geo/post_positions.hpp"
#include "lod/mesh_heights.hpp"
#include "lod/scene/scene.hpp"
#include "lod/soar/metrics.hpp"
#include "lod/textbook/textbook.hpp"

namespace {

using namespace relevo;

struct Seconds {
    double wall;
    double cpu;  // of all threads
};

Seconds seconds_of(const auto& work) {
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

/// The vertical distance of every post from every triangle that it lies in, level by level, nested.
std::vector<float> plain_bounded(const lod::Raster<float>& heights, int levels) {
    const int side = heights.columns();
    std::vector<float> errors(heights.samples().size(), 0.0f);
    const auto index = [side](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>(column);
    };
    const auto triangle = [&](const lod::GridPoint& a, const lod::GridPoint& b, const lod::GridPoint& c) {
        const auto z = [&](const lod::GridPoint& p) { return heights.at(p.column, p.row); };
        const int x1 = b.column - a.column, y1 = b.row - a.row;
        const int x2 = c.column - a.column, y2 = c.row - a.row;
        const auto area = static_cast<float>(x1 * y2 - x2 * y1);
        const float z1 = z(b) - z(a), z2 = z(c) - z(a);
        const float along = (z1 * static_cast<float>(y2) - z2 * static_cast<float>(y1)) / area;
        const float down = (z2 * static_cast<float>(x1) - z1 * static_cast<float>(x2)) / area;
        float largest = 0;
        const auto [top, bottom] = std::minmax({a.row, b.row, c.row});
        for (int row = top; row <= bottom; ++row) {
            int first = side, last = -1;
            const lod::GridPoint* corner[] = {&a, &b, &c, &a};
            for (int k = 0; k < 3; ++k) {
                const lod::GridPoint& p = *corner[k];
                const lod::GridPoint& q = *corner[k + 1];
                if (row < std::min(p.row, q.row) || row > std::max(p.row, q.row)) continue;
                const int at = p.row == q.row
                                   ? p.column
                                   : p.column + (row - p.row) * ((q.column - p.column) / (q.row - p.row));
                first = std::min({first, at, p.row == q.row ? q.column : at});
                last = std::max({last, at, p.row == q.row ? q.column : at});
            }
            const float start =
                z(a) + static_cast<float>(row - a.row) * down - static_cast<float>(a.column) * along;
            const float* post = heights.row(row);
            for (int column = first; column <= last; ++column)
                largest =
                    std::max(largest, std::abs(start + static_cast<float>(column) * along - post[column]));
        }
        return largest;
    };
    for (int level = 2 * levels - 1; level >= 0; --level) {
        for (int row = 0; row < side; ++row) {
            lod::for_each_vertex_in_row(levels, level, row, [&](const lod::GridPoint& v) {
                const lod::Diamond d = lod::diamond(v, level, levels);
                float error = 0;
                for (const lod::GridPoint& apex : d.apexes)
                    error = std::max(error, triangle(d.left, d.right, apex));
                for (const lod::GridPoint& c : lod::children(v, level, levels))
                    error = std::max(error, errors[index(c.column, c.row)]);
                errors[index(v.column, v.row)] = error;
            });
        }
    }
    return errors;
}

/// As lod::part_of, into memory that is used again.
void copy_part(const lod::Raster<float>& heights, const lod::BlockGrid::Box& box, lod::Raster<float>& into) {
    const int columns = std::clamp(heights.columns() - box.column, 0, box.columns);
    const int rows = std::clamp(heights.rows() - box.row, 0, box.rows);
    if (into.columns() != columns || into.rows() != rows) into = lod::Raster<float>(columns, rows);
    for (int row = 0; row < rows; ++row)
        std::copy_n(heights.row(box.row + row) + box.column, columns, into.row(row));
}

/// As an import does it, without the disk.
void shipped(const geo::GridFrame& frame, const lod::UndulationGrid& undulations,
             const lod::MeshHeights& fill, const lod::Raster<float>& heights, lod::ObjectErrors errors,
             int threads) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
        const geo::PostPositions positions(frame);
        lod::MetricBuilder builder({frame, positions, undulations, fill}, errors);
        const int side = frame.padded_side();
        const auto grid = lod::BlockGrid::of_metrics(side);
        tbb::parallel_for(0, grid.count(), [&](int i) {
            const auto tile = grid.box(i % grid.across, i / grid.across);
            thread_local lod::Raster<float> window;
            copy_part(heights, lod::MetricTile::window_of(tile, side), window);
            builder.add_tile(tile, window);
        });
        builder.finish();
    });
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

struct Row {
    std::string name;
    const Row* yardstick;  // null: it is one
    std::vector<Seconds> seconds{};

    double median_of(double Seconds::*which) const {
        std::vector<double> values;
        for (const Seconds& run : seconds) values.push_back(run.*which);
        return median(values);
    }
};

}  // namespace

int main(int argc, char** argv) {
    const int runs = argc == 3 ? std::atoi(argv[2]) : 5;
    if (argc < 2 || argc > 3 || runs < 1) {
        fmt::print(stderr, "usage: metrics_bench SCENE [RUNS]\n");
        return 2;
    }
    const auto scene = lod::Scene::open(argv[1]);
    if (!scene) {
        fmt::print(stderr, "{}\n", scene.error().message);
        return 3;
    }
    const auto heights = scene->read_all_heights();
    const lod::UndulationGrid undulations = scene->undulations();
    if (!heights) {
        fmt::print(stderr, "{}: cannot be read\n", argv[1]);
        return 4;
    }
    const geo::GridFrame& frame = scene->info().frame;
    const auto spacing = frame.spacing({0.5 * frame.columns, 0.5 * frame.rows});
    lod::MeshHeights fill(frame);
    fill.add(0, 0, *heights);
    fill.finish();
    const lod::Raster<float> padded = lod::mesh_heights(frame, *heights);

    Row midpoint{"textbook midpoint, 1 thread", nullptr};
    Row scan{"textbook scan, 1 thread", nullptr};
    Row incremental[] = {{"incremental, 1 thread", &midpoint}, {"incremental, 2 threads", &midpoint}};
    Row bounded[] = {{"bounded, 1 thread", &scan}, {"bounded, 2 threads", &scan}};
    for (int run = 0; run < runs; ++run) {
        midpoint.seconds.push_back(
            seconds_of([&] { const lod::Textbook textbook(padded, spacing.column_m, spacing.row_m); }));
        scan.seconds.push_back(seconds_of([&] { plain_bounded(padded, frame.levels()); }));
        for (int threads = 1; threads <= 2; ++threads) {
            const auto time = [&](lod::ObjectErrors errors) {
                return seconds_of([&] { shipped(frame, undulations, fill, *heights, errors, threads); });
            };
            incremental[threads - 1].seconds.push_back(time(lod::ObjectErrors::incremental));
            bounded[threads - 1].seconds.push_back(time(lod::ObjectErrors::both));
        }
    }
    const double posts = static_cast<double>(padded.samples().size());
    fmt::print("{} x {} posts, medians of {} interleaved runs\n", padded.columns(), padded.rows(), runs);
    for (const Row* row : {&midpoint, &incremental[0], &incremental[1], &scan, &bounded[0], &bounded[1]}) {
        const double wall = row->median_of(&Seconds::wall);
        const double cpu = row->median_of(&Seconds::cpu);
        fmt::print("{:27} {:7.2f} s {:7.1f} million posts/s, {:6.2f} s of CPU time {:7.1f} million posts/s",
                   row->name, wall, posts * 1e-6 / wall, cpu, posts * 1e-6 / cpu);
        if (row->yardstick) {
            std::vector<double> ratios;
            for (std::size_t i = 0; i < row->seconds.size(); ++i)
                ratios.push_back(row->yardstick->seconds[i].wall / row->seconds[i].wall);
            const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
            fmt::print("; {:.1f} x textbook ({:.1f} to {:.1f})", median(ratios), *least, *most);
        }
        fmt::print("\n");
    }
    return 0;
}
