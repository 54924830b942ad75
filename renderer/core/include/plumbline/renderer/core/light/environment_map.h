#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <plumbline/renderer/core/light/light_sample.h>
#include <plumbline/renderer/core/sampling/discrete.h>

namespace plumbline::renderer {

/// What all copies of an environment map share: its pixels and how they are chosen.
struct EnvironmentTable {
  /// @param pixels        row by row from the top: finite, ≥ 0; width and height at least 1
  /// @param compensation  see EnvironmentMap
  EnvironmentTable(int width, int height, std::vector<Rgbf> pixels, bool compensation);

  int width, height;
  std::vector<Rgbf> pixels;                   ///< [W/(m² sr)]
  DiscreteDistribution rows;                  ///< by luminance and solid angle
  std::vector<DiscreteDistribution> columns;  ///< of each row, by luminance
  double mean_luminance;                      ///< over the sphere
};

/// Light from infinitely far away, by a latitude–longitude image. Each pixel has one radiance, and
/// its directions are sampled uniformly in solid angle, so that density and radiance of a map are
/// in proportion everywhere, poles included.
///
/// Mitsuba 3's orientation: +y of the map's frame is up, at the top of the image; its left edge is
/// −z, a quarter to the right +x.
///
/// With MIS compensation pixels darker than the mean are left to the other techniques, and the rest
/// is sampled by what it has above the mean: fewer samples where a BSDF would find the light as
/// well. Light sampling alone then misses the dark pixels.
///
/// @source Karlík et al. 2019 (ACM TOG 38:6): MIS compensation of image-based lights
struct EnvironmentMap {
  std::shared_ptr<const EnvironmentTable> table;
  std::array<Vec3f, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< of the map, orthonormal
  float scale = 1;                                               ///< ≥ 0, of the radiance

  /// @return W/(m² sr) along the direction wi, away from the reference point
  template <class T>
  Rgb<T> radiance_along(const Vec3<T>& wi) const {
    const Pixel pixel = pixel_at(to_map(wi));
    return radiance_of<T>(pixel);
  }

  /// @param u  in [0, 1)²; the reference point does not matter
  template <class T>
  std::optional<LightSample<T>> sample(const Vec3<T>&, const Vec2<T>& u) const {
    const auto row = table->rows.sample(u.y);
    const auto column = table->columns[row.index].sample(u.x);
    const Pixel pixel{column.index, row.index};
    const SinCos<T> phi = sin_cos_turns(T((T(column.index) + column.u) / T(table->width)));
    // h = 1 − |cosθ| counts from the pole that the row is nearer to: near it the cosine has no
    // digits left, and sin²θ = h (2 − h) has.
    const bool south = 2 * row.index >= static_cast<std::uint32_t>(table->height);
    const T top = height_of<T>(row.index, south), bottom = height_of<T>(row.index + 1, south);
    const T h = top + row.u * (bottom - top);
    const T sin_theta = safe_sqrt(T(h * (T(2) - h)));
    const T cos_theta = south ? T(h - T(1)) : T(T(1) - h);
    const Vec3<T> wi = axis<T>(0) * T(sin_theta * phi.sin) + axis<T>(1) * cos_theta -
                       axis<T>(2) * T(sin_theta * phi.cos);
    return LightSample<T>{.wi = wi,
                          .distance = T(std::numeric_limits<float>::infinity()),
                          .cos_light = T(1),
                          .radiance = radiance_of<T>(pixel),
                          .pdf_w = row.pmf * column.pmf / solid_angle<T>(row.index)};
  }

  /// @return pdf_w [1/sr] of `sample(ref, u)`
  template <class T>
  T pdf(const Vec3<T>&, const Vec3<T>& wi) const {
    const Pixel pixel = pixel_at(to_map(wi));
    return table->rows.pmf<T>(pixel.row) * table->columns[pixel.row].template pmf<T>(pixel.column) /
           solid_angle<T>(pixel.row);
  }

 private:
  struct Pixel {
    std::uint32_t column, row;
  };

  template <class T>
  Vec3<T> axis(std::size_t i) const {
    return unit<T>(axes[i]);
  }

  template <class T>
  Vec3<T> to_map(const Vec3<T>& wi) const {
    return {dot(wi, axis<T>(0)), dot(wi, axis<T>(1)), dot(wi, axis<T>(2))};
  }

  template <class T>
  Pixel pixel_at(const Vec3<T>& w) const {
    using std::atan2, std::sqrt;
    const T turn = atan2(w.x, T(-w.z)) / (T(2) * pi<T>());
    const T theta = atan2(T(sqrt(sqr(w.x) + sqr(w.z))), w.y);
    const T x = (turn < T(0) ? T(turn + T(1)) : turn) * T(table->width);
    const T y = theta / pi<T>() * T(table->height);
    return {std::min(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(table->width) - 1),
            std::min(static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(table->height) - 1)};
  }

  template <class T>
  Rgb<T> radiance_of(const Pixel& pixel) const {
    const std::size_t index =
        std::size_t{pixel.row} * static_cast<std::size_t>(table->width) + pixel.column;
    return rgb_cast<T>(table->pixels[index] * scale);
  }

  /// 1 − |cosθ| = 2 sin²(θ/2) of the upper edge of a row, θ from the north or the south pole.
  template <class T>
  T height_of(std::uint32_t row, bool south) const {
    using std::sin;
    const auto rows = static_cast<std::uint32_t>(table->height);
    const T from_pole = T(south ? rows - row : row);
    return T(2) * sqr(T(sin(pi<T>() * from_pole / T(2 * rows))));
  }

  /// Of one pixel [sr]: 2π/width (cosθ_top − cosθ_bottom), the difference as a product.
  template <class T>
  T solid_angle(std::uint32_t row) const {
    using std::sin;
    const T rows = T(table->height);
    const T sin_middle = sin(T(pi<T>() * (T(row) + T(0.5)) / rows));
    return T(4) * pi<T>() / T(table->width) * sin_middle * sin(T(pi<T>() / (T(2) * rows)));
  }
};

}  // namespace plumbline::renderer
