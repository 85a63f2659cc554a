#include "ingest/posts/survey.hpp"

#include <algorithm>
#include <cmath>

namespace relevo::ingest {

Survey::Survey(const lod::Posts& posts, Window inside) {
    const lod::Raster<float>& H = posts.heights;
    const lod::Raster<lod::PostMark>& marks = posts.marks;
    for (int row = inside.row; row < inside.row + inside.rows; ++row) {
        const bool has_south = row + 1 < H.rows();
        for (int column = inside.column; column < inside.column + inside.columns; ++column) {
            const float here = H.at(column, row);
            const lod::PostMark mark = marks.at(column, row);
            count(here, mark);
            const bool has_east = column + 1 < H.columns();
            if (has_east) compare(here, mark, H.at(column + 1, row), marks.at(column + 1, row));
            if (has_south) compare(here, mark, H.at(column, row + 1), marks.at(column, row + 1));
            if (!has_east || !has_south) continue;
            const double twist = static_cast<double>(here) + static_cast<double>(H.at(column + 1, row + 1)) -
                                 static_cast<double>(H.at(column + 1, row)) -
                                 static_cast<double>(H.at(column, row + 1));
            if (std::abs(twist) > twist_) twist_ = std::abs(twist);  // false for NaN
        }
    }
}

void Survey::count(float height, lod::PostMark mark) {
    if (mark.is_void()) {
        ++void_;
        return;
    }
    ++valid_;
    if (mark.post_class() == lod::PostClass::sea) ++sea_;
    if (mark.filled()) ++filled_;
    if (mark.modelled()) ++modelled_;
    lowest_ = std::min(lowest_, height);
    highest_ = std::max(highest_, height);
}

void Survey::compare(float one, lod::PostMark of_one, float other, lod::PostMark of_other) {
    if (of_one.source() == of_other.source() || of_one.is_void() || of_other.is_void()) return;
    if (of_one.modelled() || of_other.modelled()) return;  // no source's height
    Seam& seam = seams_[std::minmax(of_one.source(), of_other.source())];
    const double step = std::abs(static_cast<double>(one) - static_cast<double>(other));
    ++seam.pairs;
    seam.max_m = std::max(seam.max_m, step);
    seam.sum2_m2 += step * step;
}

void Survey::join(const Survey& next) {
    valid_ += next.valid_;
    void_ += next.void_;
    sea_ += next.sea_;
    filled_ += next.filled_;
    modelled_ += next.modelled_;
    lowest_ = std::min(lowest_, next.lowest_);
    highest_ = std::max(highest_, next.highest_);
    twist_ = std::max(twist_, next.twist_);
    for (const auto& [sources, part] : next.seams_) {
        Seam& seam = seams_[sources];
        seam.pairs += part.pairs;
        seam.max_m = std::max(seam.max_m, part.max_m);
        seam.sum2_m2 += part.sum2_m2;
    }
}

void Survey::put_into(lod::SceneInfo& info) const {
    info.valid_posts = valid_;
    info.void_posts = void_;
    info.sea_posts = sea_;
    info.filled_posts = filled_;
    info.modelled_posts = modelled_;
    info.height_min_m = valid_ > 0 ? static_cast<double>(lowest_) : 0;
    info.height_max_m = valid_ > 0 ? static_cast<double>(highest_) : 0;
    info.bilinear_mesh_max_m = twist_ / 4;
    info.seams.clear();
    for (const auto& [sources, seam] : seams_) {
        info.seams.push_back({sources.first, sources.second, seam.pairs, seam.max_m,
                              std::sqrt(seam.sum2_m2 / static_cast<double>(seam.pairs))});
    }
}

bool fits_int16(const lod::Raster<float>& heights) {
    return std::all_of(heights.samples().begin(), heights.samples().end(), [](float height) {
        return std::isnan(height) || (height > static_cast<float>(lod::kVoidInt16) && height <= 32767.0F);
    });
}

}  // namespace relevo::ingest
