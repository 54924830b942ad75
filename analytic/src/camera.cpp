#include <plumbline/analytic/camera.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plumbline::analytic {

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vec3 normalize(const Vec3& a) { return a * (1 / std::hypot(a.x, a.y, a.z)); }

Camera make_camera(const View& view, FilmSize film) {
  if (!(view.fov_x_degrees > 0 && view.fov_x_degrees < 180)) {
    throw std::invalid_argument("the field of view must be between 0 and 180 degrees");
  }
  if (film.width < 1 || film.height < 1) throw std::invalid_argument("the film is empty");
  Camera camera;
  camera.origin = view.origin;
  camera.forward = normalize(view.target - view.origin);
  camera.left = normalize(cross(view.up, camera.forward));
  camera.up = cross(camera.forward, camera.left);
  camera.tan_half_fov_x = std::tan(view.fov_x_degrees * std::numbers::pi / 360);
  camera.film = film;
  // Also false for NaN, which a zero view direction or an `up` along it leaves behind.
  if (!(std::abs(dot(camera.up, camera.up) - 1) < 1e-9)) {
    throw std::invalid_argument("the camera's up vector lies along its view direction");
  }
  return camera;
}

}  // namespace plumbline::analytic
