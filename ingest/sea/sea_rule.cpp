#include "ingest/sea/sea_rule.hpp"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

namespace relevo::ingest {
namespace {

using Request = lod::SeaInfo::Request;
using Rule = lod::SeaInfo::Rule;

/// No dry land and no lake's floor is as deep, metres (Baikal's is at -1187).
constexpr float kDeeperThanLand = -1200;

bool searches(Request request) {
    return request != Request::none && request != Request::mask;
}

std::uint64_t all_contacts(const SeaArea& gap) {
    std::uint64_t sum = 0;
    for (const auto count : gap.contacts) sum += count;
    return sum;
}

std::uint64_t contacts(const SeaArea& gap, SeaBand band) {
    return gap.contacts[static_cast<std::size_t>(band)];
}

/// With posts where open sea can begin.
std::uint64_t sea_contacts(const SeaArea& gap) {
    return contacts(gap, SeaBand::shallow) + contacts(gap, SeaBand::zero);
}

/// Surrounded by posts where open sea can begin, but for 1 %.
bool lies_in_sea(const SeaArea& gap) {
    return sea_contacts(gap) > 0 && 100 * sea_contacts(gap) >= 99 * all_contacts(gap);
}

/// An area of its own, and not the beach of the void beside it.
bool is_broad(const SeaArea& low) {
    return low.posts >= kTellingArea && low.posts >= 8 * low.void_contacts;
}

}  // namespace

SeaRule::SeaRule(Request request, const std::vector<SeaArea>& areas, const std::vector<SeaContact>& contacts)
    : sea_(areas.size()), open_void_(areas.size()), touch_(areas.size()) {
    info_.request = request;
    info_.rule = request == Request::none   ? Rule::none
                 : request == Request::mask ? Rule::mask
                                            : Rule::nothing;
    if (searches(request)) {
        for (std::size_t i = 0; i < areas.size(); ++i) {
            open_void_[i] = areas[i].is_void && areas[i].reaches_border;
            touch_[i] = {areas[i].border_shallow, areas[i].border_deep};
        }
        for (const SeaContact& contact : contacts) {
            if (!open_void_[contact.gap]) continue;
            touch_[contact.low].shallow += contact.shallow;
            touch_[contact.low].deep += contact.deep;
        }
        find_sea_of_nodata(areas, contacts);
        weigh_low_areas(areas);
        decide_low_areas(areas);
        decide_voids(areas, contacts);
    }
    describe();
}

/// Nodata at the data's border is the sea itself where its coast is low: some of it within the band in which
/// open sea begins, a quarter of it not above kLowCoast, and hardly any of it a sea that the heights show
/// already (then nodata is where nobody measured).
void SeaRule::find_sea_of_nodata(const std::vector<SeaArea>& areas, const std::vector<SeaContact>& pairs) {
    std::vector<std::uint64_t> plain(areas.size());  // contacts of a void with broad plains of 0
    std::vector<std::uint64_t> below(areas.size());  // and with broad areas below 0
    for (const SeaContact& contact : pairs) {
        const SeaArea& low = areas[contact.low];
        if (is_broad(low))
            (low.is_level_zero() ? plain : below)[contact.gap] += contact.shallow + contact.deep;
    }
    const auto shows_nothing_else = [&](std::size_t i) {
        const std::uint64_t all = all_contacts(areas[i]);
        return 10 * plain[i] < all && 2 * below[i] < all;
    };
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const SeaArea& gap = areas[i];
        if (!open_void_[i] || !shows_nothing_else(i)) continue;
        const std::uint64_t all = all_contacts(gap);
        const std::uint64_t low = sea_contacts(gap);
        if (100 * low < all || 4 * (low + contacts(gap, SeaBand::coast)) < all) continue;
        sea_[i] = true;
        // Where most of its shore is low the low posts are its own shallows, not land behind a coast.
        if (2 * low < all) nodata_ = true;
    }
    if (!nodata_) return;
    // The same sea where another coast of it shows, without a low post.
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const SeaArea& gap = areas[i];
        const std::uint64_t low = sea_contacts(gap);
        if (open_void_[i] && shows_nothing_else(i) && 2 * low < all_contacts(gap) &&
            2 * (low + contacts(gap, SeaBand::coast)) >= all_contacts(gap))
            sea_[i] = true;
    }
}

/// What the low areas together say of how the data shows the sea.
void SeaRule::weigh_low_areas(const std::vector<SeaArea>& areas) {
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const SeaArea& low = areas[i];
        if (low.is_void || low.posts < kTellingArea || !touch_[i].any()) continue;
        if (touch_[i].begins_sea()) {
            level_zero_ |= low.is_level_zero();
        } else {
            const bool accepted = info_.request == Request::automatic && low.lowest < kDeeperThanLand;
            depths_ |= !accepted;
        }
    }
}

bool SeaRule::low_is_sea(const SeaArea& area, std::uint64_t shallow, std::uint64_t deep) const {
    const Touch touch{shallow, deep};
    if (!searches(info_.request) || !touch.any()) return false;
    if (info_.request == Request::depths) return true;
    if (!touch.begins_sea()) return info_.request == Request::automatic && area.lowest < kDeeperThanLand;
    // Where the data shows the sea in a better way, heights below 0 at the border are land that was cut.
    if (level_zero_ || nodata_) return area.is_level_zero();
    return !depths_;
}

void SeaRule::decide_low_areas(const std::vector<SeaArea>& areas) {
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const SeaArea& low = areas[i];
        if (low.is_void || !touch_[i].any()) continue;
        sea_[i] = low_is_sea(low, touch_[i].shallow, touch_[i].deep);
        if (low.posts < kTellingArea) continue;  // their number depends on the blocks
        if (sea_[i]) {
            ++info_.low_areas_sea;
            info_.beginnings += touch_[i].shallow;
            if (!touch_[i].begins_sea())
                info_.rule = Rule::depths;
            else if (info_.rule != Rule::depths)
                info_.rule = level_zero_ ? Rule::level_zero : Rule::low_border;
        } else {
            ++info_.low_areas_land;
            info_.lowest_land_m = std::min(info_.lowest_land_m, static_cast<double>(low.lowest));
        }
    }
}

bool SeaRule::void_is_sea(const SeaArea& area, bool touches_large_sea) const {
    return touches_large_sea && lies_in_sea(area);
}

void SeaRule::decide_voids(const std::vector<SeaArea>& areas, const std::vector<SeaContact>& pairs) {
    std::vector<bool> touches(areas.size());
    for (const SeaContact& contact : pairs) {
        if (sea_[contact.low] && areas[contact.low].posts >= kTellingArea) touches[contact.gap] = true;
    }
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (!areas[i].is_void) continue;
        if (sea_[i] && info_.rule != Rule::depths) info_.rule = Rule::nodata;
        if (void_is_sea(areas[i], touches[i])) sea_[i] = true;
        if (sea_[i] && open_void_[i]) ++info_.void_areas_sea;
    }
}

void SeaRule::say_sea_level_is_elsewhere() {
    if (searches(info_.request))
        info_.text =
            "heights are above the ellipsoid, where the sea is not at 0 m: none was looked for. --sea FILE "
            "says where it is";
}

void SeaRule::describe() {
    switch (info_.rule) {
        case Rule::none:
            info_.text = "no sea was asked for";
            break;
        case Rule::mask:
            info_.text = "a file says where the sea is";
            break;
        case Rule::nothing:
            info_.text = "no open sea: nothing from -15 to 0 m reaches the data's border or nodata";
            break;
        case Rule::level_zero:
            info_.text = "the sea is a plain of exactly 0 m that reaches the data's border or nodata";
            break;
        case Rule::nodata:
            info_.text = "the sea is nodata at the data's border with a low coast; what has heights is land";
            break;
        case Rule::depths:
            info_.text = "the sea is what lies below 0 m and reaches the data's border: it has depths";
            break;
        case Rule::low_border:
            info_.text =
                "heights from -15 to 0 m reach the data's border: taken for sea. If it is dry land that was "
                "cut there, say so with --sea none";
            break;
    }
    if (info_.low_areas_land > 0)
        info_.text += fmt::format(
            "; low ground down to {:.6g} m reaches the border and was taken for land: if it is a sea bed, "
            "say "
            "so with --sea depths",
            info_.lowest_land_m);
}

}  // namespace relevo::ingest
