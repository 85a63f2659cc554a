#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "viewer/ground/page.hpp"

namespace relevo::viewer {

/// A page of what is draped over the ground: kPagePosts a side, row by row from the north-west; red, green,
/// blue and alpha, colours times alpha. A texel's middle is at its post.
using DrapeTexels = std::vector<std::array<std::uint8_t, 4>>;

/// Something that is draped over the ground, page by page: a picture, or lines and points. Its pages are
/// those of a grid with 2^finer() cells where the terrain's has one; level 0 is the finest.
class Drape {
  public:
    virtual ~Drape() = default;

    /// For people: the file's.
    virtual std::string name() const { return {}; }
    /// Else it comes from what is measured.
    virtual bool is_of_file() const { return true; }

    /// 0 where it is no finer than the terrain's posts; at most kMostFiner.
    virtual int finer() const = 0;
    static constexpr int kMostFiner = 7;

    /// May be called from several threads. Fails where the file cannot be read.
    virtual Result<DrapeTexels> read(const Page& page) const = 0;

    /// Lines and points instead of a picture: texels tell where they are (shaders/drape.glsl), red, green and
    /// blue are all of one colour.
    virtual std::optional<std::array<std::uint8_t, 3>> line_colour() const { return std::nullopt; }
};

using Drapes = std::vector<std::shared_ptr<const Drape>>;

/// The terrain's grid with 2^finer cells where it has one.
geo::GridFrame finer_frame(geo::GridFrame frame, int finer);

}  // namespace relevo::viewer
