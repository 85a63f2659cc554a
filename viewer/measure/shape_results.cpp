#include <algorithm>
#include <chrono>
#include <utility>

#include "viewer/measure/shape_result.hpp"

namespace relevo::viewer {

namespace {

/// Are they measured the same? Their names do not matter.
bool same(const Shape& a, const Shape& b) {
    const auto& p = a.measurement.vertices;
    const auto& q = b.measurement.vertices;
    return a.tool == b.tool && a.choices == b.choices && p.size() == q.size() &&
           std::equal(p.begin(), p.end(), q.begin(), [](const geo::LatLon& x, const geo::LatLon& y) {
               return x.lat == y.lat && x.lon == y.lon;
           });
}

bool any_same(const std::vector<Shape>& shapes, const Shape& as) {
    return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& shape) { return same(shape, as); });
}

}  // namespace

ShapeResults::~ShapeResults() {
    if (running_) running_->stop = true;  // its future waits until it has
}

const ShapeResult* ShapeResults::find(const Shape& shape) const {
    const auto found = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& known) { return same(known.shape, shape); });
    return found == known_.end() ? nullptr : &found->result;
}

std::optional<double> ShapeResults::progress(const Shape& shape) const {
    if (!running_ || !same(running_->shape, shape)) return std::nullopt;
    return running_->progress;
}

void ShapeResults::cancel() {
    if (running_) running_->cancelled = running_->stop = true;
}

void ShapeResults::forget(const Shape& shape) {
    std::erase_if(known_, [&](const Known& known) { return same(known.shape, shape); });
}

void ShapeResults::update(const std::vector<Shape>& shapes, geo::UnitSystem units) {
    if (running_ && running_->result.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        ShapeResult result = running_->result.get();
        if (running_->cancelled || !running_->stop)
            known_.push_back({std::move(running_->shape), running_->units, std::move(result)});
        running_.reset();
    }
    std::erase_if(known_,
                  [&](const Known& known) { return known.units != units || !any_same(shapes, known.shape); });
    if (running_) {
        if (running_->units != units || !any_same(shapes, running_->shape)) running_->stop = true;
        return;
    }
    for (const Shape& shape : shapes) {
        if (!is_measurable(shape) || find(shape) != nullptr) continue;
        running_ = std::make_unique<Running>();
        running_->shape = shape;
        running_->units = units;
        running_->result = std::async(std::launch::async, [this, at = running_.get()] {
            return measure_shape(sampler_, at->shape, at->units, [at](double done) {
                at->progress = done;
                return !at->stop;
            });
        });
        return;
    }
}

}  // namespace relevo::viewer
