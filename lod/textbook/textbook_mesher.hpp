#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geo/post_positions.hpp"
#include "geo/result.hpp"
#include "lod/mesh.hpp"
#include "lod/scene/scene.hpp"
#include "lod/textbook/textbook.hpp"
#include "lod/undulation_grid.hpp"
#include "lod/view.hpp"

namespace relevo::lod {

/// Puts the textbook to work on a scene: hands it the camera in its flat world, and takes its strip back to
/// where its posts are on the earth, so that it can be drawn and measured like any other mesh.
///
/// The flat world has the grid's spacing in the middle of the data everywhere; errors are scaled by the focal
/// length, which is exact in the middle of the picture.
class TextbookMesher {
  public:
    /// Reads the whole scene. Of a grid of more posts than kMostPosts it fails with ErrorKind::usage.
    static Result<TextbookMesher> create(const Scene& scene, double exaggeration);
    static constexpr std::uint64_t kMostPosts = 8193ull * 8193;  // of the padded grid: 1 GiB

    /// The textbook's refinement alone: what is to be timed. \param eye_H  of the camera, above the datum
    void refine(const View& view, geo::OrthometricHeight eye_H, double tau_px);

    /// What refine() made, with the true positions of its posts. Triangles of the padding are in it, as the
    /// textbook draws them. Valid until the next call.
    const Mesh& mesh(const View& view);

    /// Of the textbook's posts and the strip.
    std::uint64_t memory_bytes() const;

  private:
    TextbookMesher(const geo::GridFrame& frame, UndulationGrid undulations, Raster<float> heights);

    geo::GridFrame frame_;
    geo::PostPositions positions_;
    UndulationGrid undulations_;
    Raster<float> heights_;  // exaggerated
    geo::GridFrame::Spacing spacing_;
    Textbook textbook_;
    const std::vector<int>* strip_ = nullptr;
    std::unordered_map<int, std::uint32_t> index_of_post_;  // in mesh_; of the last strip's posts
    Mesh mesh_;
};

}  // namespace relevo::lod
