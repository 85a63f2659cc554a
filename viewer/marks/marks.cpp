#include "viewer/marks/marks.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace relevo::viewer {

namespace {

constexpr std::array<std::pair<const char*, bool Marks::*>, 4> kNames{{{"legend", &Marks::legend},
                                                                       {"scale", &Marks::scale},
                                                                       {"north", &Marks::north},
                                                                       {"labels", &Marks::labels}}};

}  // namespace

Result<Marks> parse_marks(std::string_view text) {
    if (text == "all") return Marks{true, true, true, true};
    Marks marks;
    if (text == "none") return marks;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string_view part = text.substr(at, end - at);
        at = end + 1;
        const auto known =
            std::find_if(kNames.begin(), kNames.end(), [&](const auto& name) { return part == name.first; });
        if (known == kNames.end())
            return Error{
                ErrorKind::usage,
                fmt::format("no mark \"{}\": all, none, or some of legend,scale,north,labels", part)};
        marks.*known->second = true;
    }
    return marks;
}

std::string to_string(const Marks& marks) {
    std::string text;
    for (const auto& [name, member] : kNames) {
        if (marks.*member) text += (text.empty() ? "" : ",") + std::string(name);
    }
    return text.empty() ? "none" : text;
}

double marks_scale(int width, int height) {
    return std::max(1.0, std::min(width / 1280.0, height / 720.0));
}

}  // namespace relevo::viewer
