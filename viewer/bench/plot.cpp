#include "viewer/bench/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace relevo::viewer {

namespace {

constexpr double kWidth = 820;
constexpr double kHeight = 420;
constexpr double kLeft = 78;
constexpr double kRight = 232;  // for the legend
constexpr double kTop = 12;
constexpr double kBottom = 52;

/// 1500 -> "1500", 20000 -> "20k", 3000000 -> "3M", 0.25 -> "0.25"
std::string tick_text(double value) {
    if (std::abs(value) >= 1e6) return fmt::format("{:g}M", value / 1e6);
    if (std::abs(value) >= 1e4) return fmt::format("{:g}k", value / 1e3);
    return fmt::format("{:g}", value);
}

/// From values to pixels.
class Scale {
  public:
    Scale(const std::vector<double>& ticks, bool logarithmic, double from, double to)
        : logarithmic_(logarithmic), low_(of(ticks.front())), high_(of(ticks.back())), from_(from), to_(to) {}

    double at(double value) const { return from_ + (to_ - from_) * (of(value) - low_) / (high_ - low_); }

  private:
    double of(double value) const { return logarithmic_ ? std::log10(value) : value; }

    bool logarithmic_;
    double low_, high_, from_, to_;
};

bool fits(double value, const PlotAxis& axis) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

std::vector<double> ticks_for(const std::vector<PlotSeries>& series, const PlotAxis& x, const PlotAxis& y,
                              bool of_x) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const PlotSeries& s : series) {
        for (const auto& [vx, vy] : s.values) {
            if (!fits(vx, x) || !fits(vy, y)) continue;
            low = std::min(low, of_x ? vx : vy);
            high = std::max(high, of_x ? vx : vy);
        }
    }
    const PlotAxis& axis = of_x ? x : y;
    if (!(low <= high)) low = axis.logarithmic ? 1 : 0, high = axis.logarithmic ? 10 : 1;
    if (!axis.logarithmic && !of_x) low = std::min(low, 0.0);  // times begin at nothing
    return plot_ticks(low, high, axis.logarithmic);
}

/// Ticks that are written: on a logarithmic axis of many decades, powers of ten alone.
bool is_written(double tick, const std::vector<double>& ticks, bool logarithmic) {
    if (!logarithmic || ticks.size() <= 10) return true;
    const double exponent = std::log10(tick);
    return std::abs(exponent - std::round(exponent)) < 1e-9;
}

std::string legend(const std::vector<PlotSeries>& series) {
    std::string svg;
    double y = kTop + 10;
    const double x = kWidth - kRight + 14;
    for (const PlotSeries& s : series) {
        if (s.name.empty()) continue;
        svg += fmt::format(R"(<line x1="{:.0f}" y1="{:.0f}" x2="{:.0f}" y2="{:.0f}" stroke="{}" {}/>)", x, y,
                           x + 26, y, s.colour, s.dashed ? R"(stroke-dasharray="5 3" )" : "");
        if (s.points)
            svg += fmt::format(R"(<circle cx="{:.0f}" cy="{:.0f}" r="3.5" fill="{}" stroke="{}"/>)", x + 13,
                               y, s.dashed ? "white" : s.colour, s.colour);
        svg += fmt::format(R"(<text class="n" x="{:.0f}" y="{:.0f}">{}</text>)", x + 33, y + 4,
                           html_text(s.name));
        y += 20;
    }
    return svg + "\n";
}

}  // namespace

std::string html_text(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::vector<double> plot_ticks(double low, double high, bool logarithmic) {
    std::vector<double> ticks;
    if (logarithmic) {
        int decade = static_cast<int>(std::floor(std::log10(low))) - 1;
        for (double before = 0; ticks.empty() || ticks.back() < high; ++decade) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double tick = digit * std::pow(10.0, decade);
                if (tick <= low * (1 + 1e-12)) {
                    before = tick;
                    continue;
                }
                if (ticks.empty()) ticks.push_back(before);
                ticks.push_back(tick);
                if (tick >= high) break;
            }
        }
        return ticks;
    }
    const double span = high > low ? high - low : std::max(std::abs(high), 1.0);
    const double rough = span / 6;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double digits = rough / power;
    const double step = power * (digits <= 1 ? 1 : digits <= 2 ? 2 : digits <= 5 ? 5 : 10);
    const double first = std::floor(low / step);
    for (double i = first; ticks.size() < 2 || ticks.back() < high - 1e-9 * step; ++i)
        ticks.push_back(i * step);
    return ticks;
}

std::string line_plot(const PlotAxis& x, const PlotAxis& y, const std::vector<PlotSeries>& series) {
    const auto x_ticks = ticks_for(series, x, y, true);
    const auto y_ticks = ticks_for(series, x, y, false);
    const Scale along(x_ticks, x.logarithmic, kLeft, kWidth - kRight);
    const Scale up(y_ticks, y.logarithmic, kHeight - kBottom, kTop);

    std::string svg = fmt::format(R"(<svg viewBox="0 0 {:.0f} {:.0f}" role="img" aria-label="{} against {}">)"
                                  "\n",
                                  kWidth, kHeight, html_text(y.title), html_text(x.title));
    for (const double tick : x_ticks) {
        const double at = along.at(tick);
        svg += fmt::format(R"(<line class="g" x1="{0:.1f}" y1="{1:.0f}" x2="{0:.1f}" y2="{2:.0f}"/>)", at,
                           kTop, kHeight - kBottom);
        if (is_written(tick, x_ticks, x.logarithmic))
            svg += fmt::format(R"(<text x="{:.1f}" y="{:.0f}" text-anchor="middle">{}</text>)", at,
                               kHeight - kBottom + 17, tick_text(tick));
    }
    for (const double tick : y_ticks) {
        const double at = up.at(tick);
        svg += fmt::format(R"(<line class="g" x1="{1:.0f}" y1="{0:.1f}" x2="{2:.0f}" y2="{0:.1f}"/>)", at,
                           kLeft, kWidth - kRight);
        if (is_written(tick, y_ticks, y.logarithmic))
            svg += fmt::format(R"(<text x="{:.0f}" y="{:.1f}" text-anchor="end">{}</text>)", kLeft - 7,
                               at + 4, tick_text(tick));
    }
    svg += fmt::format("\n<text class=\"t\" x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
                       0.5 * (kLeft + kWidth - kRight), kHeight - 12, html_text(x.title));
    svg += fmt::format(
        R"svg(<text class="t" transform="translate(18 {:.0f}) rotate(-90)" text-anchor="middle">{}</text>)svg"
        "\n",
        0.5 * (kTop + kHeight - kBottom), html_text(y.title));
    for (const PlotSeries& s : series) {
        std::string line;
        std::string marks;
        for (std::size_t i = 0; i < s.values.size(); ++i) {
            const auto& [vx, vy] = s.values[i];
            if (!fits(vx, x) || !fits(vy, y)) continue;
            line += fmt::format("{:.1f},{:.1f} ", along.at(vx), up.at(vy));
            if (!s.points) continue;
            marks += fmt::format(
                R"(<circle cx="{:.1f}" cy="{:.1f}" r="3.5" fill="{}" stroke="{}"><title>{}</title></circle>)",
                along.at(vx), up.at(vy), s.dashed ? "white" : s.colour, s.colour,
                html_text(i < s.labels.size() ? s.labels[i] : s.name));
        }
        svg += fmt::format(R"(<polyline fill="none" stroke="{}" {}points="{}"/>{})"
                           "\n",
                           s.colour, s.dashed ? R"(stroke-dasharray="5 3" )" : "", line, marks);
    }
    return svg + legend(series) + "</svg>\n";
}

std::string bar_plot(const std::string& title, const std::vector<PlotBar>& bars) {
    constexpr double kBar = 26;
    constexpr double kNames = 190;
    double most = 0;
    for (const PlotBar& bar : bars) most = std::max(most, std::isfinite(bar.value) ? bar.value : 0);
    const auto ticks = plot_ticks(0, most > 0 ? most : 1, false);
    const Scale along(ticks, false, kNames, kWidth - 190);
    const double height = kTop + kBar * static_cast<double>(bars.size()) + kBottom;
    std::string svg = fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
                                  kWidth, height, html_text(title));
    for (const double tick : ticks) {
        const double at = along.at(tick);
        svg += fmt::format(R"(<line class="g" x1="{0:.1f}" y1="{1:.0f}" x2="{0:.1f}" y2="{2:.0f}"/>)", at,
                           kTop, height - kBottom);
        svg += fmt::format(R"(<text x="{:.1f}" y="{:.0f}" text-anchor="middle">{}</text>)", at,
                           height - kBottom + 17, tick_text(tick));
    }
    double y = kTop;
    for (const PlotBar& bar : bars) {
        const double value = std::isfinite(bar.value) ? bar.value : 0;
        svg += fmt::format(R"(<text x="{:.0f}" y="{:.0f}" text-anchor="end" class="n">{}</text>)", kNames - 8,
                           y + 0.5 * kBar + 4, html_text(bar.name));
        svg += fmt::format(R"(<rect x="{:.0f}" y="{:.0f}" width="{:.1f}" height="{:.0f}" fill="{}"/>)",
                           kNames, y + 4, along.at(value) - kNames, kBar - 8, bar.colour);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" class=\"n\">{}</text>\n", along.at(value) + 6,
                           y + 0.5 * kBar + 4, html_text(bar.label));
        y += kBar;
    }
    svg += fmt::format("<text class=\"t\" x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n",
                       0.5 * (kNames + kWidth - 190), height - 12, html_text(title));
    return svg + "</svg>\n";
}

std::string table_row(const std::vector<std::string>& cells, const char* tag, const char* row_class) {
    std::string html = *row_class == '\0' ? "<tr>" : fmt::format("<tr class=\"{}\">", row_class);
    for (const std::string& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, cell);
    return html + "</tr>\n";
}

}  // namespace relevo::viewer
