#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "geo/frame.hpp"
#include "lod/measure/viewshed.hpp"
#include "viewer/flight/layer_files.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/overlay/overlay.hpp"

namespace relevo::viewer {

/// What is draped over the ground while one flies: files that are added and taken away, and a viewshed.
class GroundLayers {
  public:
    /// \param ground  of the renderer, which must be made anew when take_changed() says so
    /// All must outlive it.
    GroundLayers(GroundData& ground, Overlays& overlays, const geo::GridFrame& frame)
        : ground_(ground), overlays_(overlays), frame_(frame) {}

    const Drapes& drapes() const { return ground_.drapes; }

    /// Opens imagery or vectors in the background; take_opened() then puts it in its place. Fails where there
    /// is no room, or another one is being opened.
    Result<void> open(const std::filesystem::path& file, FileUse use, const LayerFiles& files);
    bool opening() const { return opening_.valid(); }
    /// What has come of it, once: the file's name, or what is wrong with it.
    std::optional<Result<std::string>> take_opened();

    void remove(int file);
    /// Shows a viewshed instead of the one before; null: none. Fails where there is no room for it.
    Result<void> show_viewshed(const std::shared_ptr<const lod::Viewshed>& shed);

    /// Are there others than when it was last asked?
    bool take_changed() { return std::exchange(changed_, false); }

  private:
    Result<void> check_room() const;
    void add(std::shared_ptr<const Drape> drape);

    GroundData& ground_;
    Overlays& overlays_;
    geo::GridFrame frame_;
    std::future<Result<std::shared_ptr<const Drape>>> opening_;
    std::string name_;                            // of what is being opened
    std::shared_ptr<const lod::Viewshed> shown_;  // or refused for lack of room
    bool changed_ = false;
};

}  // namespace relevo::viewer
