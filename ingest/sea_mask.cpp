#include "ingest/sea_mask.hpp"

#include <filesystem>

#include "ingest/refusal.hpp"

namespace relevo::ingest {

class SeaMask::Shape {};

SeaMask::SeaMask(std::string name, std::unique_ptr<Shape> shape)
    : name_(std::move(name)), shape_(std::move(shape)) {}
SeaMask::SeaMask(SeaMask&&) noexcept = default;
SeaMask& SeaMask::operator=(SeaMask&&) noexcept = default;
SeaMask::~SeaMask() = default;

Result<SeaMask> SeaMask::open(const std::string& file, const geo::GridFrame&) {
    return refusal(std::filesystem::path(file).filename().string(), "masks of the sea cannot be read yet",
                   "Use --sea auto or --sea none");
}

Result<void> SeaMask::read(Window, lod::Raster<std::uint8_t>&) const {
    return {};
}

}  // namespace relevo::ingest
