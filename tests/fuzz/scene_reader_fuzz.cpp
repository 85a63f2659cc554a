// Bytes as the files of a scene: the first says which, the rest is scene.json or a block.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lod/scene/block_file.hpp"
#include "lod/scene/scene_files.hpp"
#include "lod/scene/scene_info.hpp"

namespace {

using namespace relevo;

/// What has been read and found good must come back from what is written of it.
void read_scene_json(const std::string& text) {
    (void)lod::scene_info_from_text(text);  // refuses at the latest by its checksum
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return;
    const auto info = lod::scene_info_from_json(json);
    if (!info) return;
    const auto again = lod::scene_info_from_text(lod::scene_text(*info));
    if (!again) {
        fmt::print(stderr, "written, but not read again: {}\n", again.error().message);
        std::abort();
    }
}

template <class T>
void read_block(std::span<const std::byte> bytes, lod::BlockShape shape) {
    const auto samples = lod::decode_block<T>(bytes, shape, "block");
    if (samples && samples->size() != shape.samples()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::span<const std::byte> rest = std::as_bytes(std::span(data + 2, size - 2));
    // 'j' for JSON, 'i', 'u', 'f' for blocks; then the block's side, so that seeds are easily made.
    const int side = data[1];
    const lod::BlockShape shape{side + 1, side + 1, data[0] == 'u' ? 3 : 1};
    switch (data[0]) {
        case 'i':
            read_block<std::int16_t>(rest, shape);
            break;
        case 'u':
            read_block<std::uint16_t>(rest, shape);
            break;
        case 'f':
            read_block<float>(rest, shape);
            (void)lod::block_shape(rest, "block");
            break;
        default:
            read_scene_json({reinterpret_cast<const char*>(rest.data()), rest.size()});
    }
    return 0;
}
