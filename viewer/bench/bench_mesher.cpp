#include "viewer/bench/bench_mesher.hpp"

#include <chrono>

#include <fmt/format.h>

#include "lod/lstr/chunk_making.hpp"

namespace relevo::viewer {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Result<std::unique_ptr<BenchMesher>> BenchMesher::create(const lod::Scene& scene, BenchMethod method,
                                                         const BenchOptions& options, Paging paging) {
    const geo::GridFrame& frame = scene.info().frame;
    const std::uint64_t triangles =
        2 * static_cast<std::uint64_t>(frame.columns - 1) * static_cast<std::uint64_t>(frame.rows - 1);
    if (method == BenchMethod::full && triangles > kMostFullTriangles) {
        return Error{ErrorKind::usage, fmt::format("{} triangles a frame are too many to draw", triangles)};
    }
    std::optional<lod::TextbookMesher> textbook;
    if (method == BenchMethod::textbook) {
        auto made = lod::TextbookMesher::create(scene, options.look.exaggeration);
        if (!made) return made.error();
        textbook.emplace(std::move(*made));
    }
    const auto metric =
        method == BenchMethod::soar_incremental ? lod::ErrorMetric::incremental : lod::ErrorMetric::bounded;
    lod::TileStoreOptions tiles = options.tiles;
    if (paging == Paging::waited_for) tiles.fade_s = 0;
    auto terrain = lod::Terrain::open(scene, metric, tiles);
    if (!terrain) return terrain.error();
    if (method == BenchMethod::lstr) {
        if (auto done = lod::provide_chunks(scene, *terrain); !done) return done.error();
    }
    return std::unique_ptr<BenchMesher>(new BenchMesher(std::move(*terrain), std::move(textbook), paging));
}

Result<BenchMesher::Made> BenchMesher::make(const lod::View& view, const ViewState& state,
                                            const BenchSetting& setting, double tau_px, FrameBudget* budget) {
    if (textbook_) {
        const auto start = Clock::now();
        textbook_->refine(view, state.H, tau_px);
        const double refine_ms = ms_since(start);
        return Made{textbook_->mesh(view), refine_ms};  // putting it on the earth is not the textbook's
    }
    ViewState asked = state;
    asked.method = setting.method == BenchMethod::full   ? Method::full
                   : setting.method == BenchMethod::lstr ? Method::lstr
                                                         : Method::soar;
    asked.morph = setting.morph;
    asked.tau_px = tau_px;
    const auto timed = [&] {
        const auto start = Clock::now();
        const DrawnGround made = budget ? mesher_.ground(view, asked, *budget) : mesher_.ground(view, asked);
        return Made{made, ms_since(start)};
    };
    if (asked.method == Method::lstr && waits()) {
        if (const auto read = mesher_.whole_ground(view, asked); !read) return read.error();
        const auto start = Clock::now();
        const auto whole = mesher_.whole_ground(view, asked);
        if (!whole) return whole.error();
        return Made{*whole, ms_since(start)};
    }
    const Made made = timed();
    if (asked.method != Method::soar || !waits() || is_whole()) return made;
    // The time of a mesh is that of all it needs, and its error is held to tau: what was missing is read
    // first.
    if (const auto whole = mesher_.whole_ground(view, asked); !whole) return whole.error();
    return timed();
}

bool BenchMesher::is_whole() const {
    lod::TileStore& tiles = terrain_.tiles();
    tiles.start_frame();  // takes stock of what the last mesh wanted
    return tiles.figures().pending_tiles == 0 && !tiles.is_fading();
}

}  // namespace relevo::viewer
