#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corpus.h"

#include <plumbline/verify/pair.h>

/// What the pairs of the corpus are written with: small vectors, frames, tables, and how a
/// technique becomes a case.
///
/// A technique is a plain struct with `sample` and `pdf`, as renderers have them. `fault` 0 is
/// correct; any other number makes the one small edit that the case of that number describes.
namespace plumbline::tests::corpus {
inline namespace pair_support {

using Domain = verify::Domain;
using Pair = verify::SamplingPair;
using Random = verify::Random;
using Kind = verify::CauseKind;

using std::numbers::pi_v;

template <class T>
struct Xy {
  T x, y;
};

template <class T>
struct Xyz {
  T x, y, z;
};

template <class T>
Xyz<T> operator+(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Xyz<T> operator-(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Xyz<T> operator*(T s, const Xyz<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
T dot(const Xyz<T>& a, const Xyz<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Xyz<T> cross(const Xyz<T>& a, const Xyz<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(const Xyz<T>& a) {
  return std::sqrt(dot(a, a));
}
template <class T>
Xyz<T> normalized(const Xyz<T>& a) {
  return (1 / length(a)) * a;
}

/// Orthonormal frame around n.
///
/// @source Duff et al. 2017 (JCGT 6:1), listing 3
template <class T>
struct Frame {
  Xyz<T> x, y, z;

  explicit Frame(const Xyz<T>& n) : z(n) {
    const T sign = std::copysign(T(1), n.z);
    const T a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
  Xyz<T> to_world(const Xyz<T>& v) const { return v.x * x + v.y * y + v.z * z; }
  Xyz<T> to_local(const Xyz<T>& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

/// Direction at cosθ around z, from 1 − cosθ so that narrow lobes keep their precision.
template <class T>
Xyz<T> around_z(T one_minus_cos, T phi) {
  const T sin_theta = std::sqrt(std::max(T(0), one_minus_cos * (2 - one_minus_cos)));
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - one_minus_cos};
}

/// Angle between unit vectors as 1 − cos, without the cancellation: |a − b|²/2.
template <class T>
T one_minus_dot(const Xyz<T>& a, const Xyz<T>& b) {
  const Xyz<T> d = a - b;
  return dot(d, d) / 2;
}

template <class T>
T at(const std::vector<T>& v, int i) {
  return v[static_cast<std::size_t>(i)];
}

template <class T>
T& ref(std::vector<T>& v, int i) {
  return v[static_cast<std::size_t>(i)];
}

template <class T>
std::vector<T> zeros(int n) {
  return std::vector<T>(static_cast<std::size_t>(n), T(0));
}

/// Index of the cell that x in [0, 1] falls in.
template <class T>
int cell_of(T x, int n) {
  return std::clamp(static_cast<int>(x * static_cast<T>(n)), 0, n - 1);
}

/// A technique with sample(u), sample(u, v) or sample(Random&), and pdf(x), as a pair.
template <class Point, class Technique>
Pair pair_of(std::string name, Domain domain, Technique technique) {
  using T = verify::PointScalar<Point>;
  const auto t = std::make_shared<const Technique>(std::move(technique));
  const auto pdf = [t](const Point& x) { return t->pdf(x); };
  if constexpr (requires(Random & random) { t->sample(random); }) {
    return verify::sampling_pair<Point>(
        std::move(name), std::move(domain), [t](Random& random) { return t->sample(random); }, pdf);
  } else if constexpr (requires(T u) { t->sample(u, u); }) {
    return verify::sampling_pair<Point>(
        std::move(name), std::move(domain), [t](T u, T v) { return t->sample(u, v); }, pdf);
  } else {
    return verify::sampling_pair<Point>(
        std::move(name), std::move(domain), [t](T u) { return t->sample(u); }, pdf);
  }
}

/// What a light's or phase function's sample() returns in a renderer: the point, with the density
/// and the weight value/pdf beside it.
template <class Point, class T>
struct Record {
  Point x;
  T pdf;
  T weight;
};

/// A technique whose sample(u, v) returns a record, with `value` (radiance, phase function).
template <class Point, class Technique>
Pair recorded_pair_of(std::string name, Domain domain, Technique technique) {
  using T = verify::PointScalar<Point>;
  const auto t = std::make_shared<const Technique>(std::move(technique));
  Pair pair;
  pair.name = std::move(name);
  pair.domain = std::move(domain);
  pair.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  pair.sample = [t](const verify::Uniforms& u) -> std::optional<verify::SampleRecord> {
    const std::optional<Record<Point, T>> r = t->sample(static_cast<T>(u[0]), static_cast<T>(u[1]));
    if (!r) return std::nullopt;
    verify::SampleRecord s;
    s.x = verify::to_point(r->x);
    s.pdf = static_cast<double>(r->pdf);
    s.weight.count = 1;
    s.weight.value[0] = static_cast<double>(r->weight);
    return s;
  };
  pair.pdf = [t](const verify::Vec3& x) {
    return static_cast<double>(t->pdf(verify::from_point<Point>(x)));
  };
  pair.value = [t](const verify::Vec3& x) {
    verify::Channels c;
    c.count = 1;
    c.value[0] = static_cast<double>(t->value(verify::from_point<Point>(x)));
    return c;
  };
  return pair;
}

/// Maps of at least 64×32 texels break along 100 and more lines. The one place where they say so.
inline Pair on_map_domain(Pair pair, int width, int height) {
  pair.domain =
      Domain::equirectangular(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  return pair;
}

inline Case twin(std::string name, std::string fault, std::vector<Kind> causes,
                 std::function<Pair()> pair) {
  const bool is_twin = !fault.empty();
  return {std::move(name), std::move(fault), std::move(causes),
          [pair = std::move(pair), is_twin](std::uint64_t seed, Effort effort) {
            const Pair checked = pair();
            verify::ContractOptions options = with_effort({}, effort, is_twin);
            // Fine bins are what an integral over texels begins with: with few, it is known half as
            // well for the same evaluations, and one map in fifteen stayed undecided.
            if (!is_twin && checked.domain.directions()) {
              options.finest_bins = verify::ContractOptions{}.finest_bins;
            }
            options.seed = seed;
            return verify::check_pair(checked, options);
          }};
}

inline Case correct(std::string name, std::function<Pair()> pair) {
  return twin(std::move(name), {}, {}, std::move(pair));
}

}  // namespace pair_support
}  // namespace plumbline::tests::corpus
