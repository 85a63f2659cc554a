#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "geo/result.hpp"
#include "lod/tiles/tile_store.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// What is compared.
enum class BenchMethod {
    soar_bounded,      ///< the product's refinement by the bounded error
    soar_incremental,  ///< by the reference's midpoint error
    lstr,              ///< nodes of a quadtree
    textbook,          ///< the reference's refinement as printed: the yardstick
    full,              ///< every triangle of the data
};
std::string_view to_string(BenchMethod method);
Result<BenchMethod> parse_bench_method(std::string_view text);

constexpr bool has_morph(BenchMethod method) {
    return method == BenchMethod::soar_bounded || method == BenchMethod::soar_incremental ||
           method == BenchMethod::lstr;
}
constexpr bool has_tau(BenchMethod method) {
    return method != BenchMethod::full;
}

struct BenchOptions {
    int width = 1280;
    int height = 720;
    int samples = 1;
    std::vector<BenchMethod> methods{BenchMethod::soar_bounded, BenchMethod::soar_incremental,
                                     BenchMethod::lstr, BenchMethod::textbook, BenchMethod::full};
    std::vector<bool> morphs{false, true};
    std::vector<double> taus{0.25, 0.5, 1, 2, 4, 8, 16};
    int frames = 20;      ///< of each row and run, at equal times along the flight
    int runs = 3;         ///< times that everything is flown; methods take turns
    int error_every = 5;  ///< the error of each so manieth frame of the first run is measured; 0: of none
    ViewState look;       ///< how it is drawn; and the finest tau of the budget's rows
    BudgetLimits budget;  ///< where it has limits, more rows hold them
    lod::TileStoreOptions tiles;                        ///< how much of the terrain is kept in memory
    std::size_t ground_bytes = std::size_t{192} << 20;  ///< of its textures
    double budget_s = 20;                               ///< how long such a row flies at most
};

/// A line of the result: a method with its settings. tau is absent of `full`; with a budget, it is the
/// finest.
struct BenchSetting {
    BenchMethod method = BenchMethod::soar_bounded;
    bool morph = false;
    std::optional<double> tau_px;
    bool by_budget = false;

    friend bool operator==(const BenchSetting&, const BenchSetting&) = default;
};
/// All that the options ask for, method by method.
std::vector<BenchSetting> bench_settings(const BenchOptions& options);

/// "soar-bounded, morph"
std::string_view series_name(const BenchSetting& setting);

}  // namespace relevo::viewer
