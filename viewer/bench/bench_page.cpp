#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/bench/bench_report.hpp"
#include "viewer/bench/plot.hpp"

namespace relevo::viewer {

namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #1b1f24; max-width: 1240px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; margin-bottom: 0.2em; } h2 { font-size: 1.15em; margin: 2em 0 0.3em; }
p { max-width: 52em; } .note { color: #57606a; font-size: 0.92em; }
table { border-collapse: collapse; font-size: 0.88em; font-variant-numeric: tabular-nums; }
th, td { padding: 0.22em 0.5em; text-align: right; border-bottom: 1px solid #d8dee4; white-space: nowrap; }
th { background: #f6f8fa; font-weight: 600; vertical-align: bottom; }
td:first-child, th:first-child, td.l, th.l { text-align: left; } td.l { white-space: normal; }
.wide { overflow-x: auto; } tr.first td { border-top: 2px solid #afb8c1; }
svg { width: 100%; max-width: 900px; height: auto; display: block; }
svg text { font: 12px system-ui, sans-serif; fill: #57606a; } svg text.t { font-size: 13px; fill: #1b1f24; }
svg text.n { fill: #1b1f24; } svg .g { stroke: #e4e8ec; } svg polyline, svg line { stroke-width: 1.8; }
svg .g { stroke-width: 1; } pre { background: #f6f8fa; padding: 0.8em; overflow-x: auto; font-size: 0.88em; }
)";

/// Colours that stay apart for eyes that do not tell red from green (Okabe and Ito).
const char* colour_of(const BenchSetting& setting) {
    if (setting.by_budget) return "#cc79a7";
    switch (setting.method) {
        case BenchMethod::soar_bounded:
            return "#0072b2";
        case BenchMethod::soar_incremental:
            return "#d55e00";
        case BenchMethod::lstr:
            return "#e69f00";
        case BenchMethod::textbook:
            return "#009e73";
        case BenchMethod::full:
            break;
    }
    return "#333333";
}

std::string name_of(const BenchSetting& setting) {
    return std::string(series_name(setting)) + (setting.by_budget ? ", budget" : "");
}

std::string number(double value, int digits) {
    return fmt::format("{:.{}f}", value, digits);
}

std::string or_dash(bool known, double value, int digits) {
    return known ? number(value, digits) : "&ndash;";
}

class BenchPage {
  public:
    BenchPage(const BenchSubject& subject, const BenchResult& result, std::span<const BenchSummary> rows)
        : subject_(subject), result_(result), rows_(rows), frame_(subject.scene.info().frame) {}

    std::string make() {
        const std::string name = html_text(subject_.scene.path().filename().string());
        html_ = fmt::format(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}: speed against "
            "error</title>\n"
            "<style>{1}</style>\n</head>\n<body>\n<h1>Speed against error: {0}</h1>\n",
            name, kStyle);
        conditions();
        cost_plots();
        time_plot();
        jump_plot();
        all_rows();
        equal_errors();
        prices();
        html_ += ocean_page_part(result_.ocean);
        memory();
        published();
        html_ += "</body>\n</html>\n";
        return std::move(html_);
    }

  private:
    void heading(const char* title, const std::string& text) {
        html_ += fmt::format("<h2>{}</h2>\n<p>{}</p>\n", title, text);
    }

    void conditions() {
        const BenchOptions& options = subject_.options;
        const Machine& machine = result_.machine;
        html_ += fmt::format(
            "<p>{} x {} posts, flight <em>{}</em> of {:.0f} s; {} frames a row, {} {}, {} x {} pixels, {} {} "
            "a "
            "pixel. Relevo {}.</p>\n",
            frame_.columns, frame_.rows, html_text(subject_.flight_name), subject_.flight.duration_s(),
            options.frames, options.runs, options.runs == 1 ? "run" : "runs in turns", options.width,
            options.height, options.samples, options.samples == 1 ? "sample" : "samples",
            html_text(subject_.version));
        html_ += fmt::format(
            "<p>{}, {} cores, {:.0f} GiB; {}; drawn by {}. Load average when it began: {:.2f}. It took "
            "{:.0f} "
            "s.</p>\n<pre>{}</pre>\n",
            html_text(machine.cpu), machine.cores, machine.memory_mib / 1024, html_text(machine.system),
            html_text(machine.gl_renderer), machine.load_average, result_.seconds,
            html_text(subject_.command));
        for (const BenchSkipped& skipped : result_.skipped) {
            html_ += fmt::format("<p>Left out: <strong>{}</strong>, for {}.</p>\n", to_string(skipped.method),
                                 html_text(skipped.reason));
        }
    }

    /// One line a method and morph; (x, y) of its rows by tau.
    template <class X, class Y>
    std::vector<PlotSeries> series_by_tau(X&& x, Y&& y) const {
        std::vector<PlotSeries> list;
        for (const BenchSummary& row : rows_) {
            if (row.setting.by_budget || !has_tau(row.setting.method)) continue;
            const std::string name = name_of(row.setting);
            if (list.empty() || list.back().name != name) {
                list.push_back({.name = name,
                                .colour = colour_of(row.setting),
                                .dashed = row.setting.morph,
                                .points = true,
                                .values = {},
                                .labels = {}});
            }
            list.back().values.emplace_back(x(row), y(row));
            const std::string tau =
                row.setting.tau_px ? fmt::format("tau {:g} px: ", *row.setting.tau_px) : std::string();
            list.back().labels.push_back(
                fmt::format("{}, {}{:.0f} triangles, {:.2f} ms refinement, {:.1f} ms a frame, error {} px",
                            name, tau, row.triangles.median, row.refine_ms.median, row.frame_ms.median,
                            row.error ? fmt::format("{:.3f}", row.error->max_px) : "?"));
        }
        return list;
    }

    static double error_or_nan(const BenchSummary& row) {
        return row.error ? row.error->max_px : std::nan("");
    }

    /// `full` has no error to plot; what it costs is said in words.
    std::string full_text() const {
        for (const BenchSummary& row : rows_) {
            if (row.setting.method != BenchMethod::full) continue;
            return fmt::format(
                " Every triangle of the data (<em>full</em>): {:.0f} triangles, {:.0f} ms a frame{}.",
                row.triangles.median, row.frame_ms.median,
                row.error ? fmt::format(", error {:.4f} px", row.error->max_px) : std::string());
        }
        return {};
    }

    void cost_plots() {
        const PlotAxis error{"largest measured error, pixels", true};
        const bool measured = std::any_of(rows_.begin(), rows_.end(),
                                          [](const BenchSummary& row) { return row.error.has_value(); });
        if (!measured) return;
        heading("Error against triangles",
                std::string("Each mark is a tau; lower and further left is better. The error is measured: "
                            "over every post "
                            "and "
                            "every pixel in view of the sampled frames, the distance on the screen between "
                            "the true point of "
                            "the ground and the drawn one at the same grid coordinates.") +
                    full_text());
        html_ += line_plot(
            error, {"triangles a frame, median", true},
            series_by_tau(error_or_nan, [](const BenchSummary& row) { return row.triangles.median; }));
        heading("Error against frame time",
                "Refinement, upload and drawing to the last pixel. The textbook's time is its own "
                "refinement, the "
                "upload and the drawing, without the putting of its flat mesh on the earth.");
        html_ += line_plot(
            error, {"frame time, median, ms", true},
            series_by_tau(error_or_nan, [](const BenchSummary& row) { return row.frame_ms.median; }));
        heading("Error against refinement time",
                "The same without upload and drawing, which depend on the "
                "graphics card.");
        html_ += line_plot(
            error, {"refinement, median, ms", true},
            series_by_tau(error_or_nan, [](const BenchSummary& row) { return row.refine_ms.median; }));
    }

    /// The tau nearest to 1 pixel.
    double usual_tau() const {
        double usual = 0;
        for (const BenchSummary& row : rows_) {
            if (!row.setting.tau_px || row.setting.by_budget) continue;
            const double tau = *row.setting.tau_px;
            if (usual == 0 || std::abs(std::log(tau)) <= std::abs(std::log(usual))) usual = tau;
        }
        return usual;
    }

    void time_plot() {
        const double tau = usual_tau();
        std::vector<PlotSeries> list;
        for (const BenchRow& row : result_.rows) {
            if (row.setting.method == BenchMethod::full) continue;
            if (!row.setting.by_budget && row.setting.tau_px != tau) continue;
            PlotSeries line{.name = name_of(row.setting),
                            .colour = colour_of(row.setting),
                            .dashed = row.setting.morph,
                            .points = false,
                            .values = {},
                            .labels = {}};
            for (const BenchFrame& f : row.frames) {
                if (f.run == 0) line.values.emplace_back(f.time_s, f.frame_ms());
            }
            list.push_back(std::move(line));
        }
        if (list.empty()) return;
        heading("Frame time along the flight",
                fmt::format("At tau {:g} px, first run. Rows with a budget fly in real time.", tau));
        html_ += line_plot({"time along the flight, s", false}, {"frame time, ms", false}, list);
    }

    void jump_plot() {
        const bool any = std::any_of(rows_.begin(), rows_.end(),
                                     [](const BenchSummary& row) { return row.jump.has_value(); });
        if (!any) return;
        heading(
            "Jumps of the surface",
            "How far the drawn surface moves from one frame to the next, 1/30 s later, where no camera moved "
            "it: the largest distance in pixels over the flight. Both surfaces are taken at the same grid "
            "coordinates, at every vertex of both meshes in view, and seen by the second frame's camera.");
        html_ +=
            line_plot({"tau, pixels", true}, {"largest jump, pixels", true},
                      series_by_tau([](const BenchSummary& row) { return row.setting.tau_px.value_or(0); },
                                    [](const BenchSummary& row) { return row.jump ? row.jump->max_px : 0; }));
    }

    void all_rows() {
        heading("All figures",
                "Medians over all frames. Errors and jumps are those of the first run: the largest, the RMS "
                "over all "
                "posts and pixels, the largest 99th percentile of a frame. <em>Speed</em> is triangles a "
                "second of "
                "refinement over the textbook's at the same tau: the median over the runs and its range.");
        html_ += "<div class=\"wide\"><table>\n";
        html_ += table_row(
            {"method", "morph", "tau px", "triangles", "vertices", "draws", "refine ms", "p99", "upload ms",
             "draw ms", "frame ms", "p95", "p99", "error px", "RMS", "p99", "jump px", "p99", "speed"},
            "th");
        const BenchSummary* before = nullptr;
        for (const BenchSummary& row : rows_) {
            const bool first = before == nullptr || name_of(before->setting) != name_of(row.setting);
            before = &row;
            const auto error = row.error.value_or(BenchSummary::Error{});
            const auto jump = row.jump.value_or(BenchSummary::Jump{});
            std::string speed = "&ndash;";
            if (row.speed_to_textbook) {
                const Ratio& ratio = *row.speed_to_textbook;
                speed = number(ratio.median, 2);
                if (subject_.options.runs > 1)
                    speed += fmt::format(" ({:.2f}&ndash;{:.2f})", ratio.least, ratio.most);
            }
            std::string tau = row.setting.tau_px ? fmt::format("{:g}", *row.setting.tau_px) : "&ndash;";
            if (row.budget) {
                tau = fmt::format("{:.2f} ({:.2f}&ndash;{:.2f})", row.budget->tau_median_px,
                                  row.budget->tau_least_px, row.budget->tau_most_px);
            }
            html_ += table_row(
                {std::string(to_string(row.setting.method)) + (row.setting.by_budget ? ", budget" : ""),
                 has_morph(row.setting.method) ? (row.setting.morph ? "on" : "off") : "&ndash;", tau,
                 number(row.triangles.median, 0), number(row.vertices.median, 0),
                 number(row.draw_calls.median, 0), number(row.refine_ms.median, 2),
                 number(row.refine_ms.p99, 2), number(row.upload_ms.median, 2), number(row.draw_ms.median, 1),
                 number(row.frame_ms.median, 1), number(row.frame_ms.p95, 1), number(row.frame_ms.p99, 1),
                 or_dash(row.error.has_value(), error.max_px, 3),
                 or_dash(row.error.has_value(), error.rms_px, 3),
                 or_dash(row.error.has_value(), error.p99_px, 3),
                 or_dash(row.jump.has_value(), jump.max_px, 3), or_dash(row.jump.has_value(), jump.p99_px, 3),
                 speed},
                "td", first ? "first" : "");
        }
        html_ += "</table></div>\n";
        for (const BenchSummary& row : rows_) {
            if (!row.budget) continue;
            const BudgetLimits& limits = subject_.options.budget;
            std::string what;
            if (limits.frame_ms) what = fmt::format("{:g} ms", *limits.frame_ms);
            if (limits.triangles)
                what += fmt::format("{}{} triangles", what.empty() ? "" : " and ", *limits.triangles);
            html_ += fmt::format(
                "<p>Budget of {}, morph {}: {:.1f} % of {} frames kept to it, at tau {:.2f} px in the "
                "median.</p>\n",
                what, row.setting.morph ? "on" : "off", 100 * row.budget->frames_within, row.frames,
                row.budget->tau_median_px);
        }
    }

    void equal_errors() {
        std::vector<BenchSetting> series;
        for (const BenchSummary& row : rows_) {
            const BenchSetting bare{row.setting.method, row.setting.morph, std::nullopt, false};
            if (row.setting.by_budget || !has_tau(bare.method)) continue;
            if (std::find(series.begin(), series.end(), bare) == series.end()) series.push_back(bare);
        }
        std::vector<std::string> head{"largest error px"};
        for (const BenchSetting& s : series) {
            head.push_back(html_text(series_name(s)) + "<br>triangles");
            head.push_back("<br>refine ms");
        }
        std::string lines;
        for (const double error : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
            std::vector<std::string> cells{fmt::format("{:g}", error)};
            int known = 0;
            for (const BenchSetting& s : series) {
                const auto at = at_error(rows_, s.method, s.morph, error);
                cells.push_back(or_dash(at.has_value(), at.value_or(AtError{}).triangles, 0));
                cells.push_back(or_dash(at.has_value(), at.value_or(AtError{}).refine_ms, 2));
                known += at.has_value();
            }
            if (known > 0) lines += table_row(cells);
        }
        if (lines.empty()) return;
        heading(
            "At equal measured error",
            "What the same largest measured error takes, between the taus measured (linear in logarithms). "
            "Methods mean different things by tau; this is how they compare.");
        html_ += "<div class=\"wide\"><table>\n" + table_row(head, "th") + lines + "</table></div>\n";
    }

    void prices() {
        const auto list = morph_prices(rows_);
        if (list.empty()) return;
        heading("The price of morphing",
                "Medians with the morph over those without: at the same tau, and at the same largest "
                "measured error.");
        html_ += "<table>\n" + table_row({"method", "tau px", "triangles", "refine ms", "frame ms",
                                          "triangles<br>at equal error", "frame ms<br>at equal error"},
                                         "th");
        for (const MorphPrice& price : list) {
            html_ +=
                table_row({std::string(to_string(price.method)), fmt::format("{:g}", price.tau_px),
                           number(price.triangles, 2), number(price.refine_ms, 2), number(price.frame_ms, 2),
                           or_dash(price.triangles_at_equal_error.has_value(),
                                   price.triangles_at_equal_error.value_or(0), 2),
                           or_dash(price.frame_ms_at_equal_error.has_value(),
                                   price.frame_ms_at_equal_error.value_or(0), 2)});
        }
        html_ += "</table>\n";
    }

    double posts() const { return static_cast<double>(frame_.columns) * static_cast<double>(frame_.rows); }

    /// Of each method and morph the row at the usual tau, and `full`.
    std::vector<const BenchSummary*> usual_rows() const {
        std::vector<const BenchSummary*> list;
        const double tau = usual_tau();
        for (const BenchSummary& row : rows_) {
            if (row.setting.by_budget) continue;
            if (!row.setting.tau_px || row.setting.tau_px == tau) list.push_back(&row);
        }
        return list;
    }

    void memory() {
        heading("Memory",
                "The most that the process had in RAM at this tau, with everything that drawing takes; a "
                "software "
                "renderer's textures and buffers are in it, a graphics card's are not. The textbook has the "
                "product's "
                "terrain in memory beside its own, to be drawn and measured.");
        std::vector<PlotBar> bars;
        for (const BenchSummary* row : usual_rows()) {
            bars.push_back({name_of(row->setting), colour_of(row->setting), row->resident_mib,
                            fmt::format("{:.0f} MiB, {:.0f} B a mesh vertex", row->resident_mib,
                                        row->mesh_bytes_per_vertex)});
        }
        html_ += bar_plot("resident memory, MiB", bars);
    }

    /// The comparison that the authors of LSTR announced, in its form.
    void published() {
        heading(
            "Beside Geometry Clipmaps",
            "The authors of LSTR announced, for later work, a comparison by four figures: size of the "
            "terrain, "
            "frames a second, total memory, and memory a vertex. Here it is, beside what Losasso and Hoppe "
            "published for Geometry Clipmaps (2004). <strong>Their figures are of another machine, with a "
            "graphics card, and with heights compressed with loss</strong>; only sizes compare.");
        html_ += "<table>\n" + table_row({"program", "terrain, posts", "terrain, bytes of heights",
                                          "frames a second", "total memory", "bytes a post<br>of the terrain",
                                          "bytes a vertex<br>of the mesh"},
                                         "th");
        for (const BenchSummary* row : usual_rows()) {
            const std::string tau =
                row->setting.tau_px ? fmt::format(", tau {:g} px", *row->setting.tau_px) : "";
            html_ += table_row(
                {"Relevo, " + html_text(series_name(row->setting)) + tau,
                 fmt::format("{:.1f} M", posts() / 1e6), fmt::format("{:.0f} MB", 4 * posts() / 1e6),
                 number(1000 / std::max(row->frame_ms.median, 1e-6), 1),
                 fmt::format("{:.0f} MB", row->resident_mib * 1.048576),
                 number(row->resident_mib * 1048576 / posts(), 2), number(row->mesh_bytes_per_vertex, 1)});
        }
        html_ += table_row({"Geometry Clipmaps, as published", "20 000 M *", "40 GB", "60&ndash;90", "355 MB",
                            "0.02 *", "&ndash;"});
        html_ +=
            "</table>\n<p class=\"note\">* Follows from 40 GB at two bytes a post. Frames a second are 1000 "
            "over the "
            "median frame time in ms.</p>\n";
    }

    const BenchSubject& subject_;
    const BenchResult& result_;
    std::span<const BenchSummary> rows_;
    const geo::GridFrame& frame_;
    std::string html_;
};

}  // namespace

std::string bench_page(const BenchSubject& subject, const BenchResult& result,
                       std::span<const BenchSummary> rows) {
    return BenchPage(subject, result, rows).make();
}

}  // namespace relevo::viewer
