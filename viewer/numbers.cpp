#include "viewer/numbers.hpp"

#include <charconv>
#include <cmath>

namespace relevo::viewer {

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        if (!text.empty() && text.front() == '+') text.remove_prefix(1);  // from_chars does not know it
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.empty()) return numbers;
        if (text.front() != ',') return std::nullopt;
        text.remove_prefix(1);
    }
}

}  // namespace relevo::viewer
