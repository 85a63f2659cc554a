#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "geo/result.hpp"
#include "ingest/affine.hpp"
#include "ingest/reference/crs.hpp"

namespace relevo::ingest {

/// The one coordinate operation that brings a source's CRS to WGS 84 latitude and longitude. PROJ may hold
/// several for a pair of CRSs and changes silently between them, down to doing nothing where a grid is
/// missing; here it is a single one, chosen once, named and with its stated accuracy.
/// Any thread may use it; PROJ is asked by one at a time.
class Operation {
  public:
    /// The best operation whose grids are here: defined at the most of the places, and never a ballpark one.
    /// \param places  some places of the data in the CRS: its corners, edges and inside
    static Result<Operation> to_wgs84(const Crs& crs, std::span<const Place> places);

    /// From the CRS to (lon, lat) in degrees, in place; NaN where the operation is not defined.
    void forward(std::span<Place> places) const { transform(places, PJ_FWD); }
    /// From (lon, lat) in degrees to the CRS.
    void inverse(std::span<Place> places) const { transform(places, PJ_INV); }

    const std::string& name() const { return name_; }
    /// As stated by PROJ's database, metres; 0 for pure map projections of WGS 84.
    std::optional<double> accuracy_m() const { return accuracy_m_; }
    /// A more accurate operation that could not be used and why; else empty.
    const std::string& note() const { return note_; }

  private:
    Operation() = default;
    void transform(std::span<Place> places, PJ_DIRECTION direction) const;

    std::shared_ptr<PJ_CONTEXT> context_;
    PjPtr operation_;
    std::unique_ptr<std::mutex> one_at_a_time_ = std::make_unique<std::mutex>();
    std::string name_;
    std::optional<double> accuracy_m_;
    std::string note_;
};

}  // namespace relevo::ingest
