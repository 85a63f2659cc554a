#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "lod/lstr/chunk_making.hpp"
#include "lod/lstr/chunk_mesher.hpp"
#include "lod/oracle.hpp"
#include "viewer/bench/machine.hpp"
#include "viewer/gl/gl_check.hpp"
#include "viewer/renderer.hpp"

namespace relevo::lstr_tables {

using Clock = std::chrono::steady_clock;

template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return *std::move(result);
}
inline void must(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().message);
}

inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

enum class Method { lstr, soar };

/// How a row of a table is drawn.
struct Setting {
    Method method = Method::lstr;
    double tau_px = 1;
    lod::SelectionOptions selection = {.fade_s = 0};
    bool joined = false;  // nodes are not kept in graphics memory, but made one mesh each frame
    double view_distance_m = std::numeric_limits<double>::infinity();

    lod::RefineOptions refine() const { return {.tau_px = tau_px, .view_distance_m = view_distance_m}; }
};

struct Row {
    double frames_s = 0;
    double triangles = 0;  // the mean over the frames, as all below
    double resident_mib = 0;
    double draw_calls = 0;
    double made_ms = 0;  // from a view to its shape handed over
    double nodes_drawn = 0;
    double nodes_in_memory = 0;
    double nodes_sent_kib = 0;
    double largest_error_px = 0;
};

/// A scene with what draws it, off-screen. \pre an OpenGL context is current
class Stage {
  public:
    Stage(const std::string& folder, int width, int height, const lod::ChunkStoreOptions& store = {})
        : scene_(must(lod::Scene::open(folder))),
          terrain_(must(lod::Terrain::open(scene_, lod::ErrorMetric::bounded, {.fade_s = 0}))),
          width_(width),
          height_(height),
          store_(store),
          target_(must(viewer::RenderTarget::create(width, height, 1))),
          refiner_(terrain_) {
        must(lod::provide_chunks(scene_, terrain_));
        renderer_ = std::make_unique<viewer::Renderer>(must(viewer::Renderer::create(
            terrain_, {.pyramid = terrain_.pyramid().get(), .facts = viewer::ground_facts(scene_.info())})));
    }

    const lod::Terrain& terrain() const { return terrain_; }
    double spacing_m() const {
        const geo::GridFrame& frame = terrain_.frame();
        return frame.spacing({0.5 * frame.columns, 0.5 * frame.rows}).row_m;
    }

    /// Metres to the north of the scene's middle.
    lod::Camera camera(double north_m, double H_m, double pitch) const {
        const geo::GridFrame& frame = terrain_.frame();
        const geo::GridPosition place{0.5 * (frame.columns - 1),
                                      0.5 * (frame.rows - 1) - north_m / spacing_m()};
        const geo::LatLon at = frame.lat_lon(place);
        lod::Camera camera;
        camera.eye = {at.lat, at.lon, {terrain_.undulations().at(place) + H_m}};
        camera.pitch = geo::Degrees{pitch};
        camera.width = width_;
        camera.height = height_;
        return camera;
    }
    /// Of the reference's path, at twice the highest post.
    lod::View view_at(double part) const {
        const double side_m = terrain_.frame().rows * spacing_m();
        return lod::View(camera(side_m * (-0.45 + 0.6 * part), 7500, -20));
    }

    /// Draws a view of what is in memory.
    viewer::DrawnGround draw(const lod::View& view, const Setting& setting, Row* row = nullptr) {
        const auto start = Clock::now();
        const viewer::DrawnGround ground = ground_of(view, setting);
        renderer_->upload(ground);
        const double made_ms = 1e3 * seconds_since(start);
        const auto drawn = must(renderer_->draw(view, settings_, target_));
        viewer::gl_finish();
        if (row != nullptr) {
            row->made_ms += made_ms;
            row->triangles += static_cast<double>(viewer::triangles(ground));
            row->draw_calls += drawn.draw_calls;
            const auto figures = chunks(setting).figures();
            row->nodes_drawn += figures.drawn_nodes;
            row->nodes_in_memory += static_cast<double>(figures.store.resident_nodes);
            row->nodes_sent_kib += static_cast<double>(renderer_->node_figures().sent_bytes) / 1024;
        }
        return ground;
    }

    /// Waits until all that the path wants is there: what is measured then is drawing.
    void load_path(const Setting& setting) {
        constexpr int kStops = 30;
        for (int k = 0; k <= kStops; ++k) {
            const lod::View view = view_at(static_cast<double>(k) / kStops);
            settle(view, setting);
            must(renderer_->complete(view, settings_, {0, 0, width_, height_}));
        }
    }

    /// Flies the path once.
    Row fly(const Setting& setting, int frames) {
        Row row;
        draw(view_at(0), setting);
        const auto start = Clock::now();
        for (int k = 0; k < frames; ++k) draw(view_at(static_cast<double>(k) / (frames - 1)), setting, &row);
        row.frames_s = frames / seconds_since(start);
        for (double* sum : {&row.triangles, &row.draw_calls, &row.made_ms, &row.nodes_drawn,
                            &row.nodes_in_memory, &row.nodes_sent_kib})
            *sum /= frames;
        row.resident_mib = viewer::resident_mib();
        return row;
    }

    /// The largest error that the oracle finds at places of the path, pixels.
    double largest_error_px(const Setting& setting) {
        constexpr int kPlaces = 6;
        double worst_px = 0;
        for (int k = 0; k < kPlaces; ++k) {
            const lod::View view = view_at(static_cast<double>(k) / (kPlaces - 1));
            settle(view, setting);
            const auto error = lod::measure_error(terrain_, view, mesh_of(view, ground_of(view, setting)));
            if (error) worst_px = std::max(worst_px, error->max_px);
        }
        return worst_px;
    }

    lod::ChunkMesher& chunks(const Setting& setting) {
        if (!chunks_)
            chunks_ = std::make_unique<lod::ChunkMesher>(terrain_, *terrain_.chunks(),
                                                         lod::ChunkOptions{.store = store_, .selection = {}});
        chunks_->selection() = setting.selection;
        return *chunks_;
    }

    /// \pre  made last
    const lod::Mesh& mesh_of(const lod::View& view, const viewer::DrawnGround& ground) {
        const auto* nodes = std::get_if<lod::ChunkPicture>(&ground);
        return nodes != nullptr ? chunks_->assemble(view, *nodes) : std::get<0>(ground).get();
    }

    /// Pixels that show the background, which is red as no ground is.
    int pixels_without_ground(const lod::View& view, const viewer::DrawnGround& ground) {
        viewer::DrawSettings settings = settings_;
        settings.background = {{1, 0, 0}};
        settings.layer = viewer::Layer::plain;
        renderer_->upload(ground);
        must(renderer_->draw(view, settings, target_));
        viewer::Picture picture(width_, height_);
        target_.read_into(picture, 0, 0);
        int found = 0;
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const std::uint8_t* pixel = picture.pixel(x, y);
                found += pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 0 ? 1 : 0;
            }
        }
        return found;
    }

  private:
    viewer::DrawnGround ground_of(const lod::View& view, const Setting& setting) {
        if (setting.method == Method::lstr) {
            const lod::ChunkPicture nodes = must(chunks(setting).picture(view, setting.refine()));
            if (setting.joined) return chunks_->assemble(view, nodes);
            return nodes;
        }
        terrain_.tiles().start_frame();
        return refiner_.refine(view, setting.refine());
    }
    void settle(const lod::View& view, const Setting& setting) {
        if (setting.method == Method::soar) {
            must(refiner_.refine_whole(view, setting.refine()));
            return;
        }
        lod::ChunkMesher& mesher = chunks(setting);
        must(mesher.picture(view, setting.refine()));
        while (mesher.figures().store.pending_groups > 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            must(mesher.picture(view, setting.refine()));
        }
    }

    lod::Scene scene_;
    lod::Terrain terrain_;
    int width_;
    int height_;
    lod::ChunkStoreOptions store_;
    viewer::RenderTarget target_;
    lod::Refiner refiner_;
    std::unique_ptr<lod::ChunkMesher> chunks_;
    std::unique_ptr<viewer::Renderer> renderer_;
    viewer::DrawSettings settings_;
};

}  // namespace relevo::lstr_tables
