#include "viewer/flight/ground_layers.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "viewer/ground/page_cache.hpp"
#include "viewer/ground/viewshed_drape.hpp"
#include "viewer/overlay/overlay_list.hpp"

namespace relevo::viewer {

Result<void> GroundLayers::check_room() const {
    if (ground_.drapes.size() < GroundData::kMostDrapes && overlays_.size() < kMostOverlays) return {};
    return Error{ErrorKind::input,
                 fmt::format("{} pictures, files of lines and viewsheds are draped, and no more can be: take "
                             "one away in the panel",
                             ground_.drapes.size())};
}

Result<void> GroundLayers::open(const std::filesystem::path& file, FileUse use, const LayerFiles& files) {
    if (auto room = check_room(); !room) return room;
    if (opening()) return Error{ErrorKind::input, fmt::format("{} is being opened; one at a time", name_)};
    name_ = file.filename().string();
    const auto vectors = std::count_if(ground_.drapes.begin(), ground_.drapes.end(),
                                       [](const auto& drape) { return drape->line_colour().has_value(); });
    opening_ =
        std::async(std::launch::async,
                   [file, use, open = files.open, frame = frame_,
                    colour = static_cast<std::size_t>(vectors)]() -> Result<std::shared_ptr<const Drape>> {
                       auto drape = open(file, use, frame, colour);
                       if (!drape) return drape;
                       // Without its coarsest page it could not be drawn at all.
                       const int top = PageCache<DrapeTexels>::top_of(finer_frame(frame, (*drape)->finer()));
                       if (const auto page = (*drape)->read({top, 0, 0}); !page) return page.error();
                       return drape;
                   });
    return {};
}

std::optional<Result<std::string>> GroundLayers::take_opened() {
    if (!opening() || opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    auto drape = opening_.get();
    if (!drape) return Result<std::string>(drape.error());
    if (auto room = check_room(); !room) return Result<std::string>(room.error());
    add(*std::move(drape));
    return Result<std::string>(name_);
}

void GroundLayers::add(std::shared_ptr<const Drape> drape) {
    put_in_place(overlays_,
                 {.kind = drape->line_colour().has_value() ? Overlay::Kind::vectors : Overlay::Kind::imagery,
                  .file = static_cast<int>(ground_.drapes.size())});
    ground_.drapes.push_back(std::move(drape));
    changed_ = true;
}

void GroundLayers::remove(int file) {
    if (file < 0 || static_cast<std::size_t>(file) >= ground_.drapes.size()) return;
    ground_.drapes.erase(ground_.drapes.begin() + file);
    forget_file(overlays_, file);
    changed_ = true;
}

Result<void> GroundLayers::show_viewshed(const std::shared_ptr<const lod::Viewshed>& shed) {
    if (shed == shown_) return {};
    shown_ = shed;
    const auto is_viewshed = [](const std::shared_ptr<const Drape>& drape) { return !drape->is_of_file(); };
    const auto old = std::find_if(ground_.drapes.begin(), ground_.drapes.end(), is_viewshed);
    if (old != ground_.drapes.end() && shed) {  // its place and opacity stay
        *old = std::make_shared<ViewshedDrape>(shed);
        changed_ = true;
        put_in_place(overlays_, {.kind = Overlay::Kind::imagery,
                                 .file = static_cast<int>(old - ground_.drapes.begin())});
    } else if (old != ground_.drapes.end()) {
        remove(static_cast<int>(old - ground_.drapes.begin()));
    } else if (shed) {
        if (auto room = check_room(); !room) return room;
        add(std::make_shared<ViewshedDrape>(shed));
    }
    return {};
}

}  // namespace relevo::viewer
