#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

/// Vectors, colours, shading frames and scalar helpers, templated over the scalar so that one
/// formula runs in float (rendering), double, quad precision and autodiff types. Functions of
/// <cmath> are found by argument-dependent lookup: write `using std::sqrt; sqrt(x)`, or call the
/// helpers below.
namespace plumbline::renderer {

template <class T>
inline constexpr bool is_builtin_float = std::is_floating_point_v<T>;

/// π in the scalar's own precision. (std::numbers has no variable for class types.)
template <class T>
constexpr T pi() {
  if constexpr (is_builtin_float<T>) {
    return std::numbers::pi_v<T>;
  } else {
    // 36 digits: enough for quad (34), and exact to rounding for autodiff over double.
    return T(3.14159265358979323846264338327950288L);
  }
}

template <class T>
T sqr(const T& x) {
  return x * x;
}

/// sqrt(max(x, 0)): the clamp guards against rounding below zero only, never against a wrong
/// formula.
template <class T>
T safe_sqrt(const T& x) {
  using std::sqrt;
  return x > T(0) ? T(sqrt(x)) : T(0);
}

/// What float widens to where a difference would cancel: double. Other scalars stay what they are.
template <class T>
using Wide = std::conditional_t<std::is_same_v<T, float>, double, T>;

/// eˣ − 1 without cancellation, also for scalars that have no expm1 of their own.
template <class T>
T exp_minus_1(const T& x) {
  if constexpr (std::is_same_v<T, float>) {
    // Kahan: the rounding of eˣ cancels out of (eˣ − 1)/ln(eˣ). libm's own costs three times that.
    const float power = std::exp(x);
    if (power == 1.0f) return x;
    return power > 0.0f ? (power - 1.0f) * x / std::log(power) : -1.0f;
  } else if constexpr (is_builtin_float<T>) {
    return std::expm1(x);
  } else {
    using std::exp, std::sinh;
    const T half = x / T(2);
    return T(2) * sinh(half) * exp(half);
  }
}

/// ln(1 + x) without cancellation, for x > −1.
template <class T>
T log_1_plus(const T& x) {
  if constexpr (std::is_same_v<T, float>) {
    // Kahan: the rounding of 1 + x cancels out of ln(1 + x)/((1 + x) − 1).
    const float sum = 1.0f + x;
    return sum == 1.0f ? x : std::log(sum) * x / (sum - 1.0f);
  } else if constexpr (is_builtin_float<T>) {
    return std::log1p(x);
  } else {
    using std::atanh, std::log;
    if (x < T(-0.5)) return T(log(T(T(1) + x)));  // nothing cancels, and atanh would near −1
    return T(2) * atanh(T(x / (T(2) + x)));
  }
}

template <class T>
struct SinCos {
  T sin, cos;
};

/// sin and cos of 2πu.
///
/// In float by polynomials on an eighth of a turn, whose reduction is exact because whole turns
/// need no π; libm's argument reduction costs more than the rest of a BSDF sample.
/// @param u  in [0, 1]
/// @source   coefficients of Cephes (Moshier), sinf.c; absolute error below 1.2e-7
template <class T>
[[gnu::always_inline]] inline SinCos<T> sin_cos_turns(const T& u) {
  if constexpr (std::is_same_v<T, float>) {
    // Among the floats from 2²³ on lie whole numbers only: the sum is rounded to one, and holds it
    // in its lowest bits. A conversion to int would keep compilers from vectorising what branches.
    constexpr float kWhole = 0x1.8p23f;
    const float rounded = 4.0f * u + kWhole;
    const auto quarter = std::bit_cast<std::uint32_t>(rounded);
    const float x = 2 * pi<float>() * (u - 0.25f * (rounded - kWhole));
    const float x2 = x * x;
    const float s =
        x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f - x2 * 1.9515295891e-4f));
    const float c =
        1.0f - 0.5f * x2 +
        x2 * x2 *
            (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
    const bool swapped = (quarter & 1) != 0;
    const float sine = swapped ? c : s, cosine = swapped ? s : c;
    return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
  } else {
    using std::cos, std::sin;
    const T angle = T(2) * pi<T>() * u;
    return {T(sin(angle)), T(cos(angle))};
  }
}

/// Angle of the point (x, y), from −π to π.
///
/// In float by a polynomial, which loops over many can vectorise; the quotient is still formed in
/// the coordinates' own precision and range.
/// @tparam Angle  scalar of the result
/// @source        Abramowitz, Stegun 1964, 4.4.49; relative error of the polynomial 2e-8
template <class Angle, class T>
[[gnu::always_inline]] inline Angle angle_of(const T& y, const T& x) {
  if constexpr (std::is_same_v<Angle, float>) {
    const T abs_x = x < 0 ? -x : x, abs_y = y < 0 ? -y : y;
    const T larger = abs_x < abs_y ? abs_y : abs_x, smaller = abs_x < abs_y ? abs_x : abs_y;
    const float q = static_cast<float>(larger > 0 ? smaller / larger : T(0));
    const float q2 = q * q;
    float high = -0.0752896400f + q2 * (0.0429096138f + q2 * (-0.0161657367f + q2 * 0.0028662257f));
    high = 0.1999355085f + q2 * (-0.1420889944f + q2 * (0.1065626393f + q2 * high));
    const float octant = q + q * q2 * (-0.3333314528f + q2 * high);
    const float quadrant = abs_x < abs_y ? pi<float>() / 2 - octant : octant;
    const float half = x < 0 ? pi<float>() - quadrant : quadrant;
    return y < 0 ? -half : half;
  } else {
    using std::atan2;
    return atan2(y, x);
  }
}

template <class T>
struct Vec2 {
  T x{}, y{};
};

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  Vec3& operator+=(const Vec3& b) { return *this = *this + b; }

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const Vec3& a, const T& s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(const T& s, const Vec3& a) { return a * s; }
  friend Vec3 operator/(const Vec3& a, const T& s) { return {a.x / s, a.y / s, a.z / s}; }
};

template <class To, class From>
Vec3<To> vec_cast(const Vec3<From>& v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}

template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length_squared(const Vec3<T>& a) {
  return dot(a, a);
}

template <class T>
T length(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

template <class T>
Vec3<T> normalize(const Vec3<T>& a) {
  return a / length(a);
}

/// Linear RGB, Rec. 709 primaries. The unit follows from the context: radiance, albedo, sample
/// weight.
template <class T>
struct Rgb {
  T r{}, g{}, b{};

  Rgb& operator+=(const Rgb& c) { return *this = *this + c; }

  friend Rgb operator+(const Rgb& c, const Rgb& d) { return {c.r + d.r, c.g + d.g, c.b + d.b}; }
  friend Rgb operator*(const Rgb& c, const Rgb& d) { return {c.r * d.r, c.g * d.g, c.b * d.b}; }
  friend Rgb operator*(const Rgb& c, const T& s) { return {c.r * s, c.g * s, c.b * s}; }
  friend Rgb operator*(const T& s, const Rgb& c) { return c * s; }
  friend Rgb operator/(const Rgb& c, const T& s) { return {c.r / s, c.g / s, c.b / s}; }
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

template <class To, class From>
Rgb<To> rgb_cast(const Rgb<From>& c) {
  return {static_cast<To>(c.r), static_cast<To>(c.g), static_cast<To>(c.b)};
}

template <class T>
T max_component(const Rgb<T>& c) {
  return std::max(std::max(c.r, c.g), c.b);
}

template <class T>
T mean(const Rgb<T>& c) {
  return (c.r + c.g + c.b) / T(3);
}

/// Scalars beside colours, where a formula serves both.
template <class T>
T mean(const T& x) {
  return x;
}

template <class T>
Rgb<T> to_rgb(const T& x) {
  return {x, x, x};
}

template <class T>
Rgb<T> to_rgb(const Rgb<T>& c) {
  return c;
}

template <class T>
bool is_black(const Rgb<T>& c) {
  return c.r == T(0) && c.g == T(0) && c.b == T(0);
}

/// Rec. 709 luminance, the weights that the comparison scenes are defined with.
template <class T>
T luminance(const Rgb<T>& c) {
  return T(0.2126) * c.r + T(0.7152) * c.g + T(0.0722) * c.b;
}

/// Orthonormal basis around a unit normal; in the local frame z is the normal.
///
/// @source Duff et al. 2017 (JCGT 6:1), Listing 3: branch on the sign of z only, no cancellation
template <class T>
struct Frame {
  Vec3<T> tangent, bitangent, normal;

  explicit Frame(const Vec3<T>& n) : normal(n) {
    const T sign = n.z >= T(0) ? T(1) : T(-1);
    const T a = T(-1) / (sign + n.z);
    const T b = n.x * n.y * a;
    tangent = {T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }

  Vec3<T> to_local(const Vec3<T>& v) const {
    return {dot(v, tangent), dot(v, bitangent), dot(v, normal)};
  }
  Vec3<T> to_world(const Vec3<T>& v) const {
    return tangent * v.x + bitangent * v.y + normal * v.z;
  }
};

using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Rgbf = Rgb<float>;
using Rgbd = Rgb<double>;

}  // namespace plumbline::renderer
