#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "viewer/bench/ocean_bench.hpp"
#include "viewer/bench/plot.hpp"

namespace relevo::viewer {

namespace {

bool error_known(const OceanRow& row) {
    return row.error.pixels > 0;
}
bool swimming_known(const OceanRow& row) {
    return row.swimming.pixels > 0;
}

std::string number(bool known, double value, int digits) {
    return known ? fmt::format("{:.{}f}", value, digits) : "-";
}

/// Colours that stay apart for eyes that do not tell red from green (Okabe and Ito).
const char* colour_of(OceanKind kind) {
    return kind == OceanKind::geoclipmap ? "#0072b2" : kind == OceanKind::radial ? "#d55e00" : "#009e73";
}

/// The sizes of one mesh in one view are joined.
std::vector<PlotSeries> plot_series(const OceanBench& ocean) {
    using View = std::pair<double, OceanGaze>;
    std::map<std::pair<OceanKind, View>, PlotSeries> by_view;
    std::vector<OceanKind> named;
    for (const OceanRow& row : ocean.rows) {
        PlotSeries& line = by_view[{row.kind, {row.eye_m, row.gaze}}];
        line.colour = colour_of(row.kind);
        if (std::count(named.begin(), named.end(), row.kind) == 0) {
            named.push_back(row.kind);
            line.name = to_string(row.kind);
        }
        line.values.emplace_back(error_known(row) ? row.error.max_px : NAN, row.cpu_ms + row.gpu_ms);
        line.labels.push_back(fmt::format("{}, eye {:g} m, {}, asked {:g} px: {} triangles, error {} px",
                                          to_string(row.kind), row.eye_m, to_string(row.gaze), row.asked_px,
                                          row.figures.triangles,
                                          number(error_known(row), row.error.max_px, 3)));
    }
    std::vector<PlotSeries> list;
    for (auto& [key, line] : by_view) list.push_back(std::move(line));
    return list;
}

std::string place_text(const OceanBench& ocean) {
    return ocean.place ? fmt::format("{:.5f}, {:.5f}", ocean.place->lat.value, ocean.place->lon.value) : "";
}

}  // namespace

nlohmann::json ocean_json(const OceanBench& ocean) {
    auto list = nlohmann::json::array();
    const auto known = [](bool is, double value) {
        return is ? nlohmann::json(value) : nlohmann::json(nullptr);
    };
    for (const OceanRow& row : ocean.rows) {
        list.push_back({{"mesh", to_string(row.kind)},
                        {"asked_px", row.asked_px},
                        {"eye_m", row.eye_m},
                        {"direction", to_string(row.gaze)},
                        {"vertices", row.figures.vertices},
                        {"triangles", row.figures.triangles},
                        {"draw_calls", row.figures.draw_calls},
                        {"cpu_ms", row.cpu_ms},
                        {"gpu_ms", row.gpu_ms},
                        {"max_error_px", known(error_known(row), row.error.max_px)},
                        {"rms_error_px", known(error_known(row), row.error.rms_px)},
                        {"p99_error_px", known(error_known(row), row.error.p99_px)},
                        {"error_pixels", row.error.pixels},
                        {"holes", row.holes},
                        {"max_swimming_px", known(swimming_known(row), row.swimming.max_px)},
                        {"rms_swimming_px", known(swimming_known(row), row.swimming.rms_px)}});
    }
    return list;
}

std::string ocean_csv(const OceanBench& ocean) {
    std::string csv =
        "mesh,asked_px,eye_m,direction,vertices,triangles,draw_calls,cpu_ms,gpu_ms,max_error_px,rms_error_px,"
        "p99_error_px,error_pixels,holes,max_swimming_px,rms_swimming_px\n";
    const auto known = [](bool is, double value) {
        return is ? fmt::format("{:.5f}", value) : std::string();
    };
    for (const OceanRow& row : ocean.rows) {
        csv += fmt::format(
            "{},{:g},{:g},{},{},{},{},{:.4f},{:.4f},{},{},{},{},{},{},{}\n", to_string(row.kind),
            row.asked_px, row.eye_m, to_string(row.gaze), row.figures.vertices, row.figures.triangles,
            row.figures.draw_calls, row.cpu_ms, row.gpu_ms, known(error_known(row), row.error.max_px),
            known(error_known(row), row.error.rms_px), known(error_known(row), row.error.p99_px),
            row.error.pixels, row.holes, known(swimming_known(row), row.swimming.max_px),
            known(swimming_known(row), row.swimming.rms_px));
    }
    return csv;
}

std::string ocean_page_part(const OceanBench& ocean) {
    if (!ocean.left_out.empty())
        return fmt::format("<h2>The sea</h2>\n<p>Not measured: {}.</p>\n", html_text(ocean.left_out));
    if (ocean.rows.empty()) return {};
    std::string html = fmt::format(
        "<h2>The sea</h2>\n<p>Three meshes at {}, each of the size that it chooses for the error that is "
        "<em>asked</em> of it. The error is measured at every pixel of deep water: the distance on the "
        "screen "
        "between the drawn surface and the waves' own function at the same place. <em>Holes</em> are pixels "
        "that nothing was drawn in though there is sea or ground; <em>swimming</em> is motion of the surface "
        "that waves do not explain, when the eye goes a hundredth of its height to the side, or "
        "forward.</p>\n",
        place_text(ocean));
    const auto has_error = [](const OceanRow& row) { return row.error.max_px > 0; };
    if (std::any_of(ocean.rows.begin(), ocean.rows.end(), has_error)) {
        html += line_plot({"largest error of the sea, pixels", true}, {"sea, CPU and GPU, ms", true},
                          plot_series(ocean));
    }
    html += "<div class=\"wide\"><table>\n";
    html += table_row({"mesh", "asked px", "eye m", "direction", "vertices", "triangles", "draws", "CPU ms",
                       "GPU ms", "error px", "RMS", "p99", "holes", "swimming px", "RMS"},
                      "th");
    const OceanRow* before = nullptr;
    for (const OceanRow& row : ocean.rows) {
        const bool first = before == nullptr || before->eye_m != row.eye_m || before->gaze != row.gaze;
        before = &row;
        const auto dashed = [](bool known, double value) {
            return known ? fmt::format("{:.3f}", value) : std::string("&ndash;");
        };
        html +=
            table_row({std::string(to_string(row.kind)), fmt::format("{:g}", row.asked_px),
                       fmt::format("{:g}", row.eye_m), std::string(to_string(row.gaze)),
                       fmt::to_string(row.figures.vertices), fmt::to_string(row.figures.triangles),
                       fmt::to_string(row.figures.draw_calls), fmt::format("{:.2f}", row.cpu_ms),
                       fmt::format("{:.1f}", row.gpu_ms), dashed(error_known(row), row.error.max_px),
                       dashed(error_known(row), row.error.rms_px), dashed(error_known(row), row.error.p99_px),
                       fmt::to_string(row.holes), dashed(swimming_known(row), row.swimming.max_px),
                       dashed(swimming_known(row), row.swimming.rms_px)},
                      "td", first ? "first" : "");
    }
    return html + "</table></div>\n";
}

std::string ocean_text(const OceanBench& ocean) {
    if (!ocean.left_out.empty()) return fmt::format("the sea left out: {}\n", ocean.left_out);
    if (ocean.rows.empty()) return {};
    std::string text = fmt::format(
        "\nthe sea at {}\n{:<11} {:>8} {:>6} {:<10} {:>9} {:>6} {:>7} {:>7} {:>8} "
        "{:>7} {:>6} {:>8}\n",
        place_text(ocean), "mesh", "asked px", "eye m", "direction", "triangles", "draws", "CPU ms", "GPU ms",
        "error px", "RMS px", "holes", "swim px");
    for (const OceanRow& row : ocean.rows) {
        text += fmt::format(
            "{:<11} {:>8g} {:>6g} {:<10} {:>9} {:>6} {:>7.2f} {:>7.1f} {:>8} {:>7} {:>6} {:>8}\n",
            to_string(row.kind), row.asked_px, row.eye_m, to_string(row.gaze), row.figures.triangles,
            row.figures.draw_calls, row.cpu_ms, row.gpu_ms, number(error_known(row), row.error.max_px, 3),
            number(error_known(row), row.error.rms_px, 3), row.holes,
            number(swimming_known(row), row.swimming.max_px, 3));
    }
    return text;
}

}  // namespace relevo::viewer
