#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

/// Directions and points of any type: with members x, y, z, or with operator[]. No conversion code
/// is asked of the user.
namespace plumbline::verify {

/// A direction or point as the checks keep it.
using Vec3 = std::array<double, 3>;

template <class V>
concept HasXyz = requires(const V& v) {
  static_cast<double>(v.x);
  static_cast<double>(v.y);
  static_cast<double>(v.z);
};

template <class V>
concept HasIndex = requires(const V& v) {
  static_cast<double>(v[0]);
};

template <class V>
concept Vector3 = HasXyz<V> || HasIndex<V>;

namespace detail {

template <Vector3 V>
auto first_component(const V& v) {
  if constexpr (HasXyz<V>) {
    return v.x;
  } else {
    return v[0];
  }
}

}  // namespace detail

/// Scalar of a vector type: float for a Vec3f.
template <Vector3 V>
using ScalarOf = std::remove_cvref_t<decltype(detail::first_component(std::declval<const V&>()))>;

template <Vector3 V>
Vec3 to_vec3(const V& v) {
  if constexpr (HasXyz<V>) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  } else {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }
}

/// Makes the user's vector: from three scalars by braces, else by default construction and
/// assignment.
template <Vector3 V>
V from_vec3(const Vec3& v) {
  using T = ScalarOf<V>;
  const T x = static_cast<T>(v[0]), y = static_cast<T>(v[1]), z = static_cast<T>(v[2]);
  if constexpr (requires { V{x, y, z}; }) {
    return V{x, y, z};
  } else if constexpr (HasXyz<V>) {
    V r;
    r.x = x, r.y = y, r.z = z;
    return r;
  } else {
    V r;
    r[0] = x, r[1] = y, r[2] = z;
    return r;
  }
}

/// Points of any domain: a number, two or three components.
template <class P>
concept HasXy = requires(const P& p) {
  static_cast<double>(p.x);
  static_cast<double>(p.y);
};

namespace detail {

template <class P>
auto point_scalar(const P& p) {
  if constexpr (std::is_arithmetic_v<P>) {
    return p;
  } else if constexpr (HasXy<P>) {
    return p.x;
  } else {
    return p[0];
  }
}

}  // namespace detail

/// Scalar that a point is made of; an index of a discrete set counts as float.
template <class P>
using PointScalar = std::conditional_t<
    std::is_integral_v<P>, float,
    std::remove_cvref_t<decltype(detail::point_scalar(std::declval<const P&>()))>>;

template <class P>
Vec3 to_point(const P& p) {
  if constexpr (std::is_arithmetic_v<P>) {
    return {static_cast<double>(p), 0, 0};
  } else if constexpr (Vector3<P>) {
    return to_vec3(p);
  } else {
    return {static_cast<double>(p.x), static_cast<double>(p.y), 0};
  }
}

template <class P>
P from_point(const Vec3& x) {
  if constexpr (std::is_arithmetic_v<P>) {
    return static_cast<P>(x[0]);
  } else if constexpr (Vector3<P>) {
    return from_vec3<P>(x);
  } else {
    using T = PointScalar<P>;
    if constexpr (requires { P{T{}, T{}}; }) {
      return P{static_cast<T>(x[0]), static_cast<T>(x[1])};
    } else {
      P p;
      p.x = static_cast<T>(x[0]), p.y = static_cast<T>(x[1]);
      return p;
    }
  }
}

}  // namespace plumbline::verify
