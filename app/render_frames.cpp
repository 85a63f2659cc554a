#include "app/render_frames.hpp"

#include <cmath>
#include <filesystem>
#include <regex>

#include <fmt/format.h>

namespace relevo::app {

namespace fs = std::filesystem;

Result<std::string> frame_name(const std::string& pattern, int number) {
    static const std::regex place("%(0?)([0-9]?)d");
    const auto begin = std::sregex_iterator(pattern.begin(), pattern.end(), place);
    if (std::distance(begin, std::sregex_iterator()) != 1)
        return Error{ErrorKind::usage,
                     fmt::format("-o {}: the frames of a flight need one %05d for their numbers", pattern)};
    const std::smatch& found = *begin;
    const int width = found[2].length() == 0 ? 0 : found[2].str()[0] - '0';
    const std::string digits =
        found[1].length() != 0 ? fmt::format("{:0{}d}", number, width) : fmt::format("{:{}d}", number, width);
    return found.prefix().str() + digits + found.suffix().str();
}

Result<int> render_frames(const FrameRequest& request, viewer::OffscreenPainter& painter,
                          const std::function<void(double)>& progress) {
    const viewer::FlightPath& flight = request.flight;
    // Of a flight of whole frames the last one counts, too.
    const int frames = static_cast<int>(std::floor(flight.duration_s() * request.fps + 1e-6)) + 1;
    for (int i = 0; i < frames; ++i) {
        const auto name = frame_name(request.pattern, i);
        if (!name) return name.error();
        progress(static_cast<double>(i) / frames);
        std::error_code failed;
        if (fs::exists(*name, failed)) continue;
        fs::create_directories(fs::path(*name).parent_path(), failed);
        viewer::ViewState view = request.view;
        put(view, flight.at(flight.begin_s() + i / request.fps));
        const auto drawn = painter.draw(view, request.picture);
        if (!drawn) return drawn.error();
        if (auto done = viewer::write_picture(drawn->picture, *name, request.notes(view)); !done)
            return done.error();
    }
    progress(1);
    return frames;
}

}  // namespace relevo::app
