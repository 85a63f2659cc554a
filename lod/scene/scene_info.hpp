#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geo/frame.hpp"
#include "geo/result.hpp"
#include "lod/scene/sea_info.hpp"

namespace relevo::lod {

/// The surface that a scene's heights H are above.
enum class VerticalDatum {
    egm96,      ///< mean sea level, EGM96: h = H + N
    ellipsoid,  ///< WGS 84 ellipsoid: the stored height is h
    other,      ///< named in VerticalReference::name, no geoid here: h and N are unknown
};

struct VerticalReference {
    VerticalDatum datum = VerticalDatum::egm96;
    std::string name = "EGM96";  ///< for people
    bool assumed = true;         ///< the source did not say
    bool geoid_known = false;    ///< of another datum: the scene's geoid is its own, not EGM96
};

/// How heights are stored in the blocks.
enum class HeightType {
    int16,    ///< whole metres, void = kVoidInt16
    float32,  ///< void = NaN
};
inline constexpr std::int16_t kVoidInt16 = -32768;

/// One elevation file that went into a scene.
struct SourceInfo {
    std::string name;  ///< file name without its folder
    std::string sha256;
    std::string crs;      ///< "EPSG:32611", or the CRS's own name where it has no code
    std::string crs_wkt;  ///< the whole definition, WKT2
    int columns = 0;
    int rows = 0;
    double step_x = 0;  ///< post spacing along the source's own axes, in step_unit
    double step_y = 0;
    std::string step_unit;                       ///< "degree", "metre", ...
    std::string operation;                       ///< the coordinate operation to WGS 84 that was used
    std::optional<double> operation_accuracy_m;  ///< as stated by PROJ's database
    std::string operation_note;                  ///< a better operation that is not installed, else empty
    std::string notes;  ///< anything else that was assumed or converted (units, scale, float64), for people
};

/// Scene surface against every valid post of the sources: bilinear scene height minus source height, metres.
struct ResamplingError {
    double rms_m = 0;
    double max_m = 0;
    std::uint64_t posts = 0;       ///< source posts compared
    std::uint64_t lost_posts = 0;  ///< valid source posts where the scene has a void or nothing
};

/// Where two sources meet: posts of one beside posts of the other.
struct SeamInfo {
    int first = 0;  ///< indices in SceneInfo::sources, first < second
    int second = 0;
    std::uint64_t pairs = 0;  ///< of neighbouring posts across the seam
    double max_step_m = 0;    ///< largest difference of height in such a pair
    double rms_step_m = 0;
};

/// A post far from the median of the 5 x 5 posts around it.
struct OutlierInfo {
    int column = 0;
    int row = 0;
    double H_m = 0;
    double median_m = 0;
};

/// A data file of the scene: one block of one layer.
struct BlockInfo {
    int column = 0;  ///< of the block, in blocks
    int row = 0;
    std::string file;  ///< relative to the scene's folder
    std::string sha256;
    std::uint64_t bytes = 0;
};

/// The file of the geoid's nodes around the scene, on a grid of latitude and longitude.
struct GeoidInfo {
    BlockInfo file;    ///< of no name: heights are above the ellipsoid
    double south = 0;  ///< of the first node, degrees
    double west = 0;
    double step_lat = 0;
    double step_lon = 0;
    int rows = 0;
    int columns = 0;
};

/// A level of the scene's pyramid: the same blocks twice.
struct LevelInfo {
    std::vector<BlockInfo> heights;
    std::vector<BlockInfo> vertices;
};

/// On disk, of all of them.
std::uint64_t bytes_of(const std::vector<BlockInfo>& blocks);

/// What scene.json says.
struct SceneInfo {
    static constexpr int kFormatVersion = 3;
    static constexpr int kBlockSide = 512;  ///< posts a side of a block; blocks of heights do not overlap

    geo::GridFrame frame;
    VerticalReference vertical;
    HeightType height_type = HeightType::float32;
    double max_height_error_m = 0;  ///< by which storing heights with loss (LERC) may have changed them

    double height_min_m = 0;
    double height_max_m = 0;
    std::uint64_t valid_posts = 0;
    std::uint64_t void_posts = 0;
    std::uint64_t sea_posts = 0;       ///< of the valid ones; as are the next two
    std::uint64_t filled_posts = 0;    ///< interpolated over a void
    std::uint64_t modelled_posts = 0;  ///< of a sea bed that no source knows
    SeaInfo sea;                       ///< how it was decided which posts are sea
    std::uint64_t outlier_posts = 0;
    std::vector<OutlierInfo> outliers;  ///< the largest, at most kOutliersKept
    static constexpr std::size_t kOutliersKept = 20;
    std::vector<SeamInfo> seams;

    /// Largest difference between bilinear heights (measuring) and the triangles of the full mesh (drawing),
    /// metres.
    double bilinear_mesh_max_m = 0;
    ResamplingError resampling;
    std::string resampling_method;  ///< "none" (own posts kept), "cubic", "bilinear", "nearest", "average"

    std::vector<SourceInfo> sources;
    std::vector<std::string> notes;  ///< of several sources: what was assumed or converted, for people
    std::vector<BlockInfo> heights;
    std::vector<BlockInfo> marks;
    bool bounded_errors = true;     ///< else vertices have the incremental error alone
    std::vector<LevelInfo> levels;  ///< of the pyramid, from level 1 to the coarsest
    /// \pre it is from 1 to the coarsest
    const LevelInfo& level(int k) const { return levels.at(static_cast<std::size_t>(k) - 1); }
    GeoidInfo geoid;

    std::uint64_t bytes() const;  ///< of all data files
};

/// "egm96", "ellipsoid", "other": the key in JSON.
const char* to_string(VerticalDatum datum);
/// "int16", "float32".
const char* to_string(HeightType type);
/// "geographic", "ups_north", "ups_south".
const char* to_string(geo::FrameKind kind);
/// "degree" or "metre": the unit of the frame's steps.
const char* step_unit(geo::FrameKind kind);

nlohmann::json to_json(const SceneInfo& info);

/// Every number is checked: what comes back makes sense as a whole, its files lie inside the scene, and its
/// lists of blocks are in order of rows and columns. Fails with ErrorKind::damaged, or ErrorKind::input for a
/// newer format.
Result<SceneInfo> scene_info_from_json(const nlohmann::json& json);

}  // namespace relevo::lod
