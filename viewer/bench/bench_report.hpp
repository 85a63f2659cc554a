#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "viewer/bench/bench_summary.hpp"

namespace relevo::viewer {

/// What a report says besides the figures.
struct BenchSubject {
    const lod::Scene& scene;
    const FlightPath& flight;
    std::string flight_name;  ///< its file, or that it was made from the scene
    const BenchOptions& options;
    std::string command;  ///< that was run
    std::string version;  ///< of Relevo
};

/// All but the single frames. Figures that were not measured are null.
nlohmann::json bench_json(const BenchSubject& subject, const BenchResult& result,
                          std::span<const BenchSummary> rows);

/// One line a row, after a line of names.
std::string bench_csv(std::span<const BenchSummary> rows);

/// One line a frame.
std::string frames_csv(const BenchResult& result);

/// A page with plots and tables that needs nothing else: no network, no script, no other file.
std::string bench_page(const BenchSubject& subject, const BenchResult& result,
                       std::span<const BenchSummary> rows);

/// A table for a terminal.
std::string bench_text(const BenchResult& result, std::span<const BenchSummary> rows);

}  // namespace relevo::viewer
