#include "app/wave_flag.hpp"

#include <optional>
#include <vector>

#include <fmt/format.h>

#include "ingest/wave_map_file.hpp"
#include "viewer/numbers.hpp"

namespace relevo::app {

namespace {

constexpr double kTile = 200;  // metres
constexpr double kSmallestTile = 1;
constexpr double kLargestTile = 100e3;

/// What --waves says. A file's name may have commas: numbers are taken from the end.
struct WaveText {
    std::string file;
    std::vector<double> numbers;
};

WaveText split(std::string_view text) {
    constexpr std::size_t kMost = 2;
    WaveText parts;
    while (parts.numbers.size() < kMost) {
        const std::size_t comma = text.rfind(',');
        if (comma == std::string_view::npos) break;
        const auto number = viewer::parse_numbers(text.substr(comma + 1));
        if (!number) break;
        parts.numbers.insert(parts.numbers.begin(), number->front());
        text = text.substr(0, comma);
    }
    parts.file = text;
    return parts;
}

Error wrong(std::string_view text, const std::string& what) {
    return {ErrorKind::usage, fmt::format("--waves {}: {}", text, what)};
}

}  // namespace

Result<std::shared_ptr<const lod::WaveMap>> read_waves(const std::string& text, geo::Degrees wind_from) {
    const auto [file, numbers] = split(text);
    if (file.empty()) return wrong(text, "expected MAP,TILE_M,HEIGHT_M, a file and two lengths in metres");
    const double tile_m = numbers.empty() ? kTile : numbers.front();
    if (!(tile_m >= kSmallestTile && tile_m <= kLargestTile))
        return wrong(text, fmt::format("a tile of {} m: {} to {}", tile_m, kSmallestTile, kLargestTile));
    const double range_m = numbers.size() == 2 ? numbers.back() : 0;
    if (numbers.size() == 2 && !(range_m > 0 && range_m <= ingest::kMostWaveMapRange)) {
        return wrong(text, fmt::format("{} m from the lowest to the highest height: above 0 and at most {}",
                                       range_m, ingest::kMostWaveMapRange));
    }
    const auto posts = ingest::read_wave_map(file, range_m);
    if (!posts) return Error{posts.error().kind, "--waves: " + posts.error().message};
    if (posts->columns != posts->side || posts->rows != posts->side) {
        fmt::print(stderr, "relevo: note: {}: {} x {} posts are resampled to {} x {}\n", file, posts->columns,
                   posts->rows, posts->side, posts->side);
    }
    return std::shared_ptr<const lod::WaveMap>(
        std::make_shared<lod::WaveMap>(posts->side, posts->heights_m, tile_m, wind_from));
}

}  // namespace relevo::app
