#include "app/layer_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "output/measurement_file.hpp"

#include "ingest/file_content.hpp"
#include "ingest/image_file.hpp"
#include "ingest/vector_file.hpp"
#include "viewer/ground/drape.hpp"

namespace relevo::app {

namespace {

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
    ImageDrape(std::string name, std::shared_ptr<const ingest::ImageFile> image, const geo::GridFrame& frame)
        : name_(std::move(name)),
          image_(std::move(image)),
          finer_(std::clamp(static_cast<int>(std::ceil(-std::log2(image_->pixel_posts()) - 0.1)), 0,
                            most_finer(frame))) {}

    std::string name() const override { return name_; }
    int finer() const override { return finer_; }
    Result<viewer::DrapeTexels> read(const viewer::Page& page) const override {
        return image_->read(square_of(page, finer_));
    }

  private:
    std::string name_;
    std::shared_ptr<const ingest::ImageFile> image_;
    int finer_;
};

class VectorDrape final : public viewer::Drape {
  public:
    VectorDrape(std::string name, std::shared_ptr<const ingest::VectorFile> lines,
                const geo::GridFrame& frame, std::array<std::uint8_t, 3> colour)
        : name_(std::move(name)), lines_(std::move(lines)), finer_(most_finer(frame)), colour_(colour) {}

    std::string name() const override { return name_; }
    int finer() const override { return finer_; }
    std::optional<std::array<std::uint8_t, 3>> line_colour() const override { return colour_; }
    Result<viewer::DrapeTexels> read(const viewer::Page& page) const override {
        return lines_->draw(square_of(page, finer_));
    }

  private:
    std::string name_;
    std::shared_ptr<const ingest::VectorFile> lines_;
    int finer_;
    std::array<std::uint8_t, 3> colour_;
};

std::string name_of(const std::string& file) {
    return std::filesystem::path(file).filename().string();
}

std::vector<viewer::FileUse> uses_of(const std::filesystem::path& file) {
    std::vector<viewer::FileUse> uses;
    if (output::is_measurement_file(file)) {
        const auto measurements = output::load_measurements(file);
        if (measurements && !measurements->empty()) uses.push_back(viewer::FileUse::measurements);
    }
    for (const ingest::FileContent content : ingest::contents_of(file.string())) {
        switch (content) {
            case ingest::FileContent::imagery:
                uses.push_back(viewer::FileUse::imagery);
                break;
            case ingest::FileContent::vectors:
                uses.push_back(viewer::FileUse::vectors);
                break;
            case ingest::FileContent::elevation:
                // What is none is said by the import; but measurements are something.
                if (uses.empty() || uses.back() == viewer::FileUse::imagery)
                    uses.push_back(viewer::FileUse::elevation);
                break;
        }
    }
    return uses;
}

}  // namespace

Result<std::shared_ptr<const viewer::Drape>> open_image(const std::string& file,
                                                        const geo::GridFrame& frame) {
    auto image = ingest::ImageFile::open(file, frame);
    if (!image) return image.error();
    return std::shared_ptr<const viewer::Drape>(
        std::make_shared<ImageDrape>(name_of(file), *std::move(image), frame));
}

Result<std::shared_ptr<const viewer::Drape>> open_lines(const std::string& file, const geo::GridFrame& frame,
                                                        std::size_t colour) {
    constexpr std::array<std::array<std::uint8_t, 3>, 4> kColours{
        {{214, 20, 110}, {0, 110, 200}, {214, 92, 0}, {110, 40, 170}}};
    auto lines = ingest::VectorFile::open(file, frame);
    if (!lines) return lines.error();
    return std::shared_ptr<const viewer::Drape>(std::make_shared<VectorDrape>(
        name_of(file), *std::move(lines), frame, kColours[colour % kColours.size()]));
}

viewer::LayerFiles layer_files() {
    return {uses_of, [](const std::filesystem::path& file, viewer::FileUse use, const geo::GridFrame& frame,
                        std::size_t colour) {
                return use == viewer::FileUse::vectors ? open_lines(file.string(), frame, colour)
                                                       : open_image(file.string(), frame);
            }};
}

}  // namespace relevo::app
