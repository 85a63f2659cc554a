#include "viewer/flight/flight_path.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <unistd.h>

#include "viewer/numbers.hpp"

namespace relevo::viewer {

namespace {

constexpr std::string_view kHeader = "relevo-flight 1";
constexpr std::uintmax_t kLongestFile = 64 << 20;
constexpr double kPolarLat = 75;

double size_of(double v) {
    return std::abs(v);
}
double size_of(const glm::dvec3& v) {
    return glm::length(v);
}

/// The speed at a knot between two spans of lengths h0, h1 with the mean speeds d0, d1: that of the parabola
/// through the three knots, but never more than twice the slower span's. So a span between equal knots stands
/// still, and a number does not run beyond the knots (Steffen 1990, "A simple method for monotonic
/// interpolation in one dimension").
template <class T>
T speed_between(const T& d0, const T& d1, double h0, double h1) {
    const T parabola = (h1 * d0 + h0 * d1) / (h0 + h1);
    const double most = 2 * std::min(size_of(d0), size_of(d1));
    const double size = size_of(parabola);
    return size > most ? parabola * (most / size) : parabola;
}

double limited_speed(double d0, double d1, double h0, double h1) {
    return d0 * d1 <= 0 ? 0 : speed_between(d0, d1, h0, h1);  // a knot at the top of a hill stays the top
}
glm::dvec3 limited_speed(const glm::dvec3& d0, const glm::dvec3& d1, double h0, double h1) {
    return speed_between(d0, d1, h0, h1);
}

/// Cubic Hermite from p0 to p1 in h seconds with the speeds m0, m1; u in [0, 1].
template <class T>
T hermite(const T& p0, const T& p1, const T& m0, const T& m1, double h, double u) {
    const double u2 = u * u;
    const double u3 = u2 * u;
    // As an offset from p0: equal ends without speeds give p0 to the last bit.
    return p0 + (3 * u2 - 2 * u3) * (p1 - p0) + (h * (u3 - 2 * u2 + u)) * m0 + (h * (u3 - u2)) * m1;
}

glm::dvec3 up_at(geo::LatLon place) {
    const double lat = place.lat.radians();
    const double lon = place.lon.radians();
    return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

geo::LatLon place_under(const glm::dvec3& up) {
    return {geo::Degrees::from_radians(std::atan2(up.z, std::hypot(up.x, up.y))),
            geo::Degrees::from_radians(std::atan2(up.y, up.x))};
}

/// `angle` plus whole turns, as near to `before` as it gets.
double unwound(double angle, double before) {
    return before + geo::wrapped_180(geo::Degrees{angle - before}).value;
}

/// Speeds at all knots of one of their values, with those at the ends that make the end spans parabolas.
template <class Knot, class T>
void set_speeds(std::vector<Knot>& knots, const std::vector<FlightKey>& keys, T Knot::*value,
                T Knot::*speed) {
    const std::size_t n = knots.size();
    const auto span = [&](std::size_t i) { return keys[i + 1].time_s - keys[i].time_s; };
    const auto mean = [&](std::size_t i) { return (knots[i + 1].*value - knots[i].*value) / span(i); };
    for (std::size_t i = 0; i < n; ++i) knots[i].*speed = T(0);
    for (std::size_t i = 1; i + 1 < n; ++i)
        knots[i].*speed = limited_speed(mean(i - 1), mean(i), span(i - 1), span(i));
    if (n < 2) return;
    if (n == 2) {
        knots[0].*speed = knots[1].*speed = mean(0);
        return;
    }
    const auto at_end = [](const T& mean_speed, const T& inner) {
        const T parabola = 1.5 * mean_speed - 0.5 * inner;
        return limited_speed(mean_speed, parabola, 1, 0);
    };
    knots.front().*speed = at_end(mean(0), knots[1].*speed);
    knots.back().*speed = at_end(mean(n - 2), knots[n - 2].*speed);
}

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

/// The eight numbers of a line between blanks.
Result<FlightKey> parse_key(std::string_view line) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at < line.size();) {
        const std::size_t begin = line.find_first_not_of(" \t", at);
        if (begin == std::string_view::npos) break;
        const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        const auto number = parse_numbers(line.substr(begin, end - begin));
        if (!number || number->size() != 1) {
            return Error{ErrorKind::input,
                         fmt::format("\"{}\" is not a number", line.substr(begin, end - begin))};
        }
        numbers.push_back(number->front());
        at = end;
    }
    if (numbers.size() != 8) {
        return Error{ErrorKind::input,
                     fmt::format("a key has 8 numbers (time, lat, lon, H, heading, pitch, roll, fov), not {}",
                                 numbers.size())};
    }
    using geo::Degrees;
    return FlightKey{.time_s = numbers[0],
                     .place = {Degrees{numbers[1]}, Degrees{numbers[2]}},
                     .H = {numbers[3]},
                     .heading = Degrees{numbers[4]},
                     .pitch = Degrees{numbers[5]},
                     .roll = Degrees{numbers[6]},
                     .fov = Degrees{numbers[7]}};
}

/// What is wrong with a key after the one before it, if there is one; empty: nothing.
std::string fault_of(const FlightKey& key, const FlightKey* before) {
    ViewState view;
    put(view, key);
    if (const auto fine = check(view); !fine) return fine.error().message;
    if (!(std::abs(key.time_s) <= 1e6)) return "times are at most 1000000 s";
    if (before == nullptr) return {};
    if (!(key.time_s > before->time_s))
        return fmt::format("time {} is not after the key before, {}", key.time_s, before->time_s);
    if (!joins(*before, key))
        return "more than 90 degrees of the earth from the key before: the way there is not clear";
    return {};
}

}  // namespace

FlightKey key_of(const ViewState& view, double time_s) {
    return {time_s, view.place, view.H, view.heading, view.pitch, view.roll, view.fov};
}

void put(ViewState& view, const FlightKey& key) {
    view.place = key.place;
    view.H = key.H;
    view.heading = key.heading;
    view.pitch = key.pitch;
    view.roll = key.roll;
    view.fov = key.fov;
}

bool joins(const FlightKey& a, const FlightKey& b) {
    return glm::dot(up_at(a.place), up_at(b.place)) >= 0;
}

Result<FlightPath> FlightPath::create(std::vector<FlightKey> keys) {
    if (keys.empty()) return Error{ErrorKind::usage, "a flight needs a key"};
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::string fault = fault_of(keys[i], i == 0 ? nullptr : &keys[i - 1]);
        if (!fault.empty()) return Error{ErrorKind::usage, fmt::format("key {}: {}", i + 1, fault)};
    }
    FlightPath path;
    path.keys_ = std::move(keys);
    path.choose_pole();
    path.make_knots();
    return path;
}

void FlightPath::choose_pole() {
    double farthest = 0;
    for (const FlightKey& key : keys_) {
        if (std::abs(key.place.lat.value) > std::abs(farthest)) farthest = key.place.lat.value;
    }
    pole_ = std::abs(farthest) < kPolarLat ? 0 : farthest > 0 ? 1 : -1;
}

/// The heading as it is interpolated: straight on over a pole it does not change.
double FlightPath::turned_heading(const FlightKey& key) const {
    return key.heading.value - pole_ * key.place.lon.value;
}

void FlightPath::make_knots() {
    knots_.reserve(keys_.size());
    for (const FlightKey& key : keys_) {
        Knot knot{};
        knot.up = up_at(key.place);
        knot.H = key.H.m;
        knot.pitch = key.pitch.value;
        knot.fov = key.fov.value;
        knot.heading = turned_heading(key);
        knot.roll = key.roll.value;
        if (!knots_.empty()) {
            knot.heading = unwound(knot.heading, knots_.back().heading);
            knot.roll = unwound(knot.roll, knots_.back().roll);
        }
        knots_.push_back(knot);
    }
    set_speeds(knots_, keys_, &Knot::up, &Knot::up_speed);
    set_speeds(knots_, keys_, &Knot::H, &Knot::H_speed);
    set_speeds(knots_, keys_, &Knot::heading, &Knot::heading_speed);
    set_speeds(knots_, keys_, &Knot::pitch, &Knot::pitch_speed);
    set_speeds(knots_, keys_, &Knot::roll, &Knot::roll_speed);
    set_speeds(knots_, keys_, &Knot::fov, &Knot::fov_speed);
}

FlightKey FlightPath::at(double time_s) const {
    const auto later = [](double time, const FlightKey& key) { return time < key.time_s; };
    const auto next = std::upper_bound(keys_.begin(), keys_.end(), time_s, later);
    if (next == keys_.begin()) return keys_.front();
    const auto i = static_cast<std::size_t>(next - keys_.begin()) - 1;
    if (next == keys_.end() || time_s == keys_[i].time_s) return keys_[i];

    const double h = keys_[i + 1].time_s - keys_[i].time_s;
    const double u = (time_s - keys_[i].time_s) / h;
    const Knot& a = knots_[i];
    const Knot& b = knots_[i + 1];
    const auto between = [&](auto Knot::*value, auto Knot::*speed) {
        return hermite(a.*value, b.*value, a.*speed, b.*speed, h, u);
    };
    FlightKey key;
    key.time_s = time_s;
    // A camera that rests keeps its place to the last bit, and its longitude at a pole.
    key.place = a.up == b.up ? keys_[i].place : place_under(between(&Knot::up, &Knot::up_speed));
    key.H.m = between(&Knot::H, &Knot::H_speed);
    key.heading = geo::wrapped_360(
        geo::Degrees{between(&Knot::heading, &Knot::heading_speed) + pole_ * key.place.lon.value});
    key.pitch.value = std::clamp(between(&Knot::pitch, &Knot::pitch_speed), -90.0, 90.0);
    key.roll.value = between(&Knot::roll, &Knot::roll_speed);
    key.fov.value = between(&Knot::fov, &Knot::fov_speed);
    return key;
}

Result<FlightPath> FlightPath::parse(std::string_view text, std::string_view name) {
    std::vector<FlightKey> keys;
    bool header_seen = false;
    int number = 0;
    const auto wrong = [&](const std::string& why) {
        return Error{ErrorKind::input, fmt::format("{}:{}: {}", name, number, why)};
    };
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view whole = text.substr(at, end - at);
        at = end + 1;
        ++number;
        const std::string line = trimmed(whole.substr(0, whole.find('#')));
        if (line.empty()) continue;
        if (!header_seen) {
            if (line != kHeader)
                return wrong(fmt::format("a flight file begins with the line \"{}\"", kHeader));
            header_seen = true;
            continue;
        }
        const auto key = parse_key(line);
        if (!key) return wrong(key.error().message);
        const std::string fault = fault_of(*key, keys.empty() ? nullptr : &keys.back());
        if (!fault.empty()) return wrong(fault);
        keys.push_back(*key);
    }
    if (!header_seen) {
        number = 1;
        return wrong(fmt::format("a flight file begins with the line \"{}\"", kHeader));
    }
    if (keys.empty()) return wrong("no key");
    return create(std::move(keys));
}

Result<FlightPath> FlightPath::load(const std::filesystem::path& file) {
    std::error_code failed;
    const auto bytes = std::filesystem::file_size(file, failed);
    if (failed) return Error{ErrorKind::input, fmt::format("{}: {}", file.string(), failed.message())};
    if (bytes > kLongestFile)
        return Error{ErrorKind::input, fmt::format("{}: too long for a flight file", file.string())};
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) return Error{ErrorKind::input, fmt::format("{}: cannot be read", file.string())};
    return parse(text, file.string());
}

std::string FlightPath::to_text() const {
    std::string text =
        fmt::format("{}\n# time_s lat_deg lon_deg H_m heading_deg pitch_deg roll_deg fov_deg\n", kHeader);
    for (const FlightKey& key : keys_) {
        // "{}" prints the shortest digits that read back as the same double.
        text += fmt::format("{} {} {} {} {} {} {} {}\n", key.time_s, key.place.lat.value, key.place.lon.value,
                            key.H.m, key.heading.value, key.pitch.value, key.roll.value, key.fov.value);
    }
    return text;
}

Result<void> write_flight(const FlightPath& flight, const std::filesystem::path& file) {
    auto unfinished = file;
    unfinished.replace_filename(fmt::format(".{}.{}", file.filename().string(), static_cast<long>(getpid())));
    std::ofstream stream(unfinished, std::ios::binary);
    stream << flight.to_text();
    stream.close();
    std::error_code failed;
    if (stream) std::filesystem::rename(unfinished, file, failed);
    if (!stream || failed) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        return Error{ErrorKind::internal, fmt::format("{}: cannot be written{}{}", file.string(),
                                                      failed ? ": " : "", failed ? failed.message() : "")};
    }
    return {};
}

}  // namespace relevo::viewer
