#pragma once

#include <plumbline/renderer/core/math.h>
#include <plumbline/renderer/core/scene/ray.h>

namespace plumbline::renderer {

/// Pinhole camera as in Mitsuba 3: looks along +z of its own frame, +y up, +x to the *left* of the
/// image.
struct CameraDescription {
  Vec3d origin;
  Vec3d left, up, forward;    ///< unit, world space
  double tan_half_fov_x = 1;  ///< of the horizontal field of view
  int width = 256, height = 256;
};

/// Pinhole camera, all points of the film in focus.
class Camera {
 public:
  Camera() = default;

  /// @param scene_center  what the scene was moved by; the camera moves with it
  /// @param scale         what it was scaled by then
  Camera(const CameraDescription& description, const Vec3d& scene_center, double scale = 1)
      : width_(description.width),
        height_(description.height),
        origin_(vec_cast<float>((description.origin - scene_center) * scale)),
        forward_(vec_cast<float>(description.forward)) {
    const double tan_y = description.tan_half_fov_x * description.height / description.width;
    // Per pixel of film, so that the ray direction below is one multiply-add per axis.
    right_ =
        vec_cast<float>(description.left * (-2 * description.tan_half_fov_x / description.width));
    down_ = vec_cast<float>(description.up * (-2 * tan_y / description.height));
  }

  int width() const { return width_; }
  int height() const { return height_; }

  const Vec3f& origin() const { return origin_; }

  /// @param x, y  film position in pixels, (0, 0) the upper left corner of the image
  /// @return      unit
  Vec3f direction(float x, float y) const {
    const float from_center_x = x - 0.5f * static_cast<float>(width_);
    const float from_center_y = y - 0.5f * static_cast<float>(height_);
    return normalize(forward_ + right_ * from_center_x + down_ * from_center_y);
  }

  Ray ray(float x, float y) const { return {origin_, direction(x, y)}; }

  /// @param offset  in the pixel, [0, 1)²
  Ray ray(int pixel_x, int pixel_y, const Vec2f& offset) const {
    return ray(static_cast<float>(pixel_x) + offset.x, static_cast<float>(pixel_y) + offset.y);
  }

 private:
  int width_ = 0, height_ = 0;
  Vec3f origin_, forward_, right_, down_;
};

}  // namespace plumbline::renderer
