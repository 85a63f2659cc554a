#include "lod/scene/scene_files.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lod/scene/block_grid.hpp"
#include "lod/scene/sha256.hpp"

namespace relevo::lod {
namespace {

constexpr const char* kChecksum = "sha256";
constexpr int kDeepest = 16;  // scene.json has lists in objects in lists, and no more

/// Text that is not UTF-8 (a file name may be) is replaced where it is not: JSON knows nothing else.
std::string dump(const nlohmann::json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Longitude and latitude of WGS 84, or UPS with easting before northing.
int epsg_code(geo::FrameKind kind) {
    switch (kind) {
        case geo::FrameKind::ups_north:
            return 5041;
        case geo::FrameKind::ups_south:
            return 5042;
        case geo::FrameKind::geographic:
            break;
    }
    return 4326;
}

/// Discarded where it is not JSON, or so deep that whoever goes down into it (a copy, a dump) has no stack
/// for it.
nlohmann::json parse(const std::string& text) {
    bool too_deep = false;
    const auto keep = [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
        too_deep = too_deep || depth > kDeepest;
        return !too_deep;
    };
    nlohmann::json json = nlohmann::json::parse(text, keep, false);
    if (too_deep) return nlohmann::json::value_t::discarded;
    return json;
}

/// Of everything but itself, in one form whatever the spaces and the order of keys in the file. \pre the
/// checksum is not in it
std::string checksum(const nlohmann::json& json) {
    const std::string text = dump(json, -1);
    return sha256_hex(std::as_bytes(std::span(text)));
}

}  // namespace

std::string level_folder(const char* folder, int level) {
    return fmt::format("{}-{}", folder, level);
}

std::string block_file_name(const std::string& folder, int block_column, int block_row) {
    return fmt::format("{}/r{:04}-c{:04}.tif", folder, block_row, block_column);
}

GeoReference geo_reference(const geo::GridFrame& frame, int column, int row) {
    return {epsg_code(frame.kind), frame.west + column * frame.step_x, frame.north - row * frame.step_y,
            frame.step_x, frame.step_y};
}

std::string scene_text(const SceneInfo& info) {
    nlohmann::json json = to_json(info);
    json[kChecksum] = checksum(json);
    return dump(json, 1) + "\n";
}

Result<SceneInfo> scene_info_from_text(const std::string& text) {
    nlohmann::json json = parse(text);
    if (json.is_discarded()) return Error{ErrorKind::damaged, "it is cut short or not JSON"};
    Result<SceneInfo> info = scene_info_from_json(json);
    // A newer format is named as such, whatever it does with checksums.
    if (!info && info.error().kind == ErrorKind::input) return info;
    nlohmann::json stated;
    if (json.is_object() && json.contains(kChecksum)) {
        stated = std::move(json[kChecksum]);
        json.erase(kChecksum);
    }
    if (stated.is_null() || stated != checksum(json)) {
        return Error{ErrorKind::damaged, "its checksum is wrong: it was changed after it was written"};
    }
    return info;
}

std::string mosaic_text(const SceneInfo& info) {
    const bool whole = info.height_type == HeightType::int16;
    const char* type = whole ? "Int16" : "Float32";
    const geo::GridFrame& frame = info.frame;
    std::string text = fmt::format(
        "<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">\n"
        "  <SRS dataAxisToSRSAxisMapping=\"{}\">EPSG:{}</SRS>\n"
        "  <GeoTransform>{}, {}, 0, {}, 0, {}</GeoTransform>\n"
        "  <Metadata>\n    <MDI key=\"AREA_OR_POINT\">Point</MDI>\n  </Metadata>\n"
        "  <VRTRasterBand dataType=\"{}\" band=\"1\" blockXSize=\"{}\" blockYSize=\"{}\">\n"
        "    <NoDataValue>{}</NoDataValue>\n    <UnitType>m</UnitType>\n    "
        "<ColorInterp>Gray</ColorInterp>\n",
        frame.columns, frame.rows, frame.is_polar() ? "1,2" : "2,1", epsg_code(frame.kind),
        frame.west - frame.step_x / 2, frame.step_x, frame.north + frame.step_y / 2, -frame.step_y, type,
        SceneInfo::kBlockSide, SceneInfo::kBlockSide, whole ? "-32768" : "nan");
    const BlockGrid grid = BlockGrid::of_heights(frame.columns, frame.rows);
    for (const BlockInfo& block : info.heights) {
        const BlockGrid::Box box = grid.box(block.column, block.row);
        text += fmt::format(
            "    <SimpleSource>\n"
            "      <SourceFilename relativeToVRT=\"1\">{0}</SourceFilename>\n"
            "      <SourceBand>1</SourceBand>\n"
            "      <SourceProperties RasterXSize=\"{1}\" RasterYSize=\"{2}\" DataType=\"{3}\" "
            "BlockXSize=\"{1}\" "
            "BlockYSize=\"{2}\"/>\n"
            "      <SrcRect xOff=\"0\" yOff=\"0\" xSize=\"{1}\" ySize=\"{2}\"/>\n"
            "      <DstRect xOff=\"{4}\" yOff=\"{5}\" xSize=\"{1}\" ySize=\"{2}\"/>\n"
            "    </SimpleSource>\n",
            block.file, box.columns, box.rows, type, box.column, box.row);
    }
    return text + "  </VRTRasterBand>\n</VRTDataset>\n";
}

bool joins_all_blocks(const std::string& mosaic, const SceneInfo& info) {
    const auto holds = [&](const std::string& part) { return mosaic.find(part) != std::string::npos; };
    const std::string size =
        fmt::format("<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\"", info.frame.columns, info.frame.rows);
    return holds(size) && holds("</VRTDataset>") &&
           std::ranges::all_of(info.heights,
                               [&](const BlockInfo& block) { return holds(">" + block.file + "<"); });
}

}  // namespace relevo::lod
