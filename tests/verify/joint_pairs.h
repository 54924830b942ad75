#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <plumbline/verify/joint.h>

/// Samplers of several things at once, each right, and wrong in a stated way.
namespace plumbline::verify::joint_pairs {

using std::numbers::pi;

template <class T>
using Four = std::array<T, 4>;

template <class T>
struct Plane {
  T x, y;
};

template <class T>
struct Direction {
  T x, y, z;
};

template <class T>
Direction<T> direction_of(T cosine, T azimuth) {
  const T sine = std::sqrt(std::max(T(0), 1 - cosine * cosine));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

template <class T>
Plane<T> on_disk(T radius, T u, T v) {
  const T r = radius * std::sqrt(u), phi = T(2 * pi) * v;
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// A cosine to the n-th around z.
template <class T>
Direction<T> power_lobe(T n, T u, T v) {
  return direction_of(std::pow(u, 1 / (n + 1)), T(2 * pi) * v);
}

template <class T>
T power_density(T n, T cosine) {
  return cosine > 0 ? (n + 1) / T(2 * pi) * std::pow(cosine, n) : T(0);
}

/// What is wrong with a twin.
enum class Fault {
  none,
  jacobian,     ///< a factor of a change of measure is forgotten
  area,         ///< divided by the wrong area
  independent,  ///< the product of the marginals
  reused,       ///< one number is used twice
  support,      ///< pdf is 0 in a part of what is sampled
  record        ///< the record states another density
};

/// A ray of a camera: a point of the lens, uniform, and the direction from there to the point in
/// focus of a direction that is drawn with cos⁴ from the lens' middle.
///
/// The density of directions from the middle is 5/2π cos⁴θ₀; on the plane in focus it is cos³θ₀/f²
/// of that per area, and f²/cos³θ of that per steradian from the point of the lens.
template <class T = double>
JointPair thin_lens(Fault fault = Fault::none, T radius = T(0.4)) {
  const auto area = static_cast<T>(pi) * radius * radius;
  return joint_pair<4, Plane<T>, Direction<T>>(
      "thin lens", JointDomain({Domain::disk(radius), Domain::hemisphere()}),
      [=](const Four<T>& u) {
        const Plane<T> lens = on_disk(radius, u[0], u[1]);
        const Direction<T> from_middle =
            power_lobe(T(4), 1 - u[2], u[fault == Fault::reused ? 1 : 3]);
        const T x = from_middle.x / from_middle.z - lens.x,
                y = from_middle.y / from_middle.z - lens.y;
        const T scale = 1 / std::sqrt(x * x + y * y + 1);
        return std::tuple(lens, Direction<T>{x * scale, y * scale, scale});
      },
      [=](const Plane<T>& lens, const Direction<T>& w) {
        if (!(w.z > 0) || lens.x * lens.x + lens.y * lens.y > radius * radius) return T(0);
        const T x = lens.x * w.z + w.x, y = lens.y * w.z + w.y;
        T cosine = w.z / std::sqrt(x * x + y * y + w.z * w.z);
        if (fault == Fault::independent) cosine = w.z;
        const T ratio = fault == Fault::jacobian ? T(1) : cosine / w.z;
        const T outside = fault == Fault::support && w.z < T(0.3) ? T(0) : T(1);
        const T wrong = fault == Fault::area ? T(1.01) : T(1);
        return outside * power_density(T(4), cosine) * ratio * ratio * ratio / (wrong * area);
      });
}

/// The same with a stop: what is in focus is uniform in a square.
inline JointPair square_field(double half = 0.5, Fault fault = Fault::none) {
  constexpr double kRadius = 0.2;
  return joint_pair<4, Plane<double>, Direction<double>>(
      "square field", JointDomain({Domain::disk(kRadius), Domain::hemisphere()}),
      [=](const Four<double>& u) {
        const Plane<double> lens = on_disk(kRadius, u[0], u[1]);
        const double x = half * (2 * u[2] - 1) - lens.x, y = half * (2 * u[3] - 1) - lens.y;
        const double scale = 1 / std::sqrt(x * x + y * y + 1);
        return std::tuple(lens, Direction<double>{x * scale, y * scale, scale});
      },
      [=](const Plane<double>& lens, const Direction<double>& w) {
        if (!(w.z > 0)) return 0.0;
        const double x = lens.x + w.x / w.z, y = lens.y + w.y / w.z;
        if (std::abs(x) > half || std::abs(y) > half) return 0.0;
        const double powers = fault == Fault::jacobian ? w.z * w.z : w.z * w.z * w.z;
        return 1 / (powers * 4 * half * half * pi * kRadius * kRadius);
      });
}

/// A ray that leaves a disk: the lobe gets narrower towards the edge.
template <class T = double>
JointPair emitted_ray(Fault fault = Fault::none) {
  constexpr T kRadius = T(2);
  const auto exponent = [](const Plane<T>& p) { return 1 + (p.x * p.x + p.y * p.y); };
  JointPair pair{"emitted ray", JointDomain({Domain::disk(kRadius), Domain::hemisphere()})};
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  const auto density = [=](const Plane<T>& p, const Direction<T>& w) {
    if (p.x * p.x + p.y * p.y > kRadius * kRadius * T(1 + 1e-6)) return T(0);
    const T n = fault == Fault::independent ? T(3) : exponent(p);
    const T area = T(pi) * kRadius * (fault == Fault::area ? T(1) : kRadius);
    return power_density(n, w.z) / area;
  };
  pair.sample = [=](const JointUniforms& u) -> std::optional<JointRecord> {
    const Plane<T> p = on_disk(kRadius, static_cast<T>(u[0]), static_cast<T>(u[1]));
    const auto w = power_lobe(exponent(p), static_cast<T>(1 - u[fault == Fault::reused ? 1 : 2]),
                              static_cast<T>(u[3]));
    JointRecord record;
    record.x = {to_point(p), to_point(w)};
    const T stated = density(p, w);
    record.pdf = fault == Fault::record ? stated * T(1.001) : stated;
    if (stated > 0) record.weight = {1, {static_cast<double>(w.z / stated)}};
    return record;
  };
  pair.pdf = [=](const JointPoint& x) {
    return static_cast<double>(density(from_point<Plane<T>>(x[0]), from_point<Direction<T>>(x[1])));
  };
  pair.value = [](const JointPoint& x) {
    return Channels{1, {x[1][2] > 0 ? static_cast<double>(static_cast<T>(x[1][2])) : 0}};
  };
  return pair;
}

/// Uniform, or the product of tents around ½, in up to four dimensions.
inline JointPair box(std::size_t dimension, bool tent, Fault fault = Fault::none) {
  JointPair pair{tent ? "tents" : "uniform box",
                 JointDomain::box(std::vector<Interval>(dimension, Interval{0, tent ? 1.0 : 2.0}))};
  pair.name += ", " + std::to_string(dimension) + " dimensions";
  pair.numbers = static_cast<int>(dimension);
  pair.sample = [=](const JointUniforms& u) -> std::optional<JointRecord> {
    JointRecord record;
    for (std::size_t d = 0; d < dimension; ++d) {
      const double v = fault == Fault::reused && d + 1 == dimension ? u[0] : u[d];
      const double t = v < 0.5 ? std::sqrt(v / 2) : 1 - std::sqrt((1 - v) / 2);
      record.x[d][0] = tent ? t : 2 * v;
    }
    return record;
  };
  pair.pdf = [=](const JointPoint& x) {
    double product = fault == Fault::area ? 1.01 : 1;
    for (std::size_t d = 0; d < dimension; ++d) {
      const double t = x[d][0];
      if (!(t >= 0 && t <= (tent ? 1 : 2))) return 0.0;
      product *= tent ? 4 * std::min(t, 1 - t) : 0.5;
    }
    if (fault == Fault::support && x[0][0] + x[1][0] < 0.3) return 0.0;
    return product;
  };
  return pair;
}

/// Wavelength [nm] × direction: the lobe of a diffuser is wider towards the red.
template <class T = double>
JointPair dispersive_lobe(Fault fault = Fault::none) {
  const auto exponent = [](T wavelength) { return T(2) + T(30) * (780 - wavelength) / 400; };
  return joint_pair<3, T, Direction<T>>(
      "dispersive lobe", JointDomain({Domain::interval(380, 780), Domain::hemisphere()}),
      [=](const std::array<T, 3>& u) {
        // Density 2 (λ − 380)/400² of wavelengths.
        const T wavelength = 380 + 400 * std::sqrt(u[0]);
        return std::tuple(wavelength, power_lobe(exponent(wavelength), 1 - u[1],
                                                 u[fault == Fault::reused ? 1 : 2]));
      },
      [=](T wavelength, const Direction<T>& w) {
        const T n = fault == Fault::independent ? T(12) : exponent(wavelength);
        const T of_wavelength =
            fault == Fault::jacobian ? T(1) / 400 : 2 * (wavelength - 380) / (T(400) * T(400));
        return std::max(T(0), of_wavelength) * power_density(n, w.z);
      });
}

/// Free flight × the direction after it, by Henyey and Greenstein, whose g falls with the distance.
inline JointPair flight_and_phase(Fault fault = Fault::none) {
  constexpr double kSigma = 0.7;
  const auto g_at = [](double t) { return 0.7 * std::exp(-0.5 * t) + 0.05; };
  const double sigma_of_pdf = fault == Fault::area ? 0.71 : kSigma;
  return joint_pair<3, double, Direction<double>>(
      "flight and phase", JointDomain({Domain::half_line(1), Domain::sphere()}),
      [=](const std::array<double, 3>& u) {
        const double t = -std::log1p(-u[0]) / kSigma, g = g_at(t);
        const double root = (1 - g * g) / (1 + g - 2 * g * u[1]);
        return std::tuple(t, direction_of((1 + g * g - root * root) / (2 * g), 2 * pi * u[2]));
      },
      [=](double t, const Direction<double>& w) {
        if (t < 0) return 0.0;
        const double g = fault == Fault::independent ? 0.45 : g_at(t);
        const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * w.z, 1.5));
        return sigma_of_pdf * std::exp(-sigma_of_pdf * t) * phase;
      });
}

/// Where light leaves a translucent slab and whither: an exponential profile of the radius, cut off
/// at the disk's edge, × a cosine.
inline JointPair subsurface(Fault fault = Fault::none) {
  constexpr double kRadius = 3, kFalloff = 1.5;
  const double kept = -std::expm1(-kFalloff * kRadius);
  return joint_pair<4, Plane<double>, Direction<double>>(
      "subsurface", JointDomain({Domain::disk(kRadius), Domain::hemisphere()}),
      [=](const Four<double>& u) {
        const double r = -std::log1p((u[0] - 1) * kept) / kFalloff, phi = 2 * pi * u[1];
        return std::tuple(Plane<double>{r * std::cos(phi), r * std::sin(phi)},
                          power_lobe(1.0, 1 - u[2], u[3]));
      },
      [=](const Plane<double>& p, const Direction<double>& w) {
        const double r = std::hypot(p.x, p.y);
        if (r > kRadius) return 0.0;
        const double of_radius = kFalloff * std::exp(-kFalloff * r) / kept;
        // Per area: over 2π r.
        return of_radius / (2 * pi * (fault == Fault::jacobian ? 1 : r)) * power_density(1.0, w.z);
      });
}

/// Two points of a plane, the second around the first: a ridge through four dimensions.
inline JointPair ridge(double width, Fault fault = Fault::none) {
  JointPair pair{"ridge", JointDomain({Domain::unit_square(), Domain::line(0.5, 0.5),
                                       Domain::line(0.5, 0.5)})};
  pair.sample = [=](const JointUniforms& u) -> std::optional<JointRecord> {
    const double r = width * std::sqrt(-2 * std::log1p(-u[2])), phi = 2 * pi * u[3];
    JointRecord record;
    record.x[0] = {u[0], u[1], 0};
    record.x[1][0] = u[0] + r * std::cos(phi);
    record.x[2][0] = u[1] + r * std::sin(phi);
    return record;
  };
  pair.pdf = [=](const JointPoint& x) {
    const double a = (x[1][0] - x[0][fault == Fault::independent ? 1 : 0]) / width,
                 b = (x[2][0] - x[0][fault == Fault::independent ? 0 : 1]) / width;
    return std::exp(-(a * a + b * b) / 2) / (2 * pi * width * width) *
           (fault == Fault::area ? 1.02 : 1);
  };
  return pair;
}

/// Uniform in a ball of four dimensions, the corners of its cube rejected.
inline JointPair ball(Fault fault = Fault::none) {
  JointPair pair{"ball", JointDomain::box(std::vector<Interval>(4, Interval{-1, 1}))};
  pair.sample = [](const JointUniforms& u) -> std::optional<JointRecord> {
    JointRecord record;
    double squares = 0;
    for (std::size_t d = 0; d < 4; ++d) {
      record.x[d][0] = 2 * u[d] - 1;
      squares += record.x[d][0] * record.x[d][0];
    }
    if (squares > 1) return std::nullopt;
    return record;
  };
  pair.pdf = [=](const JointPoint& x) {
    double squares = 0;
    for (std::size_t d = 0; d < 4; ++d) squares += x[d][0] * x[d][0];
    // Of a sampler that rejects: per number that it is given. Its volume is π²/2.
    return squares > 1 ? 0.0 : fault == Fault::area ? 2 / (pi * pi) : 1.0 / 16;
  };
  return pair;
}

/// (u, v) with uniform marginals: v = u + w modulo 1 with w in [0, ½], in two pairs of dimensions.
/// The fault is the pdf of independent numbers, right in each dimension.
inline JointPair shifted(Fault fault = Fault::none) {
  JointPair pair{"shifted", JointDomain({Domain::unit_square(), Domain::unit_square()})};
  pair.sample = [](const JointUniforms& u) -> std::optional<JointRecord> {
    const auto beside = [](double a, double w) {
      const double v = a + w / 2;
      return v - std::floor(v);
    };
    JointRecord record;
    record.x[0] = {u[0], u[1], 0};
    record.x[1] = {beside(u[0], u[2]), beside(u[1], u[3]), 0};
    return record;
  };
  pair.pdf = [=](const JointPoint& x) {
    if (fault == Fault::independent) return 1.0;
    const auto density = [](double a, double v) {
      const double w = v - a - std::floor(v - a);
      return w <= 0.5 ? 2.0 : 0.0;
    };
    return density(x[0][0], x[1][0]) * density(x[0][1], x[1][1]);
  };
  return pair;
}

/// The roots of two numbers: a density of 4 x y in the unit square.
inline JointPair roots() {
  JointPair pair{"roots", JointDomain::box({{0, 1}, {0, 1}})};
  pair.numbers = 2;
  pair.sample = [](const JointUniforms& u) -> std::optional<JointRecord> {
    JointRecord record;
    record.x[0][0] = std::sqrt(u[0]);
    record.x[1][0] = std::sqrt(u[1]);
    return record;
  };
  pair.pdf = [](const JointPoint& x) { return 4 * x[0][0] * x[1][0]; };
  return pair;
}

}  // namespace plumbline::verify::joint_pairs
