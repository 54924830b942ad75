#include "floor_oracle.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

namespace plumbline::analytic {
namespace {

using Function = std::function<Colour(double, double)>;

Colour magnitude(const Colour& c) {
  return by_channel([](double x) { return std::abs(x); }, c);
}

/// ∫ f from a to b by Gauss and Legendre's rule of N points, an even number.
template <unsigned N, class F>
Colour line_rule(const F& f, double a, double b) {
  static_assert(N % 2 == 0, "an odd rule has a point in the middle");
  using Rule = boost::math::quadrature::gauss<double, N>;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  Colour sum;
  for (std::size_t i = 0; i < N / 2; ++i) {
    const double offset = half * Rule::abscissa()[i];
    sum = sum + (f(middle - offset) + f(middle + offset)) * Rule::weights()[i];
  }
  return sum * half;
}

/// ∫∫ f over the box by a product rule of N × N points.
template <unsigned N>
Colour product_rule(const Function& f, const FilmBox& box) {
  return line_rule<N>(
      [&](double y) { return line_rule<N>([&](double x) { return f(x, y); }, box.x0, box.x1); },
      box.y0, box.y1);
}

Average refine(const Function& f, const FilmBox& box, const Colour& tolerance, int levels) {
  const Colour fine = product_rule<8>(f, box);
  const Colour error = magnitude(fine - product_rule<6>(f, box));
  const bool precise =
      in_every_channel([](double e, double most) { return e <= most; }, error, tolerance);
  if (precise || levels == 0) return {fine, error};
  const double x = 0.5 * (box.x0 + box.x1);
  const double y = 0.5 * (box.y0 + box.y1);
  const std::array<FilmBox, 4> quarters{{{box.x0, box.y0, x, y},
                                         {x, box.y0, box.x1, y},
                                         {box.x0, y, x, box.y1},
                                         {x, y, box.x1, box.y1}}};
  Average sum;
  for (const FilmBox& quarter : quarters) {
    const Average part = refine(f, quarter, tolerance / 4, levels - 1);
    sum.value = sum.value + part.value;
    sum.error = sum.error + part.error;
  }
  return sum;
}

class FloorOracle final : public PixelOracle {
 public:
  FloorOracle(const Camera& camera, Outgoing outgoing, const FloorPrecision& precision)
      : PixelOracle(camera.film),
        camera_(camera),
        outgoing_(std::move(outgoing)),
        precision_(precision) {}

  Average box_mean(const FilmBox& box) const override {
    Average mean = box_quadrature(
        [this](double x, double y) {
          const Vec3 w = camera_.direction(x, y);
          return outgoing_(floor_point(w), normalize(w) * -1);
        },
        box, precision_.quadrature, precision_.levels);
    mean.error = mean.error + precision_.outgoing * magnitude(mean.value);
    return mean;
  }

  /// NaN or behind the camera where the ray does not go down.
  Vec3 floor_point(const Vec3& w) const { return camera_.origin + w * (-camera_.origin.z / w.z); }

 private:
  Camera camera_;
  Outgoing outgoing_;
  FloorPrecision precision_;
};

class UniformOracle final : public PixelOracle {
 public:
  UniformOracle(FilmSize film, const Colour& radiance) : PixelOracle(film), radiance_(radiance) {}

  Average box_mean(const FilmBox&) const override { return {radiance_, 1e-15 * radiance_}; }

 private:
  Colour radiance_;
};

}  // namespace

Average box_quadrature(const Function& f, const FilmBox& box, double relative, int levels) {
  const Colour first = product_rule<6>(f, box);
  const double area = (box.x1 - box.x0) * (box.y1 - box.y0);
  const Average sum = refine(f, box, relative * magnitude(first), levels);
  return {sum.value / area, sum.error / area};
}

std::unique_ptr<PixelOracle> floor_oracle(const Camera& camera, double half_side, Outgoing outgoing,
                                          FloorPrecision precision) {
  auto oracle = std::make_unique<FloorOracle>(camera, std::move(outgoing), precision);
  const double w = camera.film.width;
  const double h = camera.film.height;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {w, 0.0}, {0.0, h}, {w, h}}) {
    const Vec3 direction = camera.direction(x, y);
    require(direction.z < 0, "the film sees past the floor's horizon");
    const Vec3 p = oracle->floor_point(direction);
    require(std::abs(p.x) <= half_side && std::abs(p.y) <= half_side,
            "the film is so narrow that it sees past the floor's edge");
  }
  return oracle;
}

std::unique_ptr<PixelOracle> uniform_oracle(FilmSize film, const Colour& radiance) {
  return std::make_unique<UniformOracle>(film, radiance);
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

}  // namespace plumbline::analytic
