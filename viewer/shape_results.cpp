#include <algorithm>
#include <chrono>
#include <utility>

#include "viewer/shape_result.hpp"

namespace relevo::viewer {

ShapeResults::~ShapeResults() {
    if (running_.valid()) running_.wait();
}

namespace {

bool same(const Shape& a, const Shape& b) {
    const auto& p = a.measurement.vertices;
    const auto& q = b.measurement.vertices;
    return a.tool == b.tool && p.size() == q.size() &&
           std::equal(p.begin(), p.end(), q.begin(), [](const geo::LatLon& x, const geo::LatLon& y) {
               return x.lat == y.lat && x.lon == y.lon;
           });
}

}  // namespace

const ShapeResult* ShapeResults::find(const Shape& shape) const {
    const auto found = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& known) { return same(known.shape, shape); });
    return found == known_.end() ? nullptr : &found->result;
}

void ShapeResults::update(const std::vector<Shape>& shapes, geo::UnitSystem units) {
    if (running_.valid() && running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        known_.push_back(running_.get());
    std::erase_if(known_, [&](const Known& known) {
        return known.units != units || std::none_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
                   return same(known.shape, shape);
               });
    });
    if (running_.valid()) return;
    for (const Shape& shape : shapes) {
        if (!is_measurable(shape) || find(shape) != nullptr) continue;
        running_ = std::async(std::launch::async, [this, shape, units] {
            return Known{shape, units, measure_shape(sampler_, shape, units)};
        });
        return;
    }
}

}  // namespace relevo::viewer
