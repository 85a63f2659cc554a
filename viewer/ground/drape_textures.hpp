#pragma once

#include <memory>

#include "lod/terrain.hpp"
#include "viewer/gl/gl_object.hpp"
#include "viewer/ground/drape.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/ground/page_cache.hpp"

namespace relevo::viewer {

/// Pages of a drape as the terrain's fragments read them (shaders/drape.glsl): as GroundTextures, of another
/// source.
class DrapeTextures {
  public:
    /// What is referred to must outlive the textures. Fails where the coarsest page cannot be read.
    /// \param cache_bytes  of textures; a page at least
    static Result<DrapeTextures> create(const lod::Terrain& terrain, const GroundData& data,
                                        std::shared_ptr<const Drape> drape, std::size_t cache_bytes);

    /// As of GroundTextures.
    void update(const Sight& sight, double exaggeration);
    Result<void> complete(const Sight& sight, double exaggeration);
    std::size_t pending() const { return pages_->pending(); }
    bool fits(const Sight& sight, double exaggeration) const { return pages_->fits(sight, exaggeration); }

    int top() const { return pages_->table().top(); }
    int finer() const { return drape_->finer(); }
    const Drape& drape() const { return *drape_; }

    /// Pages loaded so far, and bytes of textures and buffers.
    std::uint64_t tiles() const { return pages_->loaded(); }
    std::size_t bytes() const { return bytes_; }
    static constexpr int kGlObjects = 3;

    /// Binds all to the units of the number of a drape.
    void bind(int number) const;

  private:
    DrapeTextures() = default;
    void upload_table();

    std::shared_ptr<const Drape> drape_;
    GlTexture texels_;
    GlBuffer table_entries_;
    GlTexture table_;
    std::size_t bytes_ = 0;
    std::unique_ptr<PageCache<DrapeTexels>> pages_;
};

}  // namespace relevo::viewer
