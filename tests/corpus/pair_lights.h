#pragma once

#include "pair_support.h"

/// Lights as a shading point at the origin samples them: directions, densities per solid angle.
namespace plumbline::tests::corpus {

/// Uniform in a cone around an axis. 1 − cosθ_max = sin²θ_max / (1 + cosθ_max) keeps its digits.
template <class T>
struct Cone {
  int fault;
  Frame<T> frame;
  T cos_max, one_minus_cos_max;

  Cone(const Xyz<T>& axis, T angle, int which)
      : fault(which), frame(axis), cos_max(std::cos(angle)) {
    const T s = std::sin(angle);
    one_minus_cos_max = s * s / (1 + cos_max);
  }
  Xyz<T> sample(T u, T v) const {
    T away = u * one_minus_cos_max;
    if (fault == 3) away = u * u * one_minus_cos_max;
    const Xyz<T> w = around_z(away, 2 * pi_v<T> * v);
    return fault == 4 ? w : frame.to_world(w);
  }
  T pdf(const Xyz<T>& w) const {
    if (!(one_minus_dot(w, frame.z) <= one_minus_cos_max)) return 0;
    const T solid = fault == 2 ? 1 - cos_max : one_minus_cos_max;
    return fault == 1 ? 1 / solid : 1 / (2 * pi_v<T> * solid);
  }
};

/// A sphere seen from outside, by the cone that it fills.
template <class T>
Cone<T> sphere_cone(const Xyz<T>& centre, T radius, int fault) {
  return Cone<T>(normalized(centre), std::asin(radius / length(centre)), fault);
}

/// A sphere by its area: a point that faces away gives nothing. pdf_w = r²/(A cosθ_l).
template <class T>
struct SphereByArea {
  int fault;
  Xyz<T> centre;
  T radius;

  std::optional<Xyz<T>> sample(T u, T v) const {
    const Xyz<T> n = around_z(2 * u, 2 * pi_v<T> * v);
    const Xyz<T> p = centre + radius * n;
    if (dot(n, p) >= 0 && fault != 1) return std::nullopt;
    return normalized(p);
  }
  T pdf(const Xyz<T>& w) const {
    const T along = dot(w, centre);
    const Xyz<T> aside = centre - along * w;
    const T under_root = radius * radius - dot(aside, aside);
    if (!(along > 0 && under_root > 0)) return 0;
    const T d = along - std::sqrt(under_root);
    const T cosine = std::sqrt(under_root) / radius;
    const T area = 4 * pi_v<T> * radius * radius;
    if (fault == 2) return d * d / area;
    if (fault == 3) return d / (area * cosine);
    if (fault == 4) return 1 / area;
    if (fault == 5) return 2 * d * d / (area * cosine);
    return d * d / (area * cosine);
  }
};

/// A flat light with corner p and edges a, b (a triangle or a parallelogram), uniform in area.
template <class T>
struct FlatByArea {
  int fault;
  Xyz<T> p, a, b;
  bool triangle = false;

  T area() const { return length(cross(a, b)) * (triangle ? T(0.5) : T(1)); }
  Xyz<T> sample(T u, T v) const {
    if (triangle) {
      const T s = fault == 6 ? u : std::sqrt(u);
      u = 1 - s, v = v * s;
    }
    return normalized(p + u * a + v * b);
  }
  T pdf(const Xyz<T>& w) const {
    const Xyz<T> n = normalized(cross(a, b));
    const T cosine = dot(w, n);
    if (cosine == 0) return 0;
    const T d = dot(p, n) / cosine;
    if (!(d > 0)) return 0;
    // Coordinates of the hit along a and b: Cramer's rule in the plane.
    const Xyz<T> q = d * w - p;
    const T aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), qa = dot(q, a), qb = dot(q, b);
    const T det = aa * bb - ab * ab;
    const T s = (qa * bb - qb * ab) / det, t = (qb * aa - qa * ab) / det;
    if (!(s >= 0 && t >= 0 && (triangle ? s + t <= 1 : s <= 1 && t <= 1))) return 0;
    if (fault == 1) return d * d / area();
    if (fault == 2) return d / (area() * std::abs(cosine));
    if (fault == 3) return d * d * area() / std::abs(cosine);
    if (fault == 4) return 1 / area();
    if (fault == 5) return 1 / (area() * std::abs(cosine));
    return d * d / (area() * std::abs(cosine));
  }
};

/// A disk light facing the point, by its area.
template <class T>
struct DiskByArea {
  int fault;
  Xyz<T> centre, normal;
  T radius;

  Xyz<T> sample(T u, T v) const {
    const T r = radius * (fault == 3 ? u : std::sqrt(u)), phi = 2 * pi_v<T> * v;
    return normalized(centre +
                      Frame<T>(normal).to_world({r * std::cos(phi), r * std::sin(phi), T(0)}));
  }
  T pdf(const Xyz<T>& w) const {
    const T cosine = -dot(w, normal);
    if (!(cosine > 0)) return 0;
    const T d = -dot(centre, normal) / cosine;
    if (!(d > 0 && length(d * w - centre) <= radius)) return 0;
    if (fault == 1) return 1 / (pi_v<T> * radius * radius);
    const T area = fault == 2 ? 4 * pi_v<T> * radius * radius : pi_v<T> * radius * radius;
    return d * d / (area * cosine);
  }
};

/// A rectangle uniform in solid angle, at z = distance with x and y along the edges.
///
/// @source Ureña, Fajardo, King 2013 (EGSR), "An Area-Preserving Parametrization for Spherical
/// Rectangles", §3 and §4
template <class T>
struct SphericalRectangle {
  int fault;
  T x0, x1, y0, y1, z0;
  T b0, b1, k, solid;

  SphericalRectangle(int which, T xa, T xb, T ya, T yb, T distance)
      : fault(which), x0(xa), x1(xb), y0(ya), y1(yb), z0(-distance) {
    const Xyz<T> v00{x0, y0, z0}, v01{x0, y1, z0}, v10{x1, y0, z0}, v11{x1, y1, z0};
    const Xyz<T> n0 = normalized(cross(v00, v10)), n1 = normalized(cross(v10, v11)),
                 n2 = normalized(cross(v11, v01)), n3 = normalized(cross(v01, v00));
    const T g0 = std::acos(-dot(n0, n1)), g1 = std::acos(-dot(n1, n2));
    const T g2 = std::acos(-dot(n2, n3)), g3 = std::acos(-dot(n3, n0));
    b0 = n0.z, b1 = n2.z;
    k = 2 * pi_v<T> - g2 - g3;
    solid = g0 + g1 - k;
  }
  Xyz<T> sample(T u, T v) const {
    const T angle = u * solid + k;
    const T f = (std::cos(angle) * b0 - b1) / std::sin(angle);
    const T cu = std::clamp(std::copysign(1 / std::sqrt(f * f + b0 * b0), f), T(-1), T(1));
    const T xu = std::clamp(-(cu * z0) / std::sqrt(std::max(T(1e-12), 1 - cu * cu)), x0, x1);
    const T d2 = xu * xu + z0 * z0, d = std::sqrt(d2);
    const T h0 = y0 / std::sqrt(d2 + y0 * y0), h1 = y1 / std::sqrt(d2 + y1 * y1);
    const T hv = h0 + v * (h1 - h0);
    const T yv = fault == 2 ? y0 + v * (y1 - y0) : hv * d / std::sqrt(1 - hv * hv);
    return normalized(Xyz<T>{xu, yv, -z0});
  }
  T pdf(const Xyz<T>& w) const {
    if (!(w.z > 0)) return 0;
    const T x = w.x / w.z * -z0, y = w.y / w.z * -z0;
    if (!(x >= x0 && x <= x1 && y >= y0 && y <= y1)) return 0;
    return fault == 1 ? 1 / ((x1 - x0) * (y1 - y0)) : 1 / solid;
  }
};

/// A triangle uniform in solid angle.
///
/// @source Arvo 1995 (SIGGRAPH), "Stratified Sampling of Spherical Triangles", Fig. 3
template <class T>
struct SphericalTriangle {
  int fault;
  Xyz<T> a, b, c;
  T alpha, solid;

  SphericalTriangle(int which, const Xyz<T>& pa, const Xyz<T>& pb, const Xyz<T>& pc)
      : fault(which), a(normalized(pa)), b(normalized(pb)), c(normalized(pc)) {
    const Xyz<T> ab = normalized(cross(a, b)), bc = normalized(cross(b, c)),
                 ca = normalized(cross(c, a));
    alpha = std::acos(std::clamp(-dot(ab, ca), T(-1), T(1)));
    const T beta = std::acos(std::clamp(-dot(bc, ab), T(-1), T(1)));
    const T gamma = std::acos(std::clamp(-dot(ca, bc), T(-1), T(1)));
    solid = alpha + beta + gamma - pi_v<T>;
  }
  static Xyz<T> orthogonal(const Xyz<T>& v, const Xyz<T>& to) {
    return normalized(v - dot(v, to) * to);
  }
  Xyz<T> sample(T u, T v) const {
    const T area = u * solid;
    const T s = std::sin(area - alpha), t = std::cos(area - alpha);
    const T up = t - std::cos(alpha), vp = s + std::sin(alpha) * dot(a, b);
    const T q = ((vp * t - up * s) * std::cos(alpha) - vp) / ((vp * s + up * t) * std::sin(alpha));
    const T cq = std::clamp(q, T(-1), T(1));
    const Xyz<T> edge = cq * a + std::sqrt(std::max(T(0), 1 - cq * cq)) * orthogonal(c, a);
    T away = v * one_minus_dot(edge, b);
    if (fault == 2) away = v * v * one_minus_dot(edge, b);
    const T sine = std::sqrt(std::max(T(0), away * (2 - away)));
    return normalized((1 - away) * b + sine * orthogonal(edge, b));
  }
  T pdf(const Xyz<T>& w) const {
    const T turn = std::copysign(T(1), dot(cross(a, b), c));
    const bool inside = turn * dot(cross(a, b), w) >= 0 && turn * dot(cross(b, c), w) >= 0 &&
                        turn * dot(cross(c, a), w) >= 0;
    if (!inside) return 0;
    return fault == 1 ? 1 / (solid + pi_v<T>) : 1 / solid;
  }
};

/// Directions above a surface.
enum class Hemisphere { uniform, cosine, power };

template <class T>
struct HemisphereWarp {
  int fault;
  Hemisphere kind;
  T exponent = 20;

  Xyz<T> sample(T u, T v) const {
    const T phi = 2 * pi_v<T> * v;
    T z = 1 - u;
    if (kind == Hemisphere::cosine || fault == 1) z = std::sqrt(1 - u);
    if (kind == Hemisphere::power) z = std::pow(1 - u, 1 / (exponent + (fault == 4 ? 0 : 1)));
    const T r = std::sqrt(std::max(T(0), 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  T pdf(const Xyz<T>& w) const {
    if (!(w.z >= 0)) return 0;
    switch (kind) {
      case Hemisphere::uniform:
        return fault == 2 ? 1 / (4 * pi_v<T>) : 1 / (2 * pi_v<T>);
      case Hemisphere::cosine:
        return fault == 2 ? w.z : fault == 3 ? 1 / pi_v<T> : w.z / pi_v<T>;
      case Hemisphere::power:
        return (exponent + 1) / (2 * pi_v<T>)*std::pow(w.z, exponent);
    }
    return 0;
  }
};

/// Sky above, glow of the ground below: the half is chosen with the share of its power, the number
/// stretched and used again.
template <class T>
struct SkyAndGround {
  int fault;
  T sky = T(0.8);

  Xyz<T> sample(T u, T v) const {
    const bool up = u < sky;
    T left = up ? u / sky : (u - sky) / (1 - sky);
    if (fault == 3) left = u;
    const T r = std::sqrt(left), phi = 2 * pi_v<T> * v;
    const T z = std::sqrt(std::max(T(0), 1 - left));
    return {r * std::cos(phi), r * std::sin(phi), up ? z : -z};
  }
  T pdf(const Xyz<T>& w) const {
    const T lambert = std::abs(w.z) / pi_v<T>;
    if (fault == 1) return w.z > 0 ? sky * lambert : lambert;
    if (fault == 2) return w.z > 0 ? (1 - sky) * lambert : sky * lambert;
    if (fault == 4) return lambert / 2;
    return w.z > 0 ? sky * lambert : (1 - sky) * lambert;
  }
};

template <template <class> class Technique, class T>
Pair light(std::string name, Technique<T> technique) {
  return pair_of<Xyz<T>>(std::move(name), Domain::sphere(), std::move(technique));
}

}  // namespace plumbline::tests::corpus
