#pragma once

#include <memory>

#include "lod/terrain.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ground/ground_pages.hpp"

namespace relevo::viewer {

/// What the terrain's fragments read of the data, whatever the mesh is (shaders/ground.glsl): the pages that
/// a picture wants, each in a layer of an array, and a table that says which is where. Scenes may have any
/// size: only memory for their pages on the screen is needed.
class GroundTextures {
  public:
    /// What is referred to must outlive the textures. Fails where the coarsest page cannot be read, or the
    /// pages do not fit in the driver's memory.
    static Result<GroundTextures> create(const lod::Terrain& terrain, const GroundData& data);

    const GroundFacts& facts() const { return facts_; }
    int top() const { return pages_->table().top(); }
    const GroundPages& pages() const { return *pages_; }

    /// Has what a picture needs loaded in the background, and hands over what has come: for about 2 ms.
    void update(const Sight& sight, double exaggeration);

    /// As update, but waits for all. Fails where some of it is damaged.
    Result<void> complete(const Sight& sight, double exaggeration);

    /// Pages that are wanted and not there yet.
    std::size_t pending() const { return pages_->pending(); }

    /// Is there room for all that a picture wants? Else the finest of its ground is left out.
    bool fits(const Sight& sight, double exaggeration) const { return pages_->fits(sight, exaggeration); }

    /// Binds all to the units that the shader says.
    void bind() const;

  private:
    GroundTextures() = default;
    void upload_table();

    GroundFacts facts_;
    GlTexture posts_;
    GlTexture shore_;  // only where there is sea
    GlTexture cells_;  // only where there are voids
    GlBuffer table_entries_;
    GlTexture table_;  // the same, as shaders take it
    std::unique_ptr<GroundPages> pages_;
};

}  // namespace relevo::viewer
