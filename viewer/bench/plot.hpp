#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relevo::viewer {

struct PlotAxis {
    std::string title;
    bool logarithmic = false;
};

struct PlotSeries {
    std::string name;    ///< empty: not in the legend
    std::string colour;  ///< CSS
    bool dashed = false;
    bool points = true;  ///< a mark at each; their labels show under the cursor
    std::vector<std::pair<double, double>> values;
    std::vector<std::string> labels;  ///< of the values, or empty
};

/// Lines as an SVG element to stand in a page, with axes, a grid and a legend. What is not a number, or not
/// above 0 on a logarithmic axis, is left out.
std::string line_plot(const PlotAxis& x, const PlotAxis& y, const std::vector<PlotSeries>& series);

struct PlotBar {
    std::string name;
    std::string colour;
    double value = 0;
    std::string label;
};
/// Horizontal bars from 0, likewise.
std::string bar_plot(const std::string& title, const std::vector<PlotBar>& bars);

/// Where ticks stand on an axis from low to high: 1, 2, 5 times powers of ten, evenly or by 1-2-5 steps on a
/// logarithmic one; some beyond the ends, so that all values are between the first and the last.
std::vector<double> plot_ticks(double low, double high, bool logarithmic);

/// Text for HTML: with the characters that mean something there replaced.
std::string html_text(std::string_view text);

/// A row of a table, of HTML as it is. \param tag  of its cells
std::string table_row(const std::vector<std::string>& cells, const char* tag = "td",
                      const char* row_class = "");

}  // namespace relevo::viewer
