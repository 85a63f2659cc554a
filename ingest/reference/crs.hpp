#pragma once

#include <memory>
#include <optional>
#include <string>

#include <proj.h>

#include "geo/result.hpp"

namespace relevo::ingest {

struct DestroyPj {
    void operator()(PJ* object) const { proj_destroy(object); }
};
using PjPtr = std::unique_ptr<PJ, DestroyPj>;

/// A PROJ context of our own: silent (its messages would go to stderr), one thread's at a time.
std::shared_ptr<PJ_CONTEXT> make_proj_context();

/// The vertical part of a CRS.
struct VerticalCrs {
    std::string name;          ///< "EGM96 height", "NAVD88 height (ftUS)"
    std::string code;          ///< "EPSG:5773", or empty
    bool ellipsoidal = false;  ///< the third axis of a 3D CRS: height above its ellipsoid
    bool down = false;         ///< depths: positive downwards
    double unit_m = 1;
};

/// A coordinate reference system, taken apart.
class Crs {
  public:
    /// From anything that PROJ reads: "EPSG:26912", "EPSG:4326+5773", WKT, a PROJ string.
    static Result<Crs> parse(const std::string& text);

    /// "EPSG:32611", or the CRS's own name where no code fits it.
    const std::string& name() const { return name_; }
    /// The whole definition as WKT2.
    const std::string& wkt() const { return wkt_; }

    /// The horizontal part. Valid as long as this lives.
    PJ* horizontal() const { return horizontal_.get(); }
    const std::shared_ptr<PJ_CONTEXT>& context() const { return context_; }
    const std::optional<VerticalCrs>& vertical() const { return vertical_; }

    bool geographic() const { return geographic_; }
    /// Name of the horizontal unit ("degree", "metre", "US survey foot"), and what it is in radians
    /// (geographic) or metres.
    const std::string& unit() const { return unit_; }
    double unit_factor() const { return unit_factor_; }
    /// A full turn in units of a geographic CRS: 360 for degrees.
    double full_turn() const;

  private:
    Crs() = default;

    std::shared_ptr<PJ_CONTEXT> context_;
    PjPtr horizontal_;
    std::optional<VerticalCrs> vertical_;
    std::string name_;
    std::string wkt_;
    bool geographic_ = false;
    std::string unit_;
    double unit_factor_ = 1;
};

}  // namespace relevo::ingest
