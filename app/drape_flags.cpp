#include "app/drape_flags.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "ingest/image_file.hpp"
#include "ingest/vector_file.hpp"
#include "viewer/ground/ground_data.hpp"
#include "viewer/numbers.hpp"

namespace relevo::app {

namespace {

using viewer::Overlay;

ingest::GridSquare square_of(const viewer::Page& page, int finer) {
    const double step = std::ldexp(1.0, page.level - finer);
    return {page.column * viewer::kPageCells * step, page.row * viewer::kPageCells * step, step,
            viewer::kPagePosts};
}

/// Levels that page tables and coordinates hold.
int most_finer(const geo::GridFrame& frame) {
    constexpr int kMostLevels = 18;
    return std::clamp(kMostLevels - frame.levels(), 0, viewer::Drape::kMostFiner);
}

class ImageDrape final : public viewer::Drape {
  public:
    ImageDrape(std::shared_ptr<const ingest::ImageFile> image, const geo::GridFrame& frame)
        : image_(std::move(image)),
          finer_(std::clamp(static_cast<int>(std::ceil(-std::log2(image_->pixel_posts()) - 0.1)), 0,
                            most_finer(frame))) {}

    int finer() const override { return finer_; }
    Result<viewer::DrapeTexels> read(const viewer::Page& page) const override {
        return image_->read(square_of(page, finer_));
    }

  private:
    std::shared_ptr<const ingest::ImageFile> image_;
    int finer_;
};

class VectorDrape final : public viewer::Drape {
  public:
    VectorDrape(std::shared_ptr<const ingest::VectorFile> lines, const geo::GridFrame& frame,
                std::array<std::uint8_t, 3> colour)
        : lines_(std::move(lines)), finer_(most_finer(frame)), colour_(colour) {}

    int finer() const override { return finer_; }
    std::optional<std::array<std::uint8_t, 3>> line_colour() const override { return colour_; }
    Result<viewer::DrapeTexels> read(const viewer::Page& page) const override {
        return lines_->draw(square_of(page, finer_));
    }

  private:
    std::shared_ptr<const ingest::VectorFile> lines_;
    int finer_;
    std::array<std::uint8_t, 3> colour_;
};

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

void place(viewer::ViewState& view, const Overlay& overlay) {
    const auto is_it = [&](const Overlay& other) {
        return other.kind == overlay.kind && other.file == overlay.file;
    };
    if (std::any_of(view.overlays.begin(), view.overlays.end(), is_it)) return;
    const auto is_drawn = [](const Overlay& other) {
        return other.kind == Overlay::Kind::contours || other.kind == Overlay::Kind::graticule;
    };
    view.overlays.insert(std::find_if(view.overlays.begin(), view.overlays.end(), is_drawn), overlay);
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
    constexpr std::array<std::array<std::uint8_t, 3>, 4> kColours{
        {{214, 20, 110}, {0, 110, 200}, {214, 92, 0}, {110, 40, 170}}};
    viewer::Drapes drapes;
    if (flags.imagery.size() + flags.vectors.size() > viewer::GroundData::kMostDrapes)
        return Error{ErrorKind::usage, fmt::format("--imagery and --vectors: at most {} files together",
                                                   viewer::GroundData::kMostDrapes)};
    for (const std::string& text : flags.imagery) {
        const auto flag = parse("--imagery", text);
        if (!flag) return flag.error();
        auto image = ingest::ImageFile::open(flag->file, frame);
        if (!image) return Error{image.error().kind, "--imagery: " + image.error().message};
        place(view, {.kind = Overlay::Kind::imagery,
                     .opacity = flag->opacity,
                     .file = static_cast<int>(drapes.size())});
        drapes.push_back(std::make_shared<ImageDrape>(*std::move(image), frame));
    }
    for (std::size_t i = 0; i < flags.vectors.size(); ++i) {
        const auto flag = parse("--vectors", flags.vectors[i]);
        if (!flag) return flag.error();
        auto lines = ingest::VectorFile::open(flag->file, frame);
        if (!lines) return Error{lines.error().kind, "--vectors: " + lines.error().message};
        place(view, {.kind = Overlay::Kind::vectors,
                     .opacity = flag->opacity,
                     .file = static_cast<int>(drapes.size())});
        drapes.push_back(std::make_shared<VectorDrape>(*std::move(lines), frame, kColours[i]));
    }
    return drapes;
}

}  // namespace relevo::app
