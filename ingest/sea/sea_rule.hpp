#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ingest/sea/sea_areas.hpp"
#include "lod/scene/sea_info.hpp"

namespace relevo::ingest {

/// Decides which areas of a scene are sea. docs/sea.md has the rule and its reasons.
class SeaRule {
  public:
    SeaRule() = default;
    /// \param areas     whole ones, at least those of kTellingArea posts that reach the data's border or a
    ///                  void, and all voids that reach the border
    /// \param contacts  between these; combined, indices into areas
    SeaRule(lod::SeaInfo::Request request, const std::vector<SeaArea>& areas,
            const std::vector<SeaContact>& contacts);

    /// Is the area of this index sea?
    bool is_sea(std::uint32_t area) const { return sea_[area]; }
    /// Is it a void that reaches the data's border?
    bool is_open_void(std::uint32_t area) const { return open_void_[area]; }

    /// For a low area that is not among those of the rule.
    /// \param shallow, deep  its contacts with the data's border and with open voids, by its posts' heights
    bool low_is_sea(const SeaArea& area, std::uint64_t shallow, std::uint64_t deep) const;
    /// For a void that is not: it does not reach the border.
    bool void_is_sea(const SeaArea& area, bool touches_large_sea) const;

    const lod::SeaInfo& info() const { return info_; }
    void say_sea_level_is_elsewhere();
    void set_mask(const std::string& name) { info_.mask = name; }

  private:
    void find_sea_of_nodata(const std::vector<SeaArea>& areas, const std::vector<SeaContact>& contacts);
    void weigh_low_areas(const std::vector<SeaArea>& areas);
    void decide_low_areas(const std::vector<SeaArea>& areas);
    void decide_voids(const std::vector<SeaArea>& areas, const std::vector<SeaContact>& contacts);
    void describe();

    struct Touch {
        std::uint64_t shallow = 0;
        std::uint64_t deep = 0;
        bool any() const { return shallow + deep > 0; }
        /// Most of it is where open sea can begin.
        bool begins_sea() const { return shallow > 0 && shallow >= deep; }
    };

    lod::SeaInfo info_;
    std::vector<bool> sea_;
    std::vector<bool> open_void_;
    std::vector<Touch> touch_;  // of low areas
    bool level_zero_ = false;   // a plain of exactly 0 shows the sea
    bool nodata_ = false;       // nodata does, and what has heights is land
    bool depths_ = false;       // something deep reaches the border and is not taken for sea
};

}  // namespace relevo::ingest
