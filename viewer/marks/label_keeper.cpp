#include "viewer/marks/label_keeper.hpp"

#include "viewer/overlay/overlay.hpp"

namespace relevo::viewer {

std::vector<MapLabel> labels_of(const Renderer& renderer, const lod::Terrain& terrain, const ViewState& state,
                                const lod::View& view) {
    std::vector<MapLabel> labels;
    const LabelOptions options{.exaggeration = state.exaggeration};
    const auto interval = renderer.contour_interval_m();
    if (interval && find(state.overlays, Overlay::Kind::contours) != nullptr)
        labels = contour_labels(terrain, view, *interval, options);
    const auto graticule = renderer.graticule();
    if (graticule && find(state.overlays, Overlay::Kind::graticule) != nullptr) {
        const auto more = graticule_labels(terrain, view, *graticule, options);
        labels.insert(labels.end(), more.begin(), more.end());
    }
    return labels;
}

const std::vector<MapLabel>& LabelKeeper::labels(const lod::Terrain& terrain, const Renderer& renderer,
                                                 const ViewState& state, const lod::View& view,
                                                 bool ground_rests) {
    constexpr std::chrono::milliseconds kEvery{100};
    const auto now = std::chrono::steady_clock::now();
    std::string seen = to_string(state);
    if ((ground_rests && seen == seen_) || now - made_ < kEvery) return labels_;
    made_ = now;
    seen_ = std::move(seen);
    labels_ = labels_of(renderer, terrain, state, view);
    return labels_;
}

}  // namespace relevo::viewer
