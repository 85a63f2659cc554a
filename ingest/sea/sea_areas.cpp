#include "ingest/sea/sea_areas.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace relevo::ingest {
namespace {

using Bands = lod::Raster<SeaBand>;

struct Post {
    int column;
    int row;
};

enum class Kind { land, low, gap };

Kind kind(SeaBand band) {
    if (band == SeaBand::none) return Kind::gap;
    return is_low(band) ? Kind::low : Kind::land;
}

Bands bands_of(const lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks) {
    Bands bands(heights.columns(), heights.rows());
    for (std::size_t i = 0; i < bands.samples().size(); ++i)
        bands.samples()[i] = sea_band(heights.samples()[i], marks.samples()[i]);
    return bands;
}

/// Grows one area from its first post.
class Growth {
  public:
    Growth(const Bands& bands, const lod::Raster<float>& heights, DataBorder border, BlockAreas& found)
        : bands_(bands), heights_(heights), border_(border), found_(found) {}

    void grow(Post first) {
        const auto number = static_cast<std::int32_t>(found_.areas.size());
        found_.areas.emplace_back();
        found_.areas.back().is_void = kind(bands_.at(first.column, first.row)) == Kind::gap;
        found_.is_shared.push_back(false);
        found_.number.at(first.column, first.row) = number;
        waiting_.push_back(first);
        while (!waiting_.empty()) {
            const Post post = waiting_.back();
            waiting_.pop_back();
            count(post, number);
            visit({post.column - 1, post.row}, post, number);
            visit({post.column + 1, post.row}, post, number);
            visit({post.column, post.row - 1}, post, number);
            visit({post.column, post.row + 1}, post, number);
        }
    }

  private:
    void count(Post post, std::int32_t number) {
        SeaArea& area = found_.areas[static_cast<std::size_t>(number)];
        ++area.posts;
        const bool west = post.column == 0;
        const bool east = post.column + 1 == bands_.columns();
        const bool north = post.row == 0;
        const bool south = post.row + 1 == bands_.rows();
        if (west || east || north || south) found_.is_shared[static_cast<std::size_t>(number)] = true;
        const bool at_border = (west && border_.west) || (east && border_.east) || (north && border_.north) ||
                               (south && border_.south);
        if (area.is_void) {
            area.reaches_border |= at_border;
            return;
        }
        const SeaBand band = bands_.at(post.column, post.row);
        if (band == SeaBand::zero) ++area.zeros;
        if (at_border) ++(band == SeaBand::deep ? area.border_deep : area.border_shallow);
        area.lowest = std::min(area.lowest, heights_.at(post.column, post.row));
    }

    void visit(Post next, Post from, std::int32_t number) {
        if (next.column < 0 || next.row < 0 || next.column >= bands_.columns() || next.row >= bands_.rows())
            return;
        const SeaBand here = bands_.at(from.column, from.row);
        const SeaBand there = bands_.at(next.column, next.row);
        SeaArea& area = found_.areas[static_cast<std::size_t>(number)];
        if (kind(there) == kind(here)) {
            std::int32_t& seen = found_.number.at(next.column, next.row);
            if (seen != BlockAreas::kLand) return;
            seen = number;
            waiting_.push_back(next);
        } else if (area.is_void) {
            ++area.contacts[static_cast<std::size_t>(there)];
        } else if (there == SeaBand::none) {
            ++area.void_contacts;
        }
    }

    const Bands& bands_;
    const lod::Raster<float>& heights_;
    DataBorder border_;
    BlockAreas& found_;
    std::vector<Post> waiting_;
};

/// Pairs of low and void neighbours, from left to right and from top to bottom.
std::vector<SeaContact> contacts_of(const Bands& bands, const lod::Raster<std::int32_t>& number) {
    std::vector<SeaContact> contacts;
    const auto look = [&](Post a, Post b) {
        SeaBand low = bands.at(a.column, a.row);
        if (low == SeaBand::none) {
            std::swap(a, b);
            low = bands.at(a.column, a.row);
        }
        if (!is_low(low) || bands.at(b.column, b.row) != SeaBand::none) return;
        const bool deep = low == SeaBand::deep;
        contacts.push_back({static_cast<std::uint32_t>(number.at(a.column, a.row)),
                            static_cast<std::uint32_t>(number.at(b.column, b.row)), deep ? 0U : 1U,
                            deep ? 1U : 0U});
    };
    for (int r = 0; r < bands.rows(); ++r) {
        for (int c = 0; c < bands.columns(); ++c) {
            if (c + 1 < bands.columns()) look({c, r}, {c + 1, r});
            if (r + 1 < bands.rows()) look({c, r}, {c, r + 1});
        }
    }
    combine(contacts);
    return contacts;
}

}  // namespace

SeaBand sea_band(float height, lod::PostMark mark) {
    if (mark.is_void()) return SeaBand::none;
    if (height < kSeaBeginsAt) return SeaBand::deep;
    if (height < 0) return SeaBand::shallow;
    if (height == 0) return SeaBand::zero;
    return height <= kLowCoast ? SeaBand::coast : SeaBand::high;
}

void SeaArea::add(const SeaArea& part) {
    assert(is_void == part.is_void);
    posts += part.posts;
    zeros += part.zeros;
    border_shallow += part.border_shallow;
    border_deep += part.border_deep;
    void_contacts += part.void_contacts;
    lowest = std::min(lowest, part.lowest);
    reaches_border |= part.reaches_border;
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i] += part.contacts[i];
}

void combine(std::vector<SeaContact>& contacts) {
    std::sort(contacts.begin(), contacts.end(), [](const SeaContact& a, const SeaContact& b) {
        return std::tie(a.low, a.gap) < std::tie(b.low, b.gap);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (kept > 0 && contacts[kept - 1].low == contacts[i].low &&
            contacts[kept - 1].gap == contacts[i].gap) {
            contacts[kept - 1].shallow += contacts[i].shallow;
            contacts[kept - 1].deep += contacts[i].deep;
        } else {
            contacts[kept++] = contacts[i];
        }
    }
    contacts.resize(kept);
}

BlockAreas find_areas(const lod::Raster<float>& heights, const lod::Raster<lod::PostMark>& marks,
                      DataBorder border) {
    assert(heights.columns() == marks.columns() && heights.rows() == marks.rows());
    const Bands bands = bands_of(heights, marks);
    BlockAreas found;
    found.number = lod::Raster<std::int32_t>(bands.columns(), bands.rows(), BlockAreas::kLand);
    Growth growth{bands, heights, border, found};
    for (int r = 0; r < bands.rows(); ++r) {
        for (int c = 0; c < bands.columns(); ++c) {
            if (kind(bands.at(c, r)) != Kind::land && found.number.at(c, r) == BlockAreas::kLand)
                growth.grow({c, r});
        }
    }
    found.contacts = contacts_of(bands, found.number);
    for (const SeaContact& contact : found.contacts) {
        if (found.is_shared[contact.gap] && found.areas[contact.low].posts >= kTellingArea)
            found.is_shared[contact.low] = true;
    }
    return found;
}

}  // namespace relevo::ingest
