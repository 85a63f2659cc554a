#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "geo/result.hpp"
#include "lod/measure/measurement.hpp"

namespace relevo::output {

/// A measurement and what it came to, for a file.
struct MeasurementRecord {
    lod::Measurement measurement;
    std::vector<std::optional<double>> H_m;  ///< at each vertex where known; empty: at none
    /// Named results (`length_m`, ...): properties in GeoJSON, ExtendedData in KML; not in CSV. An object, or
    /// null.
    nlohmann::json results;
};

/// Can a file of this name hold measurements? Its ending says which format: .geojson or .json, .csv, .kml.
bool is_measurement_file(const std::filesystem::path& file);

/// Reads places, whoever wrote the file; results in it are not read, as they are measured anew.
///
/// GeoJSON and CSV are read by ourselves, so that every double comes back to the last bit and a wrong line
/// has a number; KML by GDAL, as other programs write it in many ways. Of others' files: each part of a multi
/// geometry is a measurement of its own, third coordinates are not read, polygons with holes are refused, and
/// so is what is not in WGS 84 longitude and latitude. Fails with ErrorKind::input.
Result<std::vector<lod::Measurement>> load_measurements(const std::filesystem::path& file);

/// Writes them; the file appears when it is whole (PartialFile). What is loaded again is the same to the last
/// bit, with longitudes in [-180, 180].
///
/// - GeoJSON (RFC 7946): what crosses the antimeridian is split there, and rings are counter-clockwise, as
///   other programs expect; the property `vertices` then has the places themselves.
/// - CSV: a row a vertex, `name,kind,vertex,lat,lon,H_m`, vertices counted from 1.
/// - KML: one Placemark each. KML draws along the ground the shorter way round, so nothing is split.
///
/// Fails with ErrorKind::usage where the name is taken (without overwrite) or ends in none of these;
/// ErrorKind::input where a measurement is none (lod::check).
Result<void> save_measurements(const std::filesystem::path& file, std::span<const MeasurementRecord> records,
                               bool overwrite);

}  // namespace relevo::output
