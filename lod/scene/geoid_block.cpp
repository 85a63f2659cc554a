#include "lod/scene/geoid_block.hpp"

#include <fmt/format.h>

#include "lod/scene/block_file.hpp"

namespace relevo::lod {
namespace {

/// A geoid's rows go northwards, an image's southwards.
template <class To, class From>
std::vector<To> rows_turned(const std::vector<From>& samples, int columns, int rows) {
    std::vector<To> turned;
    turned.reserve(samples.size());
    for (int row = rows - 1; row >= 0; --row) {
        for (int column = 0; column < columns; ++column)
            turned.push_back(
                static_cast<To>(samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                        static_cast<std::size_t>(column)]));
    }
    return turned;
}

}  // namespace

Result<std::vector<std::byte>> encode_geoid(const geo::GeoidNodes& nodes) {
    constexpr int kWgs84 = 4326;
    const GeoReference where{kWgs84, nodes.west, nodes.south + (nodes.rows - 1) * nodes.step_lat,
                             nodes.step_lon, nodes.step_lat};
    return encode_block<float>(rows_turned<float>(nodes.undulations, nodes.columns, nodes.rows),
                               {nodes.columns, nodes.rows}, where);
}

Result<geo::Geoid> decode_geoid(std::span<const std::byte> bytes, const GeoidInfo& info,
                                const std::string& name) {
    const auto samples = decode_block<float>(bytes, {info.columns, info.rows}, name);
    if (!samples) return samples.error();
    auto geoid =
        geo::Geoid::from_nodes({info.south, info.west, info.step_lat, info.step_lon, info.rows, info.columns,
                                rows_turned<double>(*samples, info.columns, info.rows)},
                               name);
    if (!geoid)
        return Error{ErrorKind::damaged, fmt::format("{} is damaged: it is no grid of undulations", name)};
    return geoid;
}

}  // namespace relevo::lod
