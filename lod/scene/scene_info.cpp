#include "lod/scene/scene_info.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "geo/geoid_nodes.hpp"
#include "lod/scene/block_grid.hpp"
#include "lod/scene/json_fields.hpp"
#include "lod/scene/level_grid.hpp"
#include "lod/scene/post_mark.hpp"
#include "lod/scene/scene_files.hpp"

namespace relevo::lod {
namespace {

constexpr int kMaxSide = 1 << 24;  // posts; the whole earth at 0.1"
constexpr double kMaxHeight = 1e6;

nlohmann::json to_json(const SourceInfo& source) {
    nlohmann::json json = {{"name", source.name},
                           {"sha256", source.sha256},
                           {"crs", source.crs},
                           {"crs_wkt", source.crs_wkt},
                           {"columns", source.columns},
                           {"rows", source.rows},
                           {"step_x", source.step_x},
                           {"step_y", source.step_y},
                           {"step_unit", source.step_unit},
                           {"operation", source.operation},
                           {"operation_accuracy_m", nullptr},
                           {"operation_note", source.operation_note},
                           {"notes", source.notes}};
    if (source.operation_accuracy_m) json["operation_accuracy_m"] = *source.operation_accuracy_m;
    return json;
}

SourceInfo source_from(JsonFields& fields) {
    SourceInfo source;
    source.name = fields.text("name");
    source.sha256 = fields.text("sha256");
    source.crs = fields.text("crs");
    source.crs_wkt = fields.text("crs_wkt");
    source.columns = fields.integer("columns", 0, std::numeric_limits<int>::max());
    source.rows = fields.integer("rows", 0, std::numeric_limits<int>::max());
    source.step_x = fields.number("step_x");
    source.step_y = fields.number("step_y");
    source.step_unit = fields.text("step_unit");
    source.operation = fields.text("operation");
    source.operation_accuracy_m = fields.optional_number("operation_accuracy_m");
    source.operation_note = fields.text("operation_note");
    source.notes = fields.text("notes");
    return source;
}

nlohmann::json to_json(const SeamInfo& seam) {
    return {{"first", seam.first},
            {"second", seam.second},
            {"pairs", seam.pairs},
            {"max_step_m", seam.max_step_m},
            {"rms_step_m", seam.rms_step_m}};
}

SeamInfo seam_from(JsonFields& fields) {
    SeamInfo seam;
    seam.first = fields.integer("first", 0, PostMark::kUnknownSource);
    seam.second = fields.integer("second", 0, PostMark::kUnknownSource);
    seam.pairs = fields.count("pairs");
    seam.max_step_m = fields.number("max_step_m", 0, 2 * kMaxHeight);
    seam.rms_step_m = fields.number("rms_step_m", 0, 2 * kMaxHeight);
    return seam;
}

nlohmann::json to_json(const OutlierInfo& outlier) {
    return {{"column", outlier.column},
            {"row", outlier.row},
            {"H_m", outlier.H_m},
            {"median_m", outlier.median_m}};
}

OutlierInfo outlier_from(JsonFields& fields) {
    OutlierInfo outlier;
    outlier.column = fields.integer("column", 0, kMaxSide);
    outlier.row = fields.integer("row", 0, kMaxSide);
    outlier.H_m = fields.number("H_m", -kMaxHeight, kMaxHeight);
    outlier.median_m = fields.number("median_m", -kMaxHeight, kMaxHeight);
    return outlier;
}

nlohmann::json file_to_json(const BlockInfo& block) {
    return {{"file", block.file}, {"sha256", block.sha256}, {"bytes", block.bytes}};
}

nlohmann::json to_json(const std::vector<BlockInfo>& blocks) {
    nlohmann::json json = nlohmann::json::array();
    for (const BlockInfo& block : blocks) {
        json.push_back(file_to_json(block));
        json.back()["column"] = block.column;
        json.back()["row"] = block.row;
    }
    return json;
}

/// A scene names its files by one rule, so no name can lead out of its folder.
BlockInfo block_from(JsonFields& fields, const std::string& file) {
    BlockInfo block;
    block.file = fields.text("file");
    if (block.file != file) fields.wrong("file", fmt::format("is not {}", file));
    block.sha256 = fields.text("sha256");
    block.bytes = fields.count("bytes", std::uint64_t{1} << 29);
    return block;
}

nlohmann::json to_json(const GeoidInfo& geoid) {
    if (geoid.file.file.empty()) return {};
    nlohmann::json json = file_to_json(geoid.file);
    json.update({{"south", geoid.south},
                 {"west", geoid.west},
                 {"step_lat", geoid.step_lat},
                 {"step_lon", geoid.step_lon},
                 {"rows", geoid.rows},
                 {"columns", geoid.columns}});
    return json;
}

GeoidInfo geoid_from(JsonFields fields) {
    GeoidInfo geoid;
    geoid.file = block_from(fields, kGeoidFile);
    geoid.south = fields.number("south", -90, 90);
    geoid.west = fields.number("west", -720, 720);
    geoid.step_lat = fields.number("step_lat", 0, 180);
    geoid.step_lon = fields.number("step_lon", 0, 180);
    constexpr int kMost = 100'000;
    geoid.rows = fields.integer("rows", 1, kMost);
    geoid.columns = fields.integer("columns", 1, kMost);
    if (static_cast<long long>(geoid.rows) * geoid.columns > geo::GeoidNodes::kMost)
        fields.wrong("rows", "are too many");
    return geoid;
}

std::vector<BlockInfo> blocks_from(JsonFields& scene, const char* key, const std::string& folder, int across,
                                   int down) {
    std::vector<BlockInfo> blocks;
    scene.each(key, [&](JsonFields& fields) {
        const int column = fields.integer("column", 0, across - 1);
        const int row = fields.integer("row", 0, down - 1);
        BlockInfo block = block_from(fields, block_file_name(folder, column, row));
        block.column = column;
        block.row = row;
        if (!blocks.empty() && std::pair(blocks.back().row, blocks.back().column) >= std::pair(row, column)) {
            fields.wrong("column", "is out of order");
        }
        blocks.push_back(std::move(block));
    });
    return blocks;
}

nlohmann::json to_json(const LevelInfo& level) {
    return {{kHeightsFolder, to_json(level.heights)}, {kVerticesFolder, to_json(level.vertices)}};
}

template <class T>
nlohmann::json list_to_json(const std::vector<T>& values) {
    nlohmann::json json = nlohmann::json::array();
    for (const T& value : values) json.push_back(to_json(value));
    return json;
}

std::vector<LevelInfo> levels_from(JsonFields& scene, const geo::GridFrame& frame) {
    const int top = LevelGrid::top(frame.levels());
    std::vector<LevelInfo> levels;
    scene.each("levels", [&](JsonFields& fields) {
        const int k = static_cast<int>(levels.size()) + 1;
        if (k > top) return scene.wrong("levels", "are too many");
        const int across = LevelGrid::blocks(frame.levels(), k);
        const auto blocks = [&](const char* name) {
            return blocks_from(fields, name, level_folder(name, k), across, across);
        };
        levels.push_back({blocks(kHeightsFolder), blocks(kVerticesFolder)});
        const auto same_place = [](const BlockInfo& a, const BlockInfo& b) {
            return a.column == b.column && a.row == b.row;
        };
        if (!std::ranges::equal(levels.back().heights, levels.back().vertices, same_place))
            fields.wrong(kVerticesFolder, "are not of the blocks that heights are of");
    });
    if (static_cast<int>(levels.size()) < top) scene.wrong("levels", "are too few");
    return levels;
}

nlohmann::json to_json(const geo::GridFrame& frame) {
    return {{"kind", to_string(frame.kind)}, {"west", frame.west},     {"north", frame.north},
            {"step_x", frame.step_x},        {"step_y", frame.step_y}, {"step_unit", step_unit(frame.kind)},
            {"columns", frame.columns},      {"rows", frame.rows}};
}

template <class Enum>
Enum named(JsonFields& fields, const char* key, std::initializer_list<Enum> values) {
    const std::string name = fields.text(key);
    for (const Enum value : values) {
        if (name == to_string(value)) return value;
    }
    fields.wrong(key, "is unknown");
    return *values.begin();
}

/// A polar grid, which may reach beyond the equator (12 713 km from the pole in UPS) but not without end.
void read_polar_frame(JsonFields& fields, geo::GridFrame& frame) {
    constexpr double kFarthestM = 30e6;
    constexpr double kPole = geo::kUpsFalseOrigin;
    frame.west = fields.number("west", kPole - kFarthestM, kPole + kFarthestM);
    frame.north = fields.number("north", kPole - kFarthestM, kPole + kFarthestM);
    frame.step_x = fields.number("step_x", 1e-6, kFarthestM);
    frame.step_y = fields.number("step_y", 1e-6, kFarthestM);
    frame.columns = fields.integer("columns", 1, kMaxSide);
    frame.rows = fields.integer("rows", 1, kMaxSide);
    if (frame.west + (frame.columns - 1) * frame.step_x > kPole + kFarthestM)
        fields.wrong("step_x", "goes beyond what a polar grid can hold");
    if (frame.north - (frame.rows - 1) * frame.step_y < kPole - kFarthestM)
        fields.wrong("step_y", "goes beyond what a polar grid can hold");
}

geo::GridFrame frame_from(JsonFields fields) {
    geo::GridFrame frame;
    frame.kind = named(fields, "kind",
                       {geo::FrameKind::geographic, geo::FrameKind::ups_north, geo::FrameKind::ups_south});
    if (fields.text("step_unit") != step_unit(frame.kind)) fields.wrong("step_unit", "does not fit the kind");
    if (frame.is_polar()) {
        read_polar_frame(fields, frame);
        return frame;
    }
    frame.west = fields.number("west", -180, 180);
    frame.north = fields.number("north", -90 - 1e-9, 90 + 1e-9);
    frame.step_x = fields.number("step_x", 1e-9, 360);
    frame.step_y = fields.number("step_y", 1e-9, 180);
    frame.columns = fields.integer("columns", 1, kMaxSide);
    frame.rows = fields.integer("rows", 1, kMaxSide);
    // A row or column more than the earth holds is the closing one, at most.
    if ((frame.columns - 1) * frame.step_x > 360 + frame.step_x)
        fields.wrong("step_x", "goes round the earth twice");
    if (frame.north - (frame.rows - 1) * frame.step_y < -90 - frame.step_y) {
        fields.wrong("step_y", "goes beyond the south pole");
    }
    return frame;
}

ResamplingError resampling_from(JsonFields fields, std::string& method) {
    ResamplingError error;
    method = fields.text("method");
    error.rms_m = fields.number("rms_m", 0, kMaxHeight);
    error.max_m = fields.number("max_m", 0, kMaxHeight);
    error.posts = fields.count("posts");
    error.lost_posts = fields.count("lost_posts");
    return error;
}

/// Blocks that are not stored hold voids alone, so there cannot be more posts in them than there are voids.
bool voids_fit(const SceneInfo& info, const BlockGrid& grid) {
    std::uint64_t stored = 0;
    for (const BlockInfo& block : info.heights) {
        const BlockGrid::Box box = grid.box(block.column, block.row);
        stored += static_cast<std::uint64_t>(box.columns) * static_cast<std::uint64_t>(box.rows);
    }
    return stored >= info.valid_posts;
}

void read_statistics(JsonFields& fields, SceneInfo& info) {
    info.height_min_m = fields.number("height_min_m", -kMaxHeight, kMaxHeight);
    info.height_max_m = fields.number("height_max_m", info.height_min_m, kMaxHeight);
    const std::uint64_t posts =
        static_cast<std::uint64_t>(info.frame.columns) * static_cast<std::uint64_t>(info.frame.rows);
    info.valid_posts = fields.count("valid_posts", posts);
    info.void_posts = fields.count("void_posts", posts);
    if (info.valid_posts + info.void_posts != posts)
        fields.wrong("void_posts", "does not add up with valid_posts");
    info.sea_posts = fields.count("sea_posts", info.valid_posts);
    info.filled_posts = fields.count("filled_posts", info.valid_posts);
    info.modelled_posts = fields.count("modelled_posts", info.sea_posts);
    info.sea = sea_info_from(fields.object("sea"));
    info.outlier_posts = fields.count("outlier_posts", info.valid_posts);
    fields.each("outliers", [&](JsonFields& one) { info.outliers.push_back(outlier_from(one)); });
    fields.each("seams", [&](JsonFields& one) { info.seams.push_back(seam_from(one)); });
    info.bilinear_mesh_max_m = fields.number("bilinear_mesh_max_m", 0, 2 * kMaxHeight);
    info.resampling = resampling_from(fields.object("resampling"), info.resampling_method);
}

void read_files(JsonFields& fields, SceneInfo& info) {
    const BlockGrid heights = BlockGrid::of_heights(info.frame.columns, info.frame.rows);
    info.heights = blocks_from(fields, kHeightsFolder, kHeightsFolder, heights.across, heights.down);
    info.marks = blocks_from(fields, kMarksFolder, kMarksFolder, heights.across, heights.down);
    info.bounded_errors = fields.flag("bounded_errors");
    info.levels = levels_from(fields, info.frame);
    if (!fields.is_null("geoid")) info.geoid = geoid_from(fields.object("geoid"));
    if (!voids_fit(info, heights)) fields.wrong("heights", "lacks blocks that hold valid posts");
}

}  // namespace

std::uint64_t SceneInfo::bytes() const {
    std::uint64_t sum = geoid.file.bytes + bytes_of(heights) + bytes_of(marks);
    for (const LevelInfo& level : levels) sum += bytes_of(level.heights) + bytes_of(level.vertices);
    return sum;
}

std::uint64_t bytes_of(const std::vector<BlockInfo>& blocks) {
    return std::accumulate(blocks.begin(), blocks.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const BlockInfo& block) { return sum + block.bytes; });
}

const char* to_string(VerticalDatum datum) {
    switch (datum) {
        case VerticalDatum::egm96:
            return "egm96";
        case VerticalDatum::ellipsoid:
            return "ellipsoid";
        case VerticalDatum::other:
            break;
    }
    return "other";
}

const char* to_string(HeightType type) {
    return type == HeightType::int16 ? "int16" : "float32";
}

const char* to_string(geo::FrameKind kind) {
    switch (kind) {
        case geo::FrameKind::ups_north:
            return "ups_north";
        case geo::FrameKind::ups_south:
            return "ups_south";
        case geo::FrameKind::geographic:
            break;
    }
    return "geographic";
}

const char* step_unit(geo::FrameKind kind) {
    return kind == geo::FrameKind::geographic ? "degree" : "metre";
}

nlohmann::json to_json(const SceneInfo& info) {
    nlohmann::json sources = nlohmann::json::array();
    for (const SourceInfo& source : info.sources) sources.push_back(to_json(source));
    return {{"format_version", SceneInfo::kFormatVersion},
            {"frame", to_json(info.frame)},
            {"vertical_datum", to_string(info.vertical.datum)},
            {"vertical_name", info.vertical.name},
            {"vertical_assumed", info.vertical.assumed},
            {"geoid_known", info.vertical.geoid_known},
            {"height_type", to_string(info.height_type)},
            {"max_height_error_m", info.max_height_error_m},
            {"height_min_m", info.height_min_m},
            {"height_max_m", info.height_max_m},
            {"valid_posts", info.valid_posts},
            {"void_posts", info.void_posts},
            {"sea_posts", info.sea_posts},
            {"filled_posts", info.filled_posts},
            {"modelled_posts", info.modelled_posts},
            {"sea", to_json(info.sea)},
            {"outlier_posts", info.outlier_posts},
            {"outliers", list_to_json(info.outliers)},
            {"seams", list_to_json(info.seams)},
            {"bilinear_mesh_max_m", info.bilinear_mesh_max_m},
            {"resampling",
             {{"method", info.resampling_method},
              {"rms_m", info.resampling.rms_m},
              {"max_m", info.resampling.max_m},
              {"posts", info.resampling.posts},
              {"lost_posts", info.resampling.lost_posts}}},
            {"sources", std::move(sources)},
            {"notes", info.notes},
            {"block_side", SceneInfo::kBlockSide},
            {"heights", to_json(info.heights)},
            {"marks", to_json(info.marks)},
            {"bounded_errors", info.bounded_errors},
            {"levels", list_to_json(info.levels)},
            {"geoid", to_json(info.geoid)}};
}

Result<SceneInfo> scene_info_from_json(const nlohmann::json& json) {
    std::string problem;
    JsonFields fields(json, "", problem);
    const auto version = fields.count("format_version");
    if (problem.empty() && version > static_cast<std::uint64_t>(SceneInfo::kFormatVersion)) {
        return Error{
            ErrorKind::input,
            fmt::format("it has format version {}, and this Relevo reads up to {}: use a newer Relevo",
                        version, SceneInfo::kFormatVersion)};
    }
    if (problem.empty() && version > 0 && version < static_cast<std::uint64_t>(SceneInfo::kFormatVersion)) {
        return Error{
            ErrorKind::input,
            fmt::format("it has format version {}, of an older Relevo: import its sources again", version)};
    }
    if (version == 0) fields.wrong("format_version", "is unknown");

    SceneInfo info;
    info.frame = frame_from(fields.object("frame"));
    info.vertical.datum = named(fields, "vertical_datum",
                                {VerticalDatum::egm96, VerticalDatum::ellipsoid, VerticalDatum::other});
    info.vertical.name = fields.text("vertical_name");
    info.vertical.assumed = fields.flag("vertical_assumed");
    info.vertical.geoid_known = fields.flag("geoid_known");
    info.height_type = named(fields, "height_type", {HeightType::int16, HeightType::float32});
    info.max_height_error_m = fields.number("max_height_error_m", 0, kMaxHeight);
    fields.integer("block_side", SceneInfo::kBlockSide, SceneInfo::kBlockSide);
    if (problem.empty()) read_statistics(fields, info);
    fields.each("sources", [&](JsonFields& source) { info.sources.push_back(source_from(source)); });
    info.notes = fields.texts("notes");
    if (problem.empty()) read_files(fields, info);
    if (!problem.empty()) return Error{ErrorKind::damaged, problem};
    return info;
}

}  // namespace relevo::lod
