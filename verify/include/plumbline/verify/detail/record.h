#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <plumbline/verify/detail/vector_access.h>

namespace plumbline::verify {

/// Random numbers of one sample, in [0, 1): as many as the pair says it uses.
using Uniforms = std::array<double, 3>;

/// A colour or spectrum as the checks keep it; a spectrum of more than 8 bands is thinned out to 8.
struct Channels {
  static constexpr std::size_t kMost = 8;
  std::size_t count = 0;
  std::array<double, kMost> value{};

  double operator[](std::size_t i) const { return value[i]; }
  friend bool operator==(const Channels&, const Channels&) = default;
};

/// A density that a record does not state.
inline constexpr double kNotApplicable = std::numeric_limits<double>::quiet_NaN();

/// What a sampler returned.
struct SampleRecord {
  Vec3 x{};                        ///< the point; of a BSDF, wi
  Channels weight = {};            ///< value/pdf that the record states; empty: it states none
  std::optional<double> pdf = {};  ///< density that the record states, if it does
  double mass = 0;                 ///< > 0: an atom with this probability, not a point of a density
};

}  // namespace plumbline::verify
