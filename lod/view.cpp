#include "lod/view.hpp"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relevo::lod {

namespace {

glm::dmat3 eye_space_rows(const Camera& camera) {
    const geo::EnuFrame local(camera.eye);
    const double heading = camera.heading.radians();
    const double pitch = camera.pitch.radians();
    const double roll = camera.roll.radians();

    const glm::dvec3 ahead = std::sin(heading) * local.east() + std::cos(heading) * local.north();
    const glm::dvec3 level_right = std::cos(heading) * local.east() - std::sin(heading) * local.north();
    const glm::dvec3 forward = std::cos(pitch) * ahead + std::sin(pitch) * local.up();
    const glm::dvec3 level_up = std::cos(pitch) * local.up() - std::sin(pitch) * ahead;
    const glm::dvec3 right = std::cos(roll) * level_right - std::sin(roll) * level_up;
    const glm::dvec3 up = std::cos(roll) * level_up + std::sin(roll) * level_right;
    return glm::transpose(glm::dmat3(right, up, -forward));
}

}  // namespace

View::View(const Camera& camera)
    : camera_(camera),
      eye_(geo::to_ecef(camera.eye)),
      rotation_(eye_space_rows(camera)),
      focal_px_(0.5 * camera.height / std::tan(0.5 * camera.fov.radians())) {
    assert(camera.width > 0 && camera.height > 0);
    assert(camera.fov.value > 0 && camera.fov.value < 180);
    const double tan_x = 0.5 * camera.width / focal_px_;
    const double tan_y = 0.5 * camera.height / focal_px_;
    side_planes_ = {glm::normalize(-right() - tan_x * forward()), glm::normalize(right() - tan_x * forward()),
                    glm::normalize(-up() - tan_y * forward()), glm::normalize(up() - tan_y * forward())};
}

glm::dvec3 View::right() const {
    return glm::transpose(rotation_)[0];
}
glm::dvec3 View::up() const {
    return glm::transpose(rotation_)[1];
}
glm::dvec3 View::forward() const {
    return -glm::transpose(rotation_)[2];
}

glm::mat4 View::projection() const {
    const double scale = 2 * focal_px_;
    glm::mat4 projection(0);
    projection[0][0] = static_cast<float>(scale / camera_.width);
    projection[1][1] = static_cast<float>(scale / camera_.height);
    projection[2][3] = -1;  // w = distance along the view direction
    projection[3][2] = static_cast<float>(kNearM);
    return projection;
}

glm::dvec2 View::pixel(const glm::dvec3& offset) const {
    const glm::dvec3 in_eye_space = rotation_ * offset;
    assert(in_eye_space.z < 0);
    return {0.5 * camera_.width - focal_px_ * in_eye_space.x / in_eye_space.z,
            0.5 * camera_.height + focal_px_ * in_eye_space.y / in_eye_space.z};
}

double View::depth(const glm::dvec3& offset) const {
    return -(rotation_ * offset).z;
}

bool View::sees(const glm::dvec3& offset) const {
    for (const glm::dvec3& plane : side_planes_) {
        if (glm::dot(plane, offset) > 0) return false;
    }
    return depth(offset) >= kNearM;
}

glm::dvec3 View::ray(const glm::dvec2& pixel) const {
    const glm::dvec3 in_eye_space((pixel.x - 0.5 * camera_.width) / focal_px_,
                                  (0.5 * camera_.height - pixel.y) / focal_px_, -1);
    return glm::normalize(glm::transpose(rotation_) * in_eye_space);
}

double View::corner_secant() const {
    const double tan_x = 0.5 * camera_.width / focal_px_;
    const double tan_y = 0.5 * camera_.height / focal_px_;
    return std::sqrt(1 + tan_x * tan_x + tan_y * tan_y);
}

View::ErrorScale View::error_scale() const {
    const double secant = corner_secant();
    return {focal_px_ * secant * secant, 1 + secant};
}

}  // namespace relevo::lod
