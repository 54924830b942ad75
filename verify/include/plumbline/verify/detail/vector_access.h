#pragma once

#include <array>
#include <cstddef>
#include <tuple>
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

/// Two components, also where operator[] would make it look like three.
template <class P>
constexpr bool has_two_components() {
  if constexpr (requires { std::tuple_size<P>::value; }) {
    return std::tuple_size<P>::value == 2;
  } else if constexpr (requires { P::SizeAtCompileTime; }) {
    return static_cast<int>(P::SizeAtCompileTime) == 2;
  } else if constexpr (HasXy<P> || HasXyz<P>) {
    return !HasXyz<P>;
  } else {
    using T = std::remove_cvref_t<decltype(std::declval<const P&>()[0])>;
    return requires(T t) { P{t, t}; }
    &&!requires(T t) { P{t, t, t}; };
  }
}

/// One of two components.
template <class P>
auto plane_component(const P& p, int i) {
  if constexpr (HasXy<P>) {
    return i == 0 ? p.x : p.y;
  } else {
    return p[static_cast<std::size_t>(i)];
  }
}

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
  } else if constexpr (detail::has_two_components<P>()) {
    return {static_cast<double>(detail::plane_component(p, 0)),
            static_cast<double>(detail::plane_component(p, 1)), 0};
  } else {
    return to_vec3(p);
  }
}

template <class P>
P from_point(const Vec3& x) {
  if constexpr (std::is_arithmetic_v<P>) {
    return static_cast<P>(x[0]);
  } else if constexpr (detail::has_two_components<P>()) {
    using T = PointScalar<P>;
    const T first = static_cast<T>(x[0]), second = static_cast<T>(x[1]);
    if constexpr (requires { P{first, second}; }) {
      return P{first, second};
    } else {
      P p;
      p.x = first, p.y = second;
      return p;
    }
  } else {
    return from_vec3<P>(x);
  }
}

}  // namespace plumbline::verify
