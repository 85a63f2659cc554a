#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geo/frame.hpp"
#include "geo/geoid_nodes.hpp"
#include "geo/height.hpp"
#include "geo/position.hpp"
#include "geo/result.hpp"

namespace relevo::geo {

/// A geoid model: the height N of a vertical datum's zero above the ellipsoid, everywhere on earth or in a
/// region.
///
/// The model's nodes are joined by an interpolating bicubic spline (cubic_spline.hpp): periodic in longitude,
/// and continued across a pole along the opposite meridian where the grid covers the earth, so that no place
/// on earth is special; in a region's grid "not a knot" at its border. At a node it is the node to 1e-12 m.
/// Between the nodes of EGM96 15' it is within 0.03 m of the model (measured against the trigonometric
/// polynomial through the nodes, which the model is: 0.0265 m at most and 1.6 mm RMS in the middle of all
/// cells, where linear interpolation is wrong by up to 1.152 m, 56 mm RMS).
class Geoid {
  public:
    /// EGM96 on its 15' grid, from PROJ's data (egm96_15.gtx, Debian package proj-data).
    /// Fails with a message that names the file where PROJ does not find it.
    static Result<Geoid> egm96();

    /// A grid in the .gtx format (big-endian; of a region, or of the whole earth with or without the closing
    /// column).
    static Result<Geoid> from_gtx(const std::filesystem::path& file);

    /// From nodes of a region (at least 4 x 4) or of the whole earth. Nodes without a value make the places
    /// around them uncovered; a grid of the whole earth must have none.
    /// \param name  of the model, for the error's message
    static Result<Geoid> from_nodes(const GeoidNodes& nodes, const std::string& name);

    /// N; where the model has none, a smooth continuation of it. \pre lat in [-90, 90], lon finite
    Undulation undulation(LatLon place) const;

    /// Does the model say what N is there? \pre lat in [-90, 90], lon finite
    bool covers(LatLon place) const;

    /// The nodes in an area and as many around it that a geoid made of them is this one there, to 1e-9 m and
    /// what rounding nodes to float changes (nothing where the model came as floats). Near a pole of a grid
    /// of the whole earth these are all, since meridians go on beyond it.
    GeoidNodes nodes_around(const GridFrame::Extent& area) const;

  private:
    Geoid() = default;

    static Geoid whole_earth(const GeoidNodes& nodes);
    static Geoid region(const GeoidNodes& nodes);
    Undulation undulation_on_earth(LatLon place) const;
    double column_of(Degrees lon) const;
    double node(int column, int row) const;

    bool whole_earth_ = false;
    bool band_ = false;  // a region all round the earth, which overlaps itself
    double south_ = 0;   // of node (0, 0), degrees
    double west_ = 0;
    double step_lat_ = 0;
    double step_lon_ = 0;
    int columns_ = 0;  // whole earth: 360 / step, without a closing column
    int rows_ = 0;
    /// Of the spline, row by row from the south. A region has one more on each side.
    std::vector<double> coefficients_;
    std::vector<std::uint8_t> has_value_;  // by node; empty: all have
};

}  // namespace relevo::geo
