#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/scene/post_mark.hpp"
#include "lod/scene/raster.hpp"

namespace relevo::ingest {

/// Open sea begins where posts from here up to 0 m meet the data's border or nodata, metres.
inline constexpr float kSeaBeginsAt = -15;
/// A coast up to here is low, metres.
inline constexpr float kLowCoast = 15;
/// Areas with fewer posts say nothing about the rest of a scene.
inline constexpr std::uint64_t kTellingArea = 64;

/// Heights as far as the rule of the sea tells them apart.
enum class SeaBand : std::uint8_t {
    deep,     ///< below kSeaBeginsAt
    shallow,  ///< up to, not at, 0
    zero,     ///< exactly 0
    coast,    ///< above 0, up to kLowCoast
    high,
    none,  ///< void
};
SeaBand sea_band(float height, lod::PostMark mark);
/// At or below 0.
inline bool is_low(SeaBand band) {
    return band <= SeaBand::zero;
}

/// What is counted of an area of posts that are all low or all void, and hang together by sides. Corners do
/// not connect: a dike of one post that runs aslant stays tight. Counts of parts add up, so an area may be
/// counted in blocks.
struct SeaArea {
    bool is_void = false;
    std::uint64_t posts = 0;

    // Of a low area.
    std::uint64_t zeros = 0;           ///< posts of exactly 0
    std::uint64_t border_shallow = 0;  ///< posts at the data's border, from kSeaBeginsAt up
    std::uint64_t border_deep = 0;     ///< and below
    std::uint64_t void_contacts = 0;   ///< pairs of neighbours, of which the other is void
    float lowest = 0;

    // Of a void area.
    bool reaches_border = false;              ///< of the data
    std::array<std::uint64_t, 5> contacts{};  ///< pairs of neighbours, by the other's band

    void add(const SeaArea& part);
    /// More of it is a plain of exactly 0 than is not.
    bool is_level_zero() const { return 2 * zeros >= posts; }
};

/// Neighbouring pairs of a low area and a void one.
struct SeaContact {
    std::uint32_t low = 0;  ///< indices of areas
    std::uint32_t gap = 0;  ///< the void one
    std::uint64_t shallow = 0;
    std::uint64_t deep = 0;
};
/// Brings contacts in order, with one entry for each two areas.
void combine(std::vector<SeaContact>& contacts);

/// Which sides of a block are the data's border.
struct DataBorder {
    bool west = false;
    bool east = false;
    bool north = false;
    bool south = false;
};

/// The areas in a block, numbered by their first posts, row by row.
struct BlockAreas {
    static constexpr std::int32_t kLand = -1;

    lod::Raster<std::int32_t> number;  ///< of the area at each post; kLand elsewhere
    std::vector<SeaArea> areas;
    std::vector<SeaContact> contacts;  ///< inside the block
    /// Areas whose fate is not decided inside the block: those that reach its sides, and low ones of some
    /// size that touch a void that does.
    std::vector<bool> is_shared;
};
BlockAreas find_areas(const lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks,
                      DataBorder border);

}  // namespace relevo::ingest
