#include "viewer/haze.hpp"

#include <fmt/format.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

Result<Haze> parse_haze(std::string_view text) {
    if (text == "on") return Haze{};
    if (text == "off") return Haze{.on = false};
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1 || !(numbers->front() >= 0.05 && numbers->front() <= 1e5)) {
        return Error{ErrorKind::usage,
                     fmt::format("haze \"{}\": on, off or a visibility of 0.05 to 100000 km", text)};
    }
    return Haze{.visibility_km = numbers->front()};
}

std::string to_string(const Haze& haze) {
    if (!haze.on) return "off";
    if (haze == Haze{}) return "on";
    return fmt::format("{}", haze.visibility_km);
}

}  // namespace relevo::viewer
