#include "app/drape_flags.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "app/layer_files.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/numbers.hpp"
#include "viewer/overlay/overlay_list.hpp"

namespace relevo::app {

namespace {

using viewer::Overlay;

/// FILE[,OPACITY]; a file's own name may have commas.
struct FileFlag {
    std::string file;
    double opacity = 1;
};
Result<FileFlag> parse(const char* flag, const std::string& text) {
    const std::size_t comma = text.rfind(',');
    if (comma == std::string::npos) return FileFlag{text};
    const auto opacity = viewer::parse_numbers(std::string_view(text).substr(comma + 1));
    if (!opacity || opacity->size() != 1) return FileFlag{text};
    if (!(opacity->front() >= 0 && opacity->front() <= 1))
        return Error{ErrorKind::usage, fmt::format("{} {}: opacity is from 0 to 1", flag, text)};
    return FileFlag{text.substr(0, comma), opacity->front()};
}

}  // namespace

void add_drape_flags(CLI::App& command, ViewFlags& flags) {
    command
        .add_option("--imagery", flags.imagery,
                    "A georeferenced picture over the ground, in any CRS; may be given several times")
        ->type_name("FILE[,OPACITY]")
        ->allow_extra_args(false);
    command
        .add_option(
            "--vectors", flags.vectors,
            "Lines and points over the ground: GPX, GeoJSON, Shapefile ...; may be given several times")
        ->type_name("FILE[,OPACITY]")
        ->allow_extra_args(false);
}

Result<viewer::Drapes> read_drapes(const ViewFlags& flags, const geo::GridFrame& frame,
                                   viewer::ViewState& view) {
    viewer::Drapes drapes;
    if (flags.imagery.size() + flags.vectors.size() > viewer::GroundData::kMostDrapes)
        return Error{ErrorKind::usage, fmt::format("--imagery and --vectors: at most {} files together",
                                                   viewer::GroundData::kMostDrapes)};
    for (const std::string& text : flags.imagery) {
        const auto flag = parse("--imagery", text);
        if (!flag) return flag.error();
        auto image = open_image(flag->file, frame);
        if (!image) return Error{image.error().kind, "--imagery: " + image.error().message};
        put_in_place(view.overlays, {.kind = Overlay::Kind::imagery,
                                     .opacity = flag->opacity,
                                     .file = static_cast<int>(drapes.size())});
        drapes.push_back(*std::move(image));
    }
    for (std::size_t i = 0; i < flags.vectors.size(); ++i) {
        const auto flag = parse("--vectors", flags.vectors[i]);
        if (!flag) return flag.error();
        auto lines = open_lines(flag->file, frame, i);
        if (!lines) return Error{lines.error().kind, "--vectors: " + lines.error().message};
        put_in_place(view.overlays, {.kind = Overlay::Kind::vectors,
                                     .opacity = flag->opacity,
                                     .file = static_cast<int>(drapes.size())});
        drapes.push_back(*std::move(lines));
    }
    return drapes;
}

}  // namespace relevo::app
