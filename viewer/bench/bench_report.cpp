#include "viewer/bench/bench_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relevo::viewer {

namespace {

using nlohmann::json;

json to_json(const Quantiles& q) {
    return {{"median", q.median}, {"p95", q.p95}, {"p99", q.p99}, {"mean", q.mean}};
}

json to_json(const std::optional<Ratio>& ratio) {
    if (!ratio) return nullptr;
    return {{"median", ratio->median}, {"least", ratio->least}, {"most", ratio->most}};
}

template <class T>
json or_null(const std::optional<T>& value) {
    return value ? json(*value) : json(nullptr);
}

json to_json(const BenchSummary& row) {
    json made{{"method", to_string(row.setting.method)},
              {"morph", row.setting.morph},
              {"tau_px", or_null(row.setting.tau_px)},
              {"by_budget", row.setting.by_budget},
              {"frames", row.frames},
              {"triangles", to_json(row.triangles)},
              {"vertices", to_json(row.vertices)},
              {"draw_calls", to_json(row.draw_calls)},
              {"refine_ms", to_json(row.refine_ms)},
              {"upload_ms", to_json(row.upload_ms)},
              {"draw_ms", to_json(row.draw_ms)},
              {"frame_ms", to_json(row.frame_ms)},
              {"mesh_bytes_per_vertex", row.mesh_bytes_per_vertex},
              {"resident_mib", row.resident_mib},
              {"tiles_mib", row.tiles_mib},
              {"pending_tiles", to_json(row.pending_tiles)},
              {"refine_time_to_textbook", to_json(row.refine_to_textbook)},
              {"triangles_per_s_to_textbook", to_json(row.speed_to_textbook)},
              {"max_error_px", nullptr},
              {"rms_error_px", nullptr},
              {"p99_error_px", nullptr},
              {"error_frames", 0},
              {"uncovered_posts", nullptr},
              {"max_jump_px", nullptr},
              {"p99_jump_px", nullptr},
              {"median_of_max_jump_px", nullptr},
              {"jump_pairs", 0},
              {"tau_reached_px", nullptr},
              {"frames_within_budget", nullptr}};
    if (row.error) {
        made["max_error_px"] = row.error->max_px;
        made["rms_error_px"] = row.error->rms_px;
        made["p99_error_px"] = row.error->p99_px;
        made["error_frames"] = row.error->frames;
        made["uncovered_posts"] = row.error->uncovered_posts;
    }
    if (row.jump) {
        made["max_jump_px"] = row.jump->max_px;
        made["p99_jump_px"] = row.jump->p99_px;
        made["median_of_max_jump_px"] = row.jump->median_of_max_px;
        made["jump_pairs"] = row.jump->pairs;
    }
    if (row.budget) {
        made["tau_reached_px"] = {{"median", row.budget->tau_median_px},
                                  {"least", row.budget->tau_least_px},
                                  {"most", row.budget->tau_most_px}};
        made["frames_within_budget"] = row.budget->frames_within;
    }
    return made;
}

json prices_json(std::span<const BenchSummary> rows) {
    json list = json::array();
    for (const MorphPrice& price : morph_prices(rows)) {
        list.push_back({{"method", to_string(price.method)},
                        {"tau_px", price.tau_px},
                        {"triangles_ratio", price.triangles},
                        {"refine_ms_ratio", price.refine_ms},
                        {"frame_ms_ratio", price.frame_ms},
                        {"triangles_ratio_at_equal_error", or_null(price.triangles_at_equal_error)},
                        {"frame_ms_ratio_at_equal_error", or_null(price.frame_ms_at_equal_error)}});
    }
    return list;
}

std::string csv_number(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string();
}

}  // namespace

json bench_json(const BenchSubject& subject, const BenchResult& result, std::span<const BenchSummary> rows) {
    const geo::GridFrame& frame = subject.scene.info().frame;
    const BenchOptions& options = subject.options;
    json made{{"format_version", 1},
              {"relevo_version", subject.version},
              {"command", subject.command},
              {"scene",
               {{"name", subject.scene.path().filename().string()},
                {"columns", frame.columns},
                {"rows", frame.rows},
                {"posts", static_cast<std::int64_t>(frame.columns) * frame.rows}}},
              {"flight",
               {{"name", subject.flight_name},
                {"duration_s", subject.flight.duration_s()},
                {"keys", subject.flight.keys().size()}}},
              {"machine",
               {{"cpu", result.machine.cpu},
                {"cores", result.machine.cores},
                {"memory_mib", result.machine.memory_mib},
                {"system", result.machine.system},
                {"load_average", result.machine.load_average},
                {"gl_renderer", result.machine.gl_renderer}}},
              {"width_px", options.width},
              {"height_px", options.height},
              {"samples", options.samples},
              {"exaggeration", options.look.exaggeration},
              {"frames", options.frames},
              {"runs", options.runs},
              {"error_every", options.error_every},
              {"jump_step_s", kJumpStepS},
              {"budget_ms", or_null(options.budget.frame_ms)},
              {"budget_triangles", or_null(options.budget.triangles)},
              {"seconds", result.seconds},
              {"morph_price", prices_json(rows)},
              {"rows", json::array()},
              {"skipped", json::array()},
              {"ocean", ocean_json(result.ocean)},
              {"ocean_at", nullptr},
              {"ocean_left_out", nullptr}};
    for (const BenchSummary& row : rows) made["rows"].push_back(to_json(row));
    for (const BenchSkipped& skipped : result.skipped)
        made["skipped"].push_back({{"method", to_string(skipped.method)}, {"reason", skipped.reason}});
    if (const auto& place = result.ocean.place) made["ocean_at"] = {place->lat.value, place->lon.value};
    if (!result.ocean.left_out.empty()) made["ocean_left_out"] = result.ocean.left_out;
    return made;
}

std::string bench_csv(std::span<const BenchSummary> rows) {
    std::string csv = "method,morph,tau_px,by_budget,frames";
    for (const char* name :
         {"triangles", "vertices", "draw_calls", "refine_ms", "upload_ms", "draw_ms", "frame_ms"})
        csv += fmt::format(",{0}_median,{0}_p95,{0}_p99,{0}_mean", name);
    csv +=
        ",max_error_px,rms_error_px,p99_error_px,max_jump_px,p99_jump_px,mesh_bytes_per_vertex,resident_mib,"
        "tiles_mib,"
        "refine_time_to_textbook,triangles_per_s_to_textbook,tau_reached_px,frames_within_budget\n";
    for (const BenchSummary& row : rows) {
        csv += fmt::format("{},{},{},{},{}", to_string(row.setting.method), row.setting.morph ? "on" : "off",
                           csv_number(row.setting.tau_px), row.setting.by_budget ? "yes" : "no", row.frames);
        for (const Quantiles* q : {&row.triangles, &row.vertices, &row.draw_calls, &row.refine_ms,
                                   &row.upload_ms, &row.draw_ms, &row.frame_ms}) {
            csv += fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g}", q->median, q->p95, q->p99, q->mean);
        }
        const auto number = [&](bool known, double value) {
            csv += "," + csv_number(known ? std::optional(value) : std::nullopt);
        };
        const auto error = row.error.value_or(BenchSummary::Error{});
        const auto jump = row.jump.value_or(BenchSummary::Jump{});
        const auto budget = row.budget.value_or(BenchSummary::Budget{});
        number(row.error.has_value(), error.max_px);
        number(row.error.has_value(), error.rms_px);
        number(row.error.has_value(), error.p99_px);
        number(row.jump.has_value(), jump.max_px);
        number(row.jump.has_value(), jump.p99_px);
        number(true, row.mesh_bytes_per_vertex);
        number(true, row.resident_mib);
        number(true, row.tiles_mib);
        number(row.refine_to_textbook.has_value(), row.refine_to_textbook.value_or(Ratio{}).median);
        number(row.speed_to_textbook.has_value(), row.speed_to_textbook.value_or(Ratio{}).median);
        number(row.budget.has_value(), budget.tau_median_px);
        number(row.budget.has_value(), budget.frames_within);
        csv += "\n";
    }
    return csv;
}

std::string frames_csv(const BenchResult& result) {
    std::string csv =
        "method,morph,tau_px,by_budget,run,time_s,tau_reached_px,triangles,vertices,draw_calls,refine_ms,"
        "upload_ms,draw_ms,frame_ms,resident_mib,tiles_mib,pending_tiles,max_error_px,rms_error_px,max_jump_"
        "px,p99_jump_px\n";
    for (const BenchRow& row : result.rows) {
        const std::string setting =
            fmt::format("{},{},{},{}", to_string(row.setting.method), row.setting.morph ? "on" : "off",
                        csv_number(row.setting.tau_px), row.setting.by_budget ? "yes" : "no");
        for (const BenchFrame& f : row.frames) {
            csv += fmt::format("{},{},{:.4f},{:.6g},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.1f},{:.2f},{}",
                               setting, f.run, f.time_s, f.tau_px, f.triangles, f.vertices, f.draw_calls,
                               f.refine_ms, f.upload_ms, f.draw_ms, f.frame_ms(), f.resident_mib, f.tiles_mib,
                               f.pending_tiles);
            csv += f.error ? fmt::format(",{:.5f},{:.5f}", f.error->max_px, f.error->rms_px) : ",,";
            csv += f.jump ? fmt::format(",{:.5f},{:.5f}\n", f.jump->max_px, f.jump->p99_px) : ",,\n";
        }
    }
    return csv;
}

std::string bench_text(const BenchResult& result, std::span<const BenchSummary> rows) {
    std::string text = fmt::format("{:<18} {:>5} {:>6} {:>10} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n",
                                   "method", "morph", "tau px", "triangles", "refine ms", "frame ms",
                                   "p99 ms", "error px", "RMS px", "jump px");
    const auto number = [](bool known, double value) { return known ? fmt::format("{:.3f}", value) : "-"; };
    for (const BenchSummary& row : rows) {
        const auto error = row.error.value_or(BenchSummary::Error{});
        const auto jump = row.jump.value_or(BenchSummary::Jump{});
        std::string tau = row.setting.tau_px ? fmt::format("{:g}", *row.setting.tau_px) : "-";
        if (row.budget) tau = fmt::format("~{:.2f}", row.budget->tau_median_px);
        text += fmt::format(
            "{:<18} {:>5} {:>6} {:>10.0f} {:>9.2f} {:>9.1f} {:>9.1f} {:>8} {:>8} {:>8}{}\n",
            to_string(row.setting.method), row.setting.morph ? "on" : "off", tau, row.triangles.median,
            row.refine_ms.median, row.frame_ms.median, row.frame_ms.p99,
            number(row.error.has_value(), error.max_px), number(row.error.has_value(), error.rms_px),
            number(row.jump.has_value(), jump.max_px),
            row.budget ? fmt::format("  {:.0f} % within budget", 100 * row.budget->frames_within)
                       : std::string());
    }
    for (const BenchSkipped& skipped : result.skipped)
        text += fmt::format("{} left out: {}\n", to_string(skipped.method), skipped.reason);
    return text + ocean_text(result.ocean);
}

}  // namespace relevo::viewer
