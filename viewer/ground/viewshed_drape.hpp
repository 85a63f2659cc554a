#pragma once

#include <memory>

#include "lod/measure/viewshed.hpp"
#include "viewer/ground/drape.hpp"

namespace relevo::viewer {

/// A viewshed over its scene's ground: a texel a post, in the colours of its file (output/viewshed_file.hpp),
/// translucent. Coarser texels are means of up to 16 posts of theirs.
class ViewshedDrape final : public Drape {
  public:
    explicit ViewshedDrape(std::shared_ptr<const lod::Viewshed> shed) : shed_(std::move(shed)) {}

    std::string name() const override { return "viewshed"; }
    bool is_of_file() const override { return false; }
    int finer() const override { return 0; }
    Result<DrapeTexels> read(const Page& page) const override;

  private:
    std::shared_ptr<const lod::Viewshed> shed_;
};

}  // namespace relevo::viewer
