#pragma once

#include <memory>
#include <optional>

#include "lod/scene/scene.hpp"
#include "lod/terrain.hpp"
#include "lod/textbook/textbook_mesher.hpp"
#include "viewer/bench/bench_options.hpp"
#include "viewer/mesher.hpp"

namespace relevo::viewer {

/// One method with what it has in memory: makes what is drawn, and says how long that took. The only place of
/// the benchmark that knows how methods differ.
class BenchMesher {
  public:
    enum class Paging {
        waited_for,   ///< meshes are of all that a view needs, as if it had been in memory
        as_it_comes,  ///< of what is in memory, as in the window; what is missing comes and fades in
    };

    /// Fails with ErrorKind::usage where the scene is too large for the method.
    static Result<std::unique_ptr<BenchMesher>> create(const lod::Scene& scene, BenchMethod method,
                                                       const BenchOptions& options, Paging paging);

    struct Made {
        DrawnGround ground;  ///< valid until the next call
        double refine_ms;
    };
    /// \param view  of the state, in a picture \param budget  that chooses tau, or null
    Result<Made> make(const lod::View& view, const ViewState& state, const BenchSetting& setting,
                      double tau_px, FrameBudget* budget = nullptr);

    /// What was made last as one mesh. \param view  that it was made for
    const lod::Mesh& mesh(const lod::View& view, const Made& made) { return mesher_.mesh(view, made.ground); }

    /// What the renderer draws from and errors are measured against.
    const lod::Terrain& terrain() const { return terrain_; }

    /// Are frames to be drawn with all that they need?
    bool waits() const { return paging_ == Paging::waited_for; }

    /// `full` is not run on more triangles: a software renderer takes 0.1 us for each, every frame.
    static constexpr std::uint64_t kMostFullTriangles = 10'000'000;

  private:
    /// Was all there that the last mesh wanted?
    bool is_whole() const;

    BenchMesher(lod::Terrain terrain, std::optional<lod::TextbookMesher> textbook, Paging paging)
        : terrain_(std::move(terrain)), mesher_(terrain_), textbook_(std::move(textbook)), paging_(paging) {}

    lod::Terrain terrain_;
    Mesher mesher_;  // refers to the terrain: a BenchMesher stays where it was made
    std::optional<lod::TextbookMesher> textbook_;
    Paging paging_;
};

}  // namespace relevo::viewer
