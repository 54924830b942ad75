#pragma once

#include <plumbline/renderer/core/math.h>

namespace plumbline::renderer {

/// GGX (Trowbridge–Reitz) distribution of microfacet normals, anisotropic, with Smith's shadowing.
///
/// As in Mitsuba 3, masking and shadowing are independent: G = G1(wo) G1(wi). Normals are passed as
/// *unnormalised* vectors H on the side of wo: normalising them costs time and digits that nothing
/// needs.
struct Ggx {
  float alpha_x, alpha_y;  ///< roughness, 1e-4 … 1: Mitsuba's `alpha_u`, `alpha_v`

  /// S(w) = |(αx x, αy y, z)|.
  template <class T>
  [[gnu::always_inline]] T stretched_length(const Vec3<T>& w) const {
    using std::sqrt;
    return sqrt(sqr(T(T(alpha_x) * w.x)) + sqr(T(T(alpha_y) * w.y)) + sqr(w.z));
  }

  /// |z| + S(w): twice the projected area of the microsurface, with which G1(w) = 2|z|/(|z| +
  /// S(w)).
  ///
  /// @source Heitz 2014 (JCGT 3:2), Eq. 86
  template <class T>
  [[gnu::always_inline]] T visible_area(const Vec3<T>& w) const {
    using std::abs;
    return T(abs(w.z)) + stretched_length(w);
  }

  /// @return D [1/sr] of the normal along H
  /// @source Heitz 2014, Eq. 85, with numerator and denominator multiplied by (αx αy |H|²)²
  template <class T>
  [[gnu::always_inline]] T density(const Vec3<T>& normal) const {
    const T ax = T(alpha_x), ay = T(alpha_y), area = ax * ay;
    const T stretched = sqr(T(ay * normal.x)) + sqr(T(ax * normal.y)) + sqr(T(area * normal.z));
    return sqr(T(area * length_squared(normal) / stretched)) * T(area * (T(1) / pi<T>()));
  }

  /// @param w  unit
  /// @return   in [0, 1]
  template <class T>
  [[gnu::always_inline]] T masking(const Vec3<T>& w) const {
    using std::abs;
    return T(2) * T(abs(w.z)) / visible_area(w);
  }

  /// A normal seen from wo.
  template <class T>
  struct VisibleNormal {
    Vec3<T> normal;  ///< H, unnormalised, z ≥ 0
    T cosine;        ///< wo·H > 0
    T area;          ///< visible_area(wo)
  };

  /// Samples normals in proportion to their visible area: G1(wo) max(0, wo·h) D(h) / cosθo.
  ///
  /// @param wo  unit, z > 0
  /// @param u   in [0, 1)²
  /// @source    Dupuy, Benyoub 2023, "Sampling visible GGX normals with spherical caps", Listing 3
  template <class T>
  [[gnu::always_inline]] VisibleNormal<T> sample_visible(const Vec3<T>& wo,
                                                         const Vec2<T>& u) const {
    using std::sqrt;
    const T ax = T(alpha_x), ay = T(alpha_y);
    const T stretch = stretched_length(wo);
    const Vec3<T> w = Vec3<T>{T(ax * wo.x), T(ay * wo.y), wo.z} * T(T(1) / stretch);
    // The cap z > −w.z of the unit sphere: z = 1 − t, and 1 + z = 2 − t is written so that neither
    // it nor the sum with w.z cancels at the rim, u.y → 1.
    const T rim = (T(1) + w.z) * (T(1) - u.y);
    const T t = u.y * (T(1) + w.z);
    const T one_minus_wz = (sqr(w.x) + sqr(w.y)) / (T(1) + w.z);
    const T radius = safe_sqrt(T(t * (one_minus_wz + rim)));
    const SinCos<T> phi = sin_cos_turns(u.x);
    const Vec3<T> h{T(radius * phi.cos + w.x), T(radius * phi.sin + w.y), rim};
    // wo·H = |S wo| (w·h) with w·(c + w) = |c + w|²/2 for unit c and w: positive by construction.
    return {
        {T(ax * h.x), T(ay * h.y), h.z}, T(stretch * length_squared(h) / T(2)), T(wo.z + stretch)};
  }
};

/// Mirrors wo at the normal along H: 2 (wo·H)/|H|² H − wo.
///
/// By the scalar product, which keeps wi a unit vector where it is nearly 0; `n.cosine` keeps its
/// sign there, and trusts wo to be a unit vector to the last digit.
template <class T>
[[gnu::always_inline]] inline Vec3<T> reflect(const Vec3<T>& wo, const Ggx::VisibleNormal<T>& n) {
  return n.normal * T(T(2) * dot(wo, n.normal) / length_squared(n.normal)) - wo;
}

/// Mirrors a direction at the surface.
template <class T>
Vec3<T> mirror(const Vec3<T>& w) {
  return {-w.x, -w.y, w.z};
}

}  // namespace plumbline::renderer
