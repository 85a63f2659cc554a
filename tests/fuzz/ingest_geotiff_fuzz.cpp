// Bytes as a small GeoTIFF: opened as ingest does, and read. The last byte says what the user adds.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <cpl_vsi.h>

#include "ingest/source/source.hpp"

namespace {

constexpr const char* kFile = "/vsimem/fuzz.tif";

void read_source(const relevo::ingest::SourceRequest& request) {
    const auto source = relevo::ingest::Source::open(request);
    if (!source) {
        if (source.error().message.empty()) std::abort();
        return;
    }
    // Beyond its edges, and a part of what may be large.
    const auto heights =
        source->read({-1, -1, std::min(source->columns(), 300) + 2, std::min(source->rows(), 300) + 2});
    if (!heights) return;
    if (!std::isnan(heights->at(0, 0))) std::abort();
    for (const double height : heights->samples())
        if (std::isinf(height)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1) return 0;
    const std::uint8_t flags = data[size - 1];
    std::vector<std::uint8_t> file{data, data + size - 1};
    VSIFCloseL(VSIFileFromMemBuffer(kFile, file.data(), file.size(), FALSE));
    relevo::ingest::SourceRequest request;
    request.input = kFile;
    if ((flags & 1) != 0) request.crs = "EPSG:4326";
    if ((flags & 2) != 0) request.bounds = relevo::ingest::Bounds{10, 45, 11, 46};
    if ((flags & 4) != 0) request.band = 1;
    if ((flags & 8) != 0) request.encoding = relevo::ingest::HeightEncoding::terrarium;
    if ((flags & 16) != 0) request.nodata = 0;
    if ((flags & 32) != 0) request.height_scale = 0.1;
    read_source(request);
    VSIUnlink(kFile);
    return 0;
}
