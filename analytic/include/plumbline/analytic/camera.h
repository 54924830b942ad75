#pragma once

namespace plumbline::analytic {

/// World-space vector [m] or direction. Analytic keeps a vector of its own: an oracle that shares
/// the renderer's arithmetic shares its mistakes.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

double dot(const Vec3& a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);

/// Unit vector along `a`; NaN for the zero vector.
Vec3 normalize(const Vec3& a);

/// Where a scene file's <lookat> and `fov` put the camera, in the words of that file.
struct View {
  Vec3 origin, target, up;
  double fov_x_degrees = 90;  ///< full angle along the horizontal axis, (0, 180)
};

/// Resolution of the film [pixels], both at least 1.
struct FilmSize {
  int width = 1, height = 1;
};

/// Pinhole camera in Mitsuba 3's convention: it looks along `forward`, `up` is the top of the image
/// and `left` its left edge.
///
/// Film coordinates are in pixels, (0, 0) the top left corner: pixel (i, j) is the square
/// [i, i+1] × [j, j+1]. The image plane is the plane at distance 1 in front of the pinhole.
struct Camera {
  Vec3 origin, left, up, forward;  ///< the last three orthonormal
  double tan_half_fov_x = 1;
  FilmSize film;

  /// Side of one pixel on the image plane.
  double pixel_pitch() const { return 2 * tan_half_fov_x / film.width; }

  /// Position on the image plane, to the left of the optical axis, of film coordinate `x`.
  double plane_left(double x) const { return tan_half_fov_x - x * pixel_pitch(); }

  /// Position on the image plane, above the optical axis, of film coordinate `y`.
  double plane_up(double y) const { return (0.5 * film.height - y) * pixel_pitch(); }

  /// Direction through film coordinates (x, y), not normalised: its `forward` component is 1.
  Vec3 direction(double x, double y) const {
    return forward + left * plane_left(x) + up * plane_up(y);
  }
};

/// The camera of a view on a film.
///
/// left = up × forward as in Mitsuba's `lookat`; pixels are square, so the vertical field of view
/// follows from the film's aspect.
/// @throws std::invalid_argument for a field of view outside (0°, 180°), an empty film, or an `up`
///         along the view direction
Camera make_camera(const View& view, FilmSize film);

}  // namespace plumbline::analytic
