#pragma once

#include <string>

#include "output/measurement_file.hpp"

// The formats of measurement_file.hpp, from and to text. Errors do not name the file: load_measurements does.
namespace relevo::output {

std::string measurements_to_geojson(std::span<const MeasurementRecord> records);
Result<std::vector<lod::Measurement>> measurements_from_geojson(const std::string& text);

std::string measurements_to_csv(std::span<const MeasurementRecord> records);
Result<std::vector<lod::Measurement>> measurements_from_csv(const std::string& text);

std::string measurements_to_kml(std::span<const MeasurementRecord> records);
/// From a file, by GDAL.
Result<std::vector<lod::Measurement>> measurements_from_kml(const std::filesystem::path& file);

}  // namespace relevo::output
