#include "hard_points.h"

#include <array>
#include <cmath>
#include <numbers>

namespace plumbline::tests {

using namespace renderer;

namespace {

double random_azimuth(verify::Random& random) { return 2 * std::numbers::pi * random.uniform(); }

Vec3f unit(const Vec3d& v) { return vec_cast<float>(normalize(v)); }

/// Moved to the side by a random amount between 1e-7 and 1, every size as likely.
Vec3f nudged(const Vec3f& w, verify::Random& random) {
  const double size = std::pow(10.0, -7 * random.uniform());
  const Vec3d step = square_to_uniform_sphere(Vec2<double>{random.uniform(), random.uniform()});
  return unit(vec_cast<double>(w) + step * size);
}

/// Snell's direction, or the mirror's where there is none.
Vec3f refracted(const Vec3f& wo, double eta) {
  const Vec3d w = vec_cast<double>(wo);
  const double square = 1 - (w.x * w.x + w.y * w.y) / (eta * eta);
  if (!(square > 0)) return mirror(wo);
  return unit({-w.x / eta, -w.y / eta, w.z > 0 ? -std::sqrt(square) : std::sqrt(square)});
}

float hard_number(verify::Random& random) {
  const float near = static_cast<float>(random.uniform()) * 1e-6f;
  switch (random.bits() % 6) {
    case 0:
      return 0;
    case 1:
      return 1 - 0x1p-24f;
    case 2:
      return near;
    case 3:
      return std::min(1 - near, 1 - 0x1p-24f);
    default:
      return random.uniform_float();
  }
}

}  // namespace

Vec3f direction(double cosine, double azimuth) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  return vec_cast<float>(Vec3d{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
}

std::vector<Vec3f> hard_outgoing(verify::Random& random) {
  std::vector<double> cosines{1, 1 - 1e-7, 0.95, 0.7, 0.3, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
  for (const double eta : {1.01, 1.33, 1.38, 1.5, 2.5}) {
    const double critical = std::sqrt(1 - 1 / (eta * eta));
    for (const double shift : {-1e-7, 0.0, 1e-7}) cosines.push_back(critical + shift);
  }
  std::vector<Vec3f> directions;
  for (const double cosine : cosines) {
    for (const double side : {1.0, -1.0}) {
      directions.push_back(direction(side * cosine, random_azimuth(random)));
    }
  }
  for (const double azimuth : {0.0, std::numbers::pi / 2}) {
    directions.push_back(direction(0.5, azimuth));
    directions.push_back(direction(1e-5, azimuth));
  }
  return directions;
}

std::vector<Vec3f> hard_incoming(const BsdfRef& bsdf, const Vec3f& wo, std::size_t count,
                                 verify::Random& random) {
  std::vector<Vec3f> directions;
  while (directions.size() < count) {
    switch (directions.size() % 8) {
      case 0:
      case 1:
      case 2: {
        const auto sample = bsdf.sample(wo, hard_numbers(1, random).front());
        directions.push_back(sample ? sample->wi : nudged(mirror(wo), random));
        break;
      }
      case 3:
        directions.push_back(nudged(mirror(wo), random));
        break;
      case 4:
        directions.push_back(nudged(-wo, random));
        break;
      case 5: {
        constexpr std::array kIndices{1.5, 1 / 1.5, 2.5, 0.4, 1.01, 1 / 1.01};
        directions.push_back(nudged(refracted(wo, kIndices[random.bits() % 6]), random));
        break;
      }
      case 6:
        directions.push_back(
            direction((random.uniform() < 0.5 ? 1e-6 : -1e-6) * (1 + random.uniform()),
                      random_azimuth(random)));
        break;
      default:
        directions.push_back(direction(2 * random.uniform() - 1, random_azimuth(random)));
    }
  }
  return directions;
}

std::vector<Vec2f> hard_numbers(std::size_t count, verify::Random& random) {
  std::vector<Vec2f> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = hard_number(random);
    numbers.push_back({x, hard_number(random)});
  }
  return numbers;
}

}  // namespace plumbline::tests
