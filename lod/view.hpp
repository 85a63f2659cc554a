#pragma once

#include <array>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "geo/position.hpp"

namespace relevo::lod {

/// A camera as people say it.
struct Camera {
    geo::Geodetic eye;
    geo::Degrees heading;  ///< clockwise from north
    geo::Degrees pitch;    ///< 0 at the horizon, -90 straight down
    geo::Degrees roll;     ///< positive: the head leans to the right, the horizon's right end goes up
    geo::Degrees fov{60};  ///< vertical, in (0, 180)
    int width = 1280;      ///< of the picture, pixels
    int height = 720;
};

/// A camera ready for arithmetic: everything is relative to the eye, in double, axes parallel to ECEF.
class View {
  public:
    explicit View(const Camera& camera);

    const Camera& camera() const { return camera_; }
    const geo::Ecef& eye() const { return eye_; }

    /// Rows: right, up, backward (OpenGL's eye space). Multiplies offsets from the eye in ECEF axes.
    const glm::dmat3& to_eye_space() const { return rotation_; }
    glm::dvec3 right() const;
    glm::dvec3 up() const;
    glm::dvec3 forward() const;

    /// Focal length in pixels: (height / 2) / tan(fov / 2).
    double focal_px() const { return focal_px_; }

    /// Projection for OpenGL with clip control (lower left, zero to one): reversed depth, near / z, infinite
    /// far plane.
    glm::mat4 projection() const;
    static constexpr double kNearM = 1e-3;

    /// Pixel coordinates of an offset from the eye: x to the right, y down, (0, 0) at the picture's upper
    /// left corner. \pre in front of the eye: depth(offset) > 0
    glm::dvec2 pixel(const glm::dvec3& offset) const;
    /// Distance along the view direction, metres.
    double depth(const glm::dvec3& offset) const;
    /// Is the offset inside the picture (and beyond the near plane)?
    bool sees(const glm::dvec3& offset) const;
    /// Unit direction of the ray through a pixel coordinate.
    glm::dvec3 ray(const glm::dvec2& pixel) const;

    /// Unit normals, pointing outward, of the four side planes of the picture's pyramid; they all go through
    /// the eye. A sphere at offset p of radius r is outside where dot(plane, p) > r for one of them. There is
    /// no near or far plane: reversed depth needs none.
    const std::array<glm::dvec3, 4>& side_planes() const { return side_planes_; }

    /// 1 / cos of the angle between the view direction and a corner of the picture.
    double corner_secant() const;

    /// What turns an object-space error into pixels (docs/design.md): of a point at a distance of D metres or
    /// more and one at most delta metres from it, where either is in the picture, the other appears at most
    /// lambda_px * delta / (D - kappa * delta) pixels away.
    struct ErrorScale {
        double lambda_px;
        double kappa;
    };
    ErrorScale error_scale() const;

  private:
    Camera camera_;
    geo::Ecef eye_;
    glm::dmat3 rotation_;
    double focal_px_;
    std::array<glm::dvec3, 4> side_planes_;
};

}  // namespace relevo::lod
