#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "lod/ocean/ocean_mesh.hpp"
#include "viewer/gl/gl_object.hpp"

namespace relevo::viewer {

/// A mesh of the sea in OpenGL: its patches, which stay, and the copies of them that a picture draws.
class MeshBuffers {
  public:
    explicit MeshBuffers(const lod::OceanMesh& mesh);

    /// Hands a picture's copies over: of each patch those in open water, then those at shores.
    void upload(const lod::OceanPicture& picture);

    /// Makes it what is drawn from.
    void bind() const;

    /// Copies of a patch, in the order in which they were handed over.
    struct Run {
        std::size_t patch;
        std::size_t first;
        std::size_t count;
    };
    /// Of the last picture.
    struct Runs {
        std::vector<Run> open, shore;
    };
    const Runs& runs() const { return runs_; }
    void draw(const Run& run) const;

    std::size_t triangles(const Run& run) const { return run.count * patches_[run.patch].indices / 3; }
    std::size_t vertices(const Run& run) const { return run.count * patches_[run.patch].vertices; }

  private:
    struct Patch {
        std::size_t first_vertex, vertices, first_index, indices;
    };
    std::vector<Patch> patches_;
    GlBuffer vertices_, indices_, copies_;
    GlVertexArray array_;
    Runs runs_;
};

}  // namespace relevo::viewer
