#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/pair.h>

/// A slab that answers by random walks, for the tests of the checks, and what its authors get
/// wrong.
namespace plumbline::verify {

enum class WalkFault {
  none,
  no_pi,               ///< eval: the bottom's ρ without 1/π
  no_exit_fresnel,     ///< eval: what leaves through the top loses nothing
  short_eval,          ///< eval alone stops after two vertices
  short_walk,          ///< sample, eval and pdf stop after two vertices
  pdf_of_bottom,       ///< pdf: a cosine, as if only the bottom scattered
  pdf_as_divisor,      ///< weight = f̂ cosθ / p̂, p̂ the mean of eight
  pdf_of_last_vertex,  ///< in the record: the density of wi at the vertex that it has left
  one_seed,            ///< eval and pdf walk with the same numbers, seeded by the directions
  one_way_fresnel      ///< eval: what enters loses nothing; still reciprocal nowhere
};

/// A medium (Henyey-Greenstein) between a smooth interface without refraction (Schlick) and a
/// diffuse bottom, black from below. Two channels.
///
/// f cosθi is the sum over the vertices of a walk of throughput · scattering towards wi ·
/// transmittance to the top · 1 − F(wi). Walks are analog: they survive a vertex with the larger
/// albedo, so that the sum of survival · scattering · transmittance · (1 − F) is the density of wi.
struct LayeredWalk {
  WalkFault fault = WalkFault::none;
  std::array<double, 2> albedo{0.95, 0.7};  ///< of the medium
  std::array<double, 2> bottom{0.8, 0.5};   ///< reflectance
  double depth = 0.7;                       ///< optical
  double g = 0.5;

  /// @source Schlick 1994, Eq. 15, with F0 = 0.08
  static double fresnel(double cosine) { return 0.08 + 0.92 * std::pow(1 - cosine, 5); }

  /// Density per solid angle of turning by an angle with this cosine.
  /// @source Henyey, Greenstein 1941, Eq. 2
  double phase(double t) const {
    const double d = 1 + g * g - 2 * g * t;
    return (1 - g * g) / (4 * std::numbers::pi * d * std::sqrt(d));
  }

  static Vec3 turned(const Vec3& w, double t, double phi) {
    const double s = std::copysign(1.0, w[2]), a = -1 / (s + w[2]), b = w[0] * w[1] * a;
    const double r = std::sqrt(std::max(0.0, 1 - t * t));
    const double x = r * std::cos(phi), y = r * std::sin(phi);
    return {x * (1 + s * w[0] * w[0] * a) + y * b + t * w[0],
            x * s * b + y * (s + w[1] * w[1] * a) + t * w[1], -x * s * w[0] - y * w[1] + t * w[2]};
  }

  Vec3 scattered(const Vec3& w, Random& random) const {
    const double q = (1 - g * g) / (1 + g - 2 * g * random.uniform());
    const double t = (1 + g * g - q * q) / (2 * g);
    return turned(w, std::clamp(t, -1.0, 1.0), 2 * std::numbers::pi * random.uniform());
  }

  struct Vertex {
    bool at_bottom = false;
    double below = 0;  ///< optical depth
    Vec3 w{};          ///< direction of travel there
    std::array<double, 2> throughput{1, 1};
  };

  double survival(const Vertex& v) const {
    return v.at_bottom ? std::max(bottom[0], bottom[1]) : std::max(albedo[0], albedo[1]);
  }

  /// Scattering of a vertex towards wi, times what of it gets out; per solid angle.
  double towards(const Vertex& v, const Vec3& wi, bool with_fresnel = true) const {
    const double scattering = v.at_bottom ? wi[2] / std::numbers::pi
                                          : phase(v.w[0] * wi[0] + v.w[1] * wi[1] + v.w[2] * wi[2]);
    return scattering * std::exp(-v.below / wi[2]) * (with_fresnel ? 1 - fresnel(wi[2]) : 1);
  }

  /// Walks from the entrance; `see` is shown each vertex, before it is known whether light survives
  /// it. The direction of what leaves at the top, with its throughput in `last`.
  template <class See>
  std::optional<Vec3> walk(const Vec3& wo, Random& random, int most_vertices, Vertex& last,
                           const See& see) const {
    Vertex v;
    v.w = {-wo[0], -wo[1], -wo[2]};
    for (int vertices = 0;;) {
      const double free = -std::log1p(-random.uniform());
      const bool down = v.w[2] < 0;
      const double border = (down ? depth - v.below : v.below) / std::abs(v.w[2]);
      if (!down && free >= border) {
        if (random.uniform() >= fresnel(v.w[2])) return v.w;
        v.w[2] = -v.w[2];
        v.below = 0;
        continue;
      }
      v.at_bottom = down && free >= border;
      v.below = v.at_bottom ? depth : v.below - free * v.w[2];
      if (vertices++ == most_vertices) return std::nullopt;
      see(v);
      last = v;
      if (random.uniform() >= survival(v)) return std::nullopt;
      for (std::size_t c = 0; c < 2; ++c) {
        v.throughput[c] *= (v.at_bottom ? bottom[c] : albedo[c]) / survival(v);
      }
      last.throughput = v.throughput;
      v.w = v.at_bottom ? turned({0, 0, 1}, std::sqrt(1 - random.uniform()),
                                 2 * std::numbers::pi * random.uniform())
                        : scattered(v.w, random);
    }
  }

  static constexpr int kLong = 1 << 20;
  int vertices_of_sample() const { return fault == WalkFault::short_walk ? 2 : kLong; }
  int vertices_of_eval() const { return fault == WalkFault::short_eval ? 2 : vertices_of_sample(); }

  /// The generator that a value takes its numbers from.
  Random numbers(const Vec3& wi, Random& random) const {
    if (fault != WalkFault::one_seed) return Random(random.bits());
    return Random(std::bit_cast<std::uint64_t>(wi[0]) ^ std::bit_cast<std::uint64_t>(wi[1]));
  }

  Channels eval(const Vec3& wo, const Vec3& wi, Random& random) const {
    Channels f{2, {}};
    if (!(wo[2] > 0 && wi[2] > 0)) return f;
    Random own = numbers(wi, random);
    Vertex last;
    const double enters = fault == WalkFault::one_way_fresnel ? 1 : 1 - fresnel(wo[2]);
    walk(wo, own, vertices_of_eval(), last, [&](const Vertex& v) {
      const double pi = fault == WalkFault::no_pi && v.at_bottom ? std::numbers::pi : 1;
      const double out = pi * towards(v, wi, fault != WalkFault::no_exit_fresnel);
      for (std::size_t c = 0; c < 2; ++c) {
        f.value[c] +=
            enters * v.throughput[c] * (v.at_bottom ? bottom[c] : albedo[c]) * out / wi[2];
      }
    });
    return f;
  }

  double pdf(const Vec3& wo, const Vec3& wi, Random& random) const {
    if (!(wo[2] > 0 && wi[2] > 0)) return 0;
    const double enters = 1 - fresnel(wo[2]);
    if (fault == WalkFault::pdf_of_bottom) return enters * wi[2] / std::numbers::pi;
    Random own = numbers(wi, random);
    double density = 0;
    Vertex last;
    walk(wo, own, vertices_of_sample(), last,
         [&](const Vertex& v) { density += enters * survival(v) * towards(v, wi); });
    return density;
  }

  std::optional<SampleRecord> sample(const Vec3& wo, Random& random) const {
    if (!(wo[2] > 0)) return std::nullopt;
    const double mirrored = fresnel(wo[2]);
    if (random.uniform() < mirrored) {
      SampleRecord r{{-wo[0], -wo[1], wo[2]}, {2, {1, 1}}};
      r.mass = mirrored;
      return r;
    }
    Vertex last;
    const std::optional<Vec3> wi =
        walk(wo, random, vertices_of_sample(), last, [](const Vertex&) {});
    if (!wi) return std::nullopt;
    SampleRecord r{*wi, {2, {last.throughput[0], last.throughput[1]}}};
    if (fault == WalkFault::pdf_of_last_vertex) r.pdf = (1 - mirrored) * towards(last, *wi);
    if (fault == WalkFault::pdf_as_divisor) {
      r.weight = eval(wo, *wi, random);
      double p = 0;  // one walk alone may come near to 0: 1/p has no variance then
      for (int i = 0; i < 8; ++i) p += pdf(wo, *wi, random) / 8;
      for (std::size_t c = 0; c < 2; ++c) r.weight.value[c] *= (*wi)[2] / p;
    }
    return r;
  }
};

}  // namespace plumbline::verify
