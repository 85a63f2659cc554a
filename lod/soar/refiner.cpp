#include "lod/soar/refiner.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lod/scene/metric_code.hpp"
#include "lod/soar/diamond.hpp"

namespace relevo::lod {

namespace {

/// Kept of tau for the rounding of drawn positions to float.
constexpr double kFloatShare = 1e-3;

/// The band of screen-space errors over which a vertex comes in, such that the drawn error is at most tau:
/// with the morph factor linear in 1 / rho, the integral of rho over it is 2 ln(2) tau_min (docs/design.md).
struct MorphBand {
    double tau_min;
    double tau_max;

    MorphBand(double tau_px, bool morph) {
        const double tau = tau_px * (1 - kFloatShare);
        tau_min = morph ? tau / (2 * std::numbers::ln2) : tau;
        tau_max = morph ? 2 * tau_min : tau;
    }
};

/// One frame's descent through the hierarchy.
class Refinement {
  public:
    Refinement(const Terrain& terrain, const View& view, const RefineOptions& options, Mesh& mesh,
               VertexCache& cache)
        : terrain_(terrain),
          eye_(view.eye().m),
          planes_(view.side_planes()),
          exaggeration_(options.exaggeration),
          morph_(options.morph),
          band_(options.tau_px, options.morph),
          scale_(view.error_scale(options.tau_px)),
          reach_(scale_.lambda_px / band_.tau_min + scale_.kappa),
          last_column_(terrain.frame().columns - 1),
          last_row_(terrain.frame().rows - 1),
          deepest_(2 * terrain.levels()),
          inside_(options.cull ? 0 : kInsideAll),
          mesh_(mesh),
          cache_(cache) {}

    /// The four triangles around the grid's centre.
    void run() {
        const int side = 1 << terrain_.levels();
        const RefinedVertex centre = fixed_vertex({side / 2, side / 2});
        const RefinedVertex corners[] = {fixed_vertex({0, 0}), fixed_vertex({0, side}),
                                         fixed_vertex({side, side}), fixed_vertex({side, 0})};
        for (int k = 0; k < 4; ++k) split(corners[k], corners[(k + 1) % 4], centre, 1, inside_);
    }

  private:
    using InsideFlags = unsigned;  // a bit a side plane: the sphere of an ancestor is wholly inside it
    static constexpr InsideFlags kInsideAll = 0xf;

    glm::dvec3 exact_position(const GridPoint& post, float H) const {
        const double N = terrain_.undulations().at(post.column, post.row);
        return terrain_.positions().at(post.column, post.row, N + exaggeration_ * static_cast<double>(H)) -
               eye_;
    }

    /// A vertex that is always there, where the data has it.
    RefinedVertex fixed_vertex(const GridPoint& post) {
        const glm::dvec3 position = exact_position(post, terrain_.post(post.column, post.row).H);
        return {position, position, post, add_to_mesh(position, post), 0};
    }

    std::uint32_t add_to_mesh(const glm::dvec3& drawn, const GridPoint& post) {
        const auto index = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back({static_cast<float>(drawn.x), static_cast<float>(drawn.y),
                                  static_cast<float>(drawn.z), static_cast<std::uint16_t>(post.column),
                                  static_cast<std::uint16_t>(post.row)});
        return index;
    }

    void emit(const RefinedVertex& left, const RefinedVertex& right, const RefinedVertex& apex) {
        mesh_.indices.insert(mesh_.indices.end(), {left.index, right.index, apex.index});
    }

    /// Is a sphere outside the picture? Sets the flags of the planes that it is wholly inside of.
    bool is_outside(const glm::dvec3& centre, double radius, InsideFlags& inside) const {
        for (unsigned k = 0; k < planes_.size(); ++k) {
            if ((inside & (1u << k)) != 0) continue;
            const double distance = glm::dot(planes_[k], centre);
            if (distance > radius) return true;
            if (distance < -radius) inside |= 1u << k;
        }
        return false;
    }

    /// How far a vertex has come in, in [0, 1]: linear in 1 / rho, so that it needs no more than its
    /// distance.
    double morph_factor(double distance, double error, double radius) const {
        const double clearance = distance - radius - scale_.kappa * error;  // rho = lambda error / clearance
        if (clearance <= 0) return 1;
        const double t = 2 - 2 * band_.tau_min * clearance / (scale_.lambda_px * error);
        return t < 1 ? t : 1;
    }

    /// Draws the triangle (left, right, apex), counter-clockwise seen from above with its right angle at the
    /// apex, or what it is to be refined into. \param level  of the vertex in the middle of its long side
    void split(const RefinedVertex& left, const RefinedVertex& right, const RefinedVertex& apex, int level,
               InsideFlags inside) {
        if (is_padding(left.post, right.post, apex.post)) return;
        if (level == deepest_) return emit(left, right, apex);

        const GridPoint middle = midpoint(left.post, right.post);
        RefinedVertex vertex;
        if (const RefinedVertex* known = cache_.find(middle)) {
            vertex = *known;
            if (inside != kInsideAll && is_outside(vertex.exact, vertex.radius, inside)) return;
        } else {
            const Candidate candidate = look_at(middle, level);
            if (candidate.is_empty) return;
            if (inside != kInsideAll && is_outside(candidate.exact, candidate.radius, inside)) return;
            if (!candidate.is_active) return emit(left, right, apex);
            vertex = draw(candidate, middle, left, right);
            cache_.keep(vertex);
        }
        split(apex, left, vertex, level + 1, inside);
        split(right, apex, vertex, level + 1, inside);
    }

    /// A vertex before it is known whether it is drawn.
    struct Candidate {
        glm::dvec3 exact;  // relative to the eye
        double error;
        double radius;
        double distance2;
        bool is_empty;   // nothing valid in its diamond
        bool is_active;  // its error on the screen exceeds the tolerance
    };

    Candidate look_at(const GridPoint& middle, int level) const {
        const Terrain::Post& post = terrain_.post(middle.column, middle.row);
        Candidate candidate{};
        candidate.is_empty = post.radius == 0;
        if (candidate.is_empty) return candidate;
        candidate.error = static_cast<double>(decode(post.error));
        candidate.radius = static_cast<double>(decode(post.radius));
        if (exaggeration_ != 1) {
            const LevelBound& bare = terrain_.level_bounds()[static_cast<std::size_t>(level)];
            candidate.error = exaggeration_ * candidate.error + std::abs(exaggeration_ - 1) * bare.sag_m;
            candidate.radius = exaggeration_ * candidate.radius + std::abs(exaggeration_ - 1) * bare.radius_m;
        }
        candidate.exact = exact_position(middle, post.H);
        candidate.distance2 = glm::dot(candidate.exact, candidate.exact);
        const double active_within = reach_ * candidate.error + candidate.radius;
        candidate.is_active = candidate.error > 0 && candidate.distance2 < active_within * active_within;
        return candidate;
    }

    RefinedVertex draw(const Candidate& candidate, const GridPoint& post, const RefinedVertex& left,
                       const RefinedVertex& right) {
        glm::dvec3 drawn = candidate.exact;
        if (morph_) {
            const glm::dvec3 surplus = candidate.exact - 0.5 * (left.exact + right.exact);
            const double t = morph_factor(std::sqrt(candidate.distance2), candidate.error, candidate.radius);
            drawn = 0.5 * (left.drawn + right.drawn) + t * surplus;
        }
        return {candidate.exact, drawn, post, add_to_mesh(drawn, post), candidate.radius};
    }

    bool is_padding(const GridPoint& a, const GridPoint& b, const GridPoint& c) const {
        return (a.column >= last_column_ && b.column >= last_column_ && c.column >= last_column_) ||
               (a.row >= last_row_ && b.row >= last_row_ && c.row >= last_row_);
    }

    const Terrain& terrain_;
    const glm::dvec3 eye_;
    const std::array<glm::dvec3, 4> planes_;
    const double exaggeration_;
    const bool morph_;
    const MorphBand band_;
    const View::ErrorScale scale_;
    const double reach_;  // times the error, plus the radius: the distance within which a vertex is drawn
    const int last_column_;
    const int last_row_;
    const int deepest_;
    const InsideFlags inside_;
    Mesh& mesh_;
    VertexCache& cache_;
};

}  // namespace

Refiner::Refiner(const Terrain& terrain) : terrain_(terrain) {}

const Mesh& Refiner::refine(const View& view, const RefineOptions& options) {
    assert(options.tau_px > 0 && options.exaggeration >= 0);
    mesh_.clear();
    cache_.start_frame();
    Refinement(terrain_, view, options, mesh_, cache_).run();
    return mesh_;
}

}  // namespace relevo::lod
