#include "output/scene_dataset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "output/post_box.hpp"
#include <proj.h>

#include "lod/scene/scene_files.hpp"

namespace relevo::output {
namespace {

constexpr int kSide = lod::SceneInfo::kBlockSide;

/// The vertical CRS of that name, as WKT; "" where PROJ knows none.
std::string vertical_wkt(const std::string& name) {
    const std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context(proj_context_create(),
                                                                               proj_context_destroy);
    proj_log_level(context.get(), PJ_LOG_NONE);
    const PJ_TYPE type = PJ_TYPE_VERTICAL_CRS;
    const std::unique_ptr<PJ_OBJ_LIST, decltype(&proj_list_destroy)> found(
        proj_create_from_name(context.get(), nullptr, name.c_str(), &type, 1, 0, 2, nullptr),
        proj_list_destroy);
    if (!found || proj_list_get_count(found.get()) != 1) return {};
    const std::unique_ptr<PJ, decltype(&proj_destroy)> crs(proj_list_get(context.get(), found.get(), 0),
                                                           proj_destroy);
    const char* const wkt = proj_as_wkt(context.get(), crs.get(), PJ_WKT2_2019, nullptr);
    return wkt == nullptr ? "" : wkt;
}

/// With the vertical datum, where PROJ knows one for it.
OGRSpatialReference crs_of(const lod::SceneInfo& info) {
    OGRSpatialReference horizontal;
    horizontal.importFromEPSG(lod::geo_reference(info.frame, 0, 0).epsg);
    OGRSpatialReference whole = horizontal;
    switch (info.vertical.datum) {
        case lod::VerticalDatum::ellipsoid:
            // GeoTIFF has no projected CRS with a third axis.
            if (info.frame.is_polar() || whole.PromoteTo3D(nullptr) != OGRERR_NONE) whole = horizontal;
            break;
        case lod::VerticalDatum::egm96:
        case lod::VerticalDatum::other: {
            OGRSpatialReference vertical;
            const bool egm96 = info.vertical.datum == lod::VerticalDatum::egm96;
            const std::string wkt = egm96 ? "" : vertical_wkt(info.vertical.name);
            const bool known = egm96 ? vertical.importFromEPSG(5773) == OGRERR_NONE
                                     : !wkt.empty() && vertical.importFromWkt(wkt.c_str()) == OGRERR_NONE;
            const std::string name =
                std::string(horizontal.GetName()) + " + " + (known ? vertical.GetName() : "");
            if (!known || whole.SetCompoundCS(name.c_str(), &horizontal, &vertical) != OGRERR_NONE)
                whole = horizontal;
            break;
        }
    }
    whole.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return whole;
}

}  // namespace

/// The heights of a SceneDataset.
class SceneBand : public GDALRasterBand {
  public:
    explicit SceneBand(SceneDataset& dataset, lod::HeightType type) : type_(type) {
        poDS = &dataset;
        nBand = 1;
        eDataType = type == lod::HeightType::int16 ? GDT_Int16 : GDT_Float32;
        nBlockXSize = nBlockYSize = kSide;
    }

    double GetNoDataValue(int* known) override {
        if (known != nullptr) *known = TRUE;
        return type_ == lod::HeightType::int16 ? lod::kVoidInt16 : std::numeric_limits<double>::quiet_NaN();
    }
    const char* GetUnitType() override { return "m"; }
    GDALColorInterp GetColorInterpretation() override { return GCI_GrayIndex; }

  protected:
    CPLErr IReadBlock(int block_column, int block_row, void* samples) override {
        return static_cast<SceneDataset*>(poDS)->read(block_column, block_row, samples);
    }

  private:
    lod::HeightType type_;
};

SceneDataset::SceneDataset(const lod::Scene& scene, const lod::BlockGrid::Box& box)
    : scene_(scene), box_(box), crs_(crs_of(scene.info())) {
    nRasterXSize = box.columns;
    nRasterYSize = box.rows;
    eAccess = GA_ReadOnly;
    SetBand(1, new SceneBand(*this, scene.info().height_type));
    SetMetadataItem("AREA_OR_POINT", "Point");
    SetMetadataItem("VERTICAL_DATUM", scene.info().vertical.name.c_str());
    SetMetadataItem("VERTICAL_DATUM_ASSUMED", scene.info().vertical.assumed ? "YES" : "NO");
    SetMetadataItem("SCENE", scene.path().filename().string().c_str());
}

CPLErr SceneDataset::GetGeoTransform(double* transform) {
    const auto where = lod::geo_reference(scene_.info().frame, box_.column, box_.row);
    const double values[6] = {
        where.west - where.step_x / 2, where.step_x, 0, where.north + where.step_y / 2, 0, -where.step_y};
    std::copy_n(values, 6, transform);
    return CE_None;
}

CPLErr SceneDataset::read(int block_column, int block_row, void* samples) {
    lod::BlockGrid::Box part{box_.column + block_column * kSide, box_.row + block_row * kSide, kSide, kSide};
    part.columns = std::min(kSide, box_.columns - block_column * kSide);
    part.rows = std::min(kSide, box_.rows - block_row * kSide);
    const auto heights = read_box(scene_, part);
    if (!heights) {
        if (!failure_) failure_ = heights.error();
        CPLError(CE_Failure, CPLE_FileIO, "%s", heights.error().message.c_str());
        return CE_Failure;
    }
    for (int row = 0; row < part.rows; ++row) {
        const float* H = heights->row(row);
        if (scene_.info().height_type == lod::HeightType::float32) {
            std::copy_n(H, part.columns,
                        static_cast<float*>(samples) + static_cast<std::ptrdiff_t>(row) * kSide);
        } else {
            std::transform(
                H, H + part.columns,
                static_cast<std::int16_t*>(samples) + static_cast<std::ptrdiff_t>(row) * kSide,
                [](float h) { return std::isnan(h) ? lod::kVoidInt16 : static_cast<std::int16_t>(h); });
        }
    }
    return CE_None;
}

}  // namespace relevo::output
