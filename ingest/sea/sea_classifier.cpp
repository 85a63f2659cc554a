#include "ingest/sea/sea_classifier.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace relevo::ingest {

using Request = lod::SeaInfo::Request;

namespace {

SeaRequest request_of(Request kind) {
    SeaRequest request;
    request.kind = kind;
    return request;
}

}  // namespace

SeaRequest sea_request_from(const std::string& word) {
    if (word.empty()) return {};
    if (word == "auto") return request_of(Request::automatic);
    if (word == "none") return request_of(Request::none);
    if (word == "depths") return request_of(Request::depths);
    SeaRequest request = request_of(Request::mask);
    request.mask_file = word;
    return request;
}

SeaClassifier::SeaClassifier(const geo::GridFrame& frame, const SeaRequest& request, int block_side)
    : frame_(frame),
      request_(request),
      block_side_(block_side),
      across_((frame.columns + block_side - 1) / block_side),
      down_((frame.rows + block_side - 1) / block_side) {
    assert(block_side > 0);
    const auto blocks = static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_);
    if (!needs_blocks()) return;
    shared_.resize(blocks);
    sides_.resize(2 * blocks);
}

Result<SeaClassifier> SeaClassifier::create(const geo::GridFrame& frame, const SeaRequest& request,
                                            int block_side) {
    SeaClassifier classifier{frame, request, block_side};
    if (request.kind == Request::mask) {
        auto mask = SeaMask::open(request.mask_file, request.trust, frame);
        if (!mask) return mask.error();
        classifier.mask_ = std::make_unique<SeaMask>(std::move(*mask));
    }
    return classifier;
}

bool SeaClassifier::needs_blocks() const {
    return request_.kind != Request::mask && request_.kind != Request::none && request_.zero_is_sea_level;
}

Window SeaClassifier::window(Block block) const {
    const int column = block.column * block_side_;
    const int row = block.row * block_side_;
    return {column, row, std::min(block_side_, frame_.columns - column),
            std::min(block_side_, frame_.rows - row)};
}

DataBorder SeaClassifier::border(Block block) const {
    const bool round = frame_.closes();
    return {block.column == 0 && !round, block.column + 1 == across_ && !round, block.row == 0,
            block.row + 1 == down_};
}

// --- first pass

void SeaClassifier::add_block(int block_column, int block_row, const lod::Raster<float>& heights,
                              const lod::Raster<lod::PostMark>& marks) {
    assert(!decided_ && needs_blocks());
    const Block block{block_column, block_row};
    assert(heights.columns() == window(block).columns && heights.rows() == window(block).rows);
    const BlockAreas found = find_areas(heights, marks, border(block));

    const std::lock_guard lock{*adding_};
    assert(shared_[index(block)].empty());
    std::vector<std::uint32_t> ids(found.areas.size(), kNoArea);
    for (std::size_t i = 0; i < found.areas.size(); ++i) {
        if (!found.is_shared[i]) continue;
        ids[i] = static_cast<std::uint32_t>(areas_.size());
        shared_[index(block)].push_back(ids[i]);
        parent_.push_back(ids[i]);
        areas_.push_back(found.areas[i]);
    }
    for (const SeaContact& contact : found.contacts) {
        if (ids[contact.low] != kNoArea && ids[contact.gap] != kNoArea)
            contacts_.push_back({ids[contact.low], ids[contact.gap], contact.shallow, contact.deep});
    }
    keep_sides(block, found, heights, marks);
}

void SeaClassifier::keep_sides(Block block, const BlockAreas& found, const lod::Raster<float>& heights,
                               const lod::Raster<lod::PostMark>& marks) {
    std::vector<std::uint32_t> ids(found.areas.size(), kNoArea);
    auto next = shared_[index(block)].begin();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (found.is_shared[i]) ids[i] = *next++;
    }
    const auto post = [&](int column, int row) {
        const std::int32_t number = found.number.at(column, row);
        return SidePost{number == BlockAreas::kLand ? kNoArea : ids[static_cast<std::size_t>(number)],
                        sea_band(heights.at(column, row), marks.at(column, row))};
    };
    const auto column_side = [&](int column) {
        Side side;
        for (int r = 0; r < heights.rows(); ++r) side.push_back(post(column, r));
        return side;
    };
    const auto row_side = [&](int row) {
        Side side;
        for (int c = 0; c < heights.columns(); ++c) side.push_back(post(c, row));
        return side;
    };
    // A boundary is named by the block to its west (even numbers) or north (odd ones). Round the earth the
    // last column is the first one again.
    const DataBorder ends = border(block);
    const int west = block.column == 0 ? across_ - 1 : block.column - 1;
    if (!ends.west) meet(2 * index({west, block.row}), column_side(0));
    if (!ends.east) meet(2 * index(block), column_side(heights.columns() - 1));
    if (!ends.north) meet(2 * index({block.column, block.row - 1}) + 1, row_side(0));
    if (!ends.south) meet(2 * index(block) + 1, row_side(heights.rows() - 1));
}

void SeaClassifier::meet(std::size_t boundary, Side side) {
    Side& waiting = sides_[boundary];
    if (waiting.empty()) {
        waiting = std::move(side);
        return;
    }
    join(waiting, side);
    waiting = {};
}

void SeaClassifier::join(const Side& one, const Side& other) {
    assert(one.size() == other.size());
    for (std::size_t i = 0; i < one.size(); ++i) join(one[i], other[i]);
}

void SeaClassifier::join(const SidePost& a, const SidePost& b) {
    const bool a_void = a.band == SeaBand::none;
    const bool b_void = b.band == SeaBand::none;
    if (a.area != kNoArea && b.area != kNoArea && a_void == b_void) {
        const std::uint32_t x = root(a.area);
        const std::uint32_t y = root(b.area);
        if (x == y) return;
        areas_[x].add(areas_[y]);
        parent_[y] = x;
    } else if (a_void != b_void) {
        const SidePost& gap = a_void ? a : b;
        const SidePost& valid = a_void ? b : a;
        ++areas_[root(gap.area)].contacts[static_cast<std::size_t>(valid.band)];
        if (!is_low(valid.band)) return;
        ++areas_[root(valid.area)].void_contacts;
        const bool deep = valid.band == SeaBand::deep;
        contacts_.push_back({valid.area, gap.area, deep ? 0U : 1U, deep ? 1U : 0U});
    }
}

std::uint32_t SeaClassifier::root(std::uint32_t area) const {
    while (parent_[area] != area) {
        parent_[area] = parent_[parent_[area]];
        area = parent_[area];
    }
    return area;
}

// --- decision

const lod::SeaInfo& SeaClassifier::decide() {
    assert(!decided_);
    decided_ = true;
    // Whole areas alone, in new numbers; every shared area then has the number of its whole.
    std::vector<SeaArea> whole;
    std::vector<std::uint32_t> number(areas_.size());
    for (std::uint32_t i = 0; i < areas_.size(); ++i) {
        if (root(i) != i) continue;
        number[i] = static_cast<std::uint32_t>(whole.size());
        whole.push_back(areas_[i]);
    }
    for (std::uint32_t i = 0; i < areas_.size(); ++i) {
        if (root(i) != i) number[i] = number[root(i)];
    }
    for (SeaContact& contact : contacts_) {
        contact.low = number[contact.low];
        contact.gap = number[contact.gap];
    }
    combine(contacts_);
    for (auto& block : shared_) {
        for (std::uint32_t& area : block) area = number[area];
    }
    rule_ = SeaRule{request_.kind, whole, contacts_};
    if (!request_.zero_is_sea_level) rule_.say_sea_level_is_elsewhere();
    if (mask_) rule_.set_mask(mask_->name());
    areas_ = std::move(whole);
    parent_ = {};
    contacts_ = {};
    sides_ = {};
    return rule_.info();
}

// --- second pass

/// Of each area of the block, whether it is sea.
std::vector<bool> SeaClassifier::decide_in_block(Block block, const BlockAreas& found) const {
    const std::vector<std::uint32_t>& shared = shared_[index(block)];
    std::vector<std::uint32_t> whole(found.areas.size(), kNoArea);
    std::vector<bool> sea(found.areas.size());
    auto next = shared.begin();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (!found.is_shared[i]) continue;
        assert(next != shared.end());
        whole[i] = *next++;
        sea[i] = rule_.is_sea(whole[i]);
    }
    // Low areas inside the block touch the border of the data nowhere.
    std::vector<SeaContact> touch(found.areas.size());
    for (const SeaContact& contact : found.contacts) {
        if (whole[contact.gap] == kNoArea || !rule_.is_open_void(whole[contact.gap])) continue;
        touch[contact.low].shallow += contact.shallow;
        touch[contact.low].deep += contact.deep;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (whole[i] == kNoArea && !found.areas[i].is_void)
            sea[i] = rule_.low_is_sea(found.areas[i], touch[i].shallow, touch[i].deep);
    }
    std::vector<bool> touches_large_sea(found.areas.size());
    for (const SeaContact& contact : found.contacts) {
        if (sea[contact.low] && whole[contact.low] != kNoArea &&
            areas_[whole[contact.low]].posts >= kTellingArea)
            touches_large_sea[contact.gap] = true;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (whole[i] == kNoArea && found.areas[i].is_void)
            sea[i] = rule_.void_is_sea(found.areas[i], touches_large_sea[i]);
    }
    return sea;
}

Result<std::uint64_t> SeaClassifier::mark_block(int block_column, int block_row,
                                                const lod::Raster<float>& heights,
                                                lod::Raster<lod::PostMark>& marks) const {
    assert(decided_);
    const Block block{block_column, block_row};
    if (!mask_ && !needs_blocks()) return std::uint64_t{0};
    lod::Raster<std::uint8_t> is_sea(marks.columns(), marks.rows());
    if (mask_) {
        if (auto done = mask_->read(window(block), is_sea); !done) return done.error();
    } else {
        const BlockAreas found = find_areas(heights, marks, border(block));
        const std::vector<bool> sea = decide_in_block(block, found);
        for (std::size_t i = 0; i < is_sea.samples().size(); ++i) {
            const std::int32_t number = found.number.samples()[i];
            is_sea.samples()[i] = number != BlockAreas::kLand && sea[static_cast<std::size_t>(number)];
        }
    }
    std::uint64_t modelled = 0;
    for (std::size_t i = 0; i < is_sea.samples().size(); ++i) {
        if (is_sea.samples()[i] == 0) continue;
        lod::PostMark& mark = marks.samples()[i];
        if (mark.is_void()) {
            mark.set_modelled();
            ++modelled;
        }
        mark.set_class(lod::PostClass::sea);
    }
    return modelled;
}

}  // namespace relevo::ingest
