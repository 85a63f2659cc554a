#include "viewer/flight/flight_files.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "viewer/flight/recording.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/picture.hpp"
#include "viewer/picture_notes.hpp"

namespace relevo::viewer {

namespace {

std::filesystem::path output_file(const FlightState& flight, const char* name, const char* ending) {
    return fresh_file(flight.options.output_folder, name, ending);
}

PictureNotes notes(const FlightState& flight, const Picture& picture) {
    return picture_notes(flight.scene, flight.terrain, flight.heights, flight.view, picture.width,
                         picture.height);
}

}  // namespace

Result<void> take_screenshot(FlightState& flight) {
    const auto file = output_file(flight, "relevo", "png");
    const Picture picture = flight.desk.window().read_back();
    if (auto done = write_picture(picture, file, notes(flight, picture)); !done) return done;
    flight.say(fmt::format("screenshot {}", file.string()));
    return {};
}

void take_large_picture(FlightState& flight, int width, int height) {
    constexpr int kTimes = 4;
    const int times = std::min(kTimes, kLargestPicture / std::max(width, height));
    const auto file = output_file(flight, "relevo", "png");
    auto painter = OffscreenPainter::create_here(flight.terrain, flight.ground, flight.heights);
    if (!painter) return flight.tell(painter.error().message);
    const auto drawn = painter->draw(flight.view, {.width = times * width,
                                                   .height = times * height,
                                                   .samples = 1,
                                                   .timed = false,
                                                   .marks = flight.panels.picture_marks});
    if (!drawn) return flight.tell(drawn.error().message);
    if (auto done = write_picture(drawn->picture, file, notes(flight, drawn->picture)); !done)
        return flight.tell(done.error().message);
    flight.say(fmt::format("picture {}", file.string()));
}

void toggle_recording(FlightState& flight) {
    if (flight.recording) {
        if (auto done = end_recording(flight); !done) flight.tell(done.error().message);
    } else {
        flight.recording.emplace(output_file(flight, "flight", "flight"));
        flight.tell("recording; R again ends it");
    }
}

Result<void> end_recording(FlightState& flight) {
    if (!flight.recording) return {};
    const auto written = flight.recording->write();
    flight.recording.reset();
    if (!written) return written.error();
    if (*written) flight.say(**written);
    return {};
}

void play_key_frames(FlightState& flight) {
    std::vector<FlightKey> keys = flight.key_frames.keys;
    for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i].time_s = static_cast<double>(i) * flight.key_frames.seconds_between;
    if (keys.size() < 2) return flight.tell("a path needs two key frames (K) at least");
    auto path = FlightPath::create(std::move(keys));
    if (!path) return flight.tell(path.error().message);
    const auto file = output_file(flight, "path", "flight");
    if (auto done = write_flight(*path, file); !done) return flight.tell(done.error().message);
    flight.say(fmt::format("path {}", file.string()));
    flight.motion.play(*std::move(path));
}

void save_measurements(FlightState& flight) {
    const std::vector<Shape>& shapes = flight.measuring.tool().shapes();
    std::vector<Shape> whole;
    std::vector<const ShapeResult*> results;
    for (const Shape& shape : shapes) {
        if (!is_measurable(shape)) continue;
        whole.push_back(shape);
        results.push_back(flight.measuring.results().find(shape));
    }
    if (whole.empty()) return flight.tell("nothing is measured yet");
    const auto file = output_file(flight, "measurements", "geojson");
    if (auto done = flight.options.files.save(whole, results, file); !done)
        return flight.tell(done.error().message);
    flight.say(fmt::format("measurements {}", file.string()));
}

void save_viewshed(FlightState& flight) {
    const MeasureTool& tool = flight.measuring.tool();
    const ShapeResult* result =
        tool.current() ? flight.measuring.results().find(tool.shapes()[*tool.current()]) : nullptr;
    if (result == nullptr || !result->viewshed) return flight.tell("no viewshed is measured and chosen");
    const auto file = output_file(flight, "viewshed", "tif");
    if (auto done = flight.options.files.save_viewshed(flight.scene.info(), *result->viewshed, file); !done)
        return flight.tell(done.error().message);
    flight.say(fmt::format("viewshed {}", file.string()));
}

void open_path(FlightState& flight, const std::filesystem::path& path) {
    std::error_code failed;
    const auto& uses_of = flight.options.layers.uses_of;
    if (!uses_of || scene_at(path) || !std::filesystem::exists(path, failed)) return flight.desk.open(path);
    const std::vector<FileUse> uses = uses_of(path);
    if (uses.size() > 1) return flight.panels.ask_use(path, uses);
    open_as(flight, path, uses.empty() ? FileUse::elevation : uses.front());
}

void open_as(FlightState& flight, const std::filesystem::path& path, FileUse use) {
    switch (use) {
        case FileUse::elevation:
            return flight.desk.open(path);
        case FileUse::imagery:
        case FileUse::vectors:
            if (auto begun = flight.layers.open(path, use, flight.options.layers); !begun)
                flight.tell(begun.error().message);
            return;
        case FileUse::measurements:
            break;
    }
    const auto loaded = flight.options.files.load(path);
    if (!loaded) return flight.tell(loaded.error().message);
    flight.measuring.tool().insert_shapes(*loaded);
    flight.desk.show_panel(true);
    flight.say(fmt::format("loaded {}: {} measurements", path.filename().string(), loaded->size()));
}

}  // namespace relevo::viewer
