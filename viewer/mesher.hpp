#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include <glm/geometric.hpp>

#include "lod/lstr/chunk_mesher.hpp"
#include "lod/soar/full_mesh.hpp"
#include "lod/soar/refiner.hpp"
#include "viewer/drawn_ground.hpp"
#include "viewer/frame_budget.hpp"
#include "viewer/view_state.hpp"

namespace relevo::viewer {

/// Makes what a view's ground is drawn with, by the method that it asks for.
class Mesher {
  public:
    /// The terrain must outlive the mesher.
    explicit Mesher(const lod::Terrain& terrain, const lod::ChunkOptions& chunks = {})
        : terrain_(terrain), chunk_options_(chunks), refiner_(terrain) {}

    /// Of what is in memory; what is missing is asked for. Valid until the next call.
    DrawnGround ground(const lod::View& view, const ViewState& state) {
        if (state.method == Method::full) return full(view, state);
        if (state.method == Method::lstr) return chunks(view, state);
        terrain_.tiles().start_frame();
        look_ahead(view, options(state));
        return refiner_.refine(view, options(state));
    }

    /// As fine as the budget allows; it is to be told what the frame cost.
    DrawnGround ground(const lod::View& view, ViewState state, FrameBudget& budget) {
        if (state.method == Method::full) return full(view, state);
        state.tau_px = budget.tau_px();
        const DrawnGround first = ground(view, state);
        if (!budget.coarsen(triangles(first))) return first;
        state.tau_px = budget.tau_px();
        if (state.method == Method::lstr) return chunks(view, state);
        return refiner_.refine(view, options(state));
    }

    /// Of all that the view asks for; waits for what is missing.
    Result<DrawnGround> whole_ground(const lod::View& view, const ViewState& state) {
        if (state.method == Method::full) return DrawnGround(full(view, state));
        if (state.method == Method::lstr) {
            const auto nodes = chunk_mesher().whole_picture(view, options(state));
            if (!nodes) return nodes.error();
            return DrawnGround(*nodes);
        }
        const auto mesh = refiner_.refine_whole(view, options(state));
        if (!mesh) return mesh.error();
        return DrawnGround(**mesh);
    }

    /// What was made last as one mesh. \param view  that it was made for
    const lod::Mesh& mesh(const lod::View& view, const DrawnGround& ground) {
        const auto* nodes = std::get_if<lod::ChunkPicture>(&ground);
        return nodes != nullptr ? chunk_mesher().assemble(view, *nodes) : std::get<0>(ground).get();
    }

    /// Of the nodes of the LSTR; none where it has not drawn.
    lod::ChunkMesher::Figures chunk_figures() const {
        return chunk_mesher_ ? chunk_mesher_->figures() : lod::ChunkMesher::Figures{};
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// Where a moving eye will be when what is asked for now has been read.
    void look_ahead(const lod::View& view, const lod::RefineOptions& options) {
        constexpr double kAheadS = 0.7;
        const auto now = Clock::now();
        if (last_eye_) {
            const double passed_s = std::chrono::duration<double>(now - last_time_).count();
            const glm::dvec3 moved = view.eye().m - last_eye_->m;
            if (passed_s > 0 && passed_s < kAheadS && glm::length(moved) > 0.01) {
                lod::Camera camera = view.camera();
                camera.eye = geo::to_geodetic({view.eye().m + moved * (kAheadS / passed_s)});
                refiner_.look_ahead(lod::View(camera), options);
            }
        }
        last_eye_ = view.eye();
        last_time_ = now;
    }

    static lod::RefineOptions options(const ViewState& state) {
        return {.tau_px = state.tau_px, .morph = state.morph, .exaggeration = state.exaggeration};
    }
    const lod::Mesh& full(const lod::View& view, const ViewState& state) {
        full_ = lod::full_mesh(terrain_, view, state.exaggeration);
        return full_;
    }

    /// \pre the terrain has chunks
    lod::ChunkMesher& chunk_mesher() {
        if (!chunk_mesher_) chunk_mesher_.emplace(terrain_, *terrain_.chunks(), chunk_options_);
        return *chunk_mesher_;
    }
    /// Nothing where the root cannot be read.
    DrawnGround chunks(const lod::View& view, const ViewState& state) {
        if (const auto made = chunk_mesher().picture(view, options(state))) return *made;
        full_.clear();
        return full_;
    }

    const lod::Terrain& terrain_;
    const lod::ChunkOptions chunk_options_;
    lod::Refiner refiner_;
    std::optional<lod::ChunkMesher> chunk_mesher_;
    lod::Mesh full_;
    std::optional<geo::Ecef> last_eye_;
    Clock::time_point last_time_;
};

}  // namespace relevo::viewer
