#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <plumbline/verify/pair.h>

/// Many values of the code under test, in pieces of as many as are worth a call.
namespace plumbline::verify {

using Record = std::optional<SampleRecord>;

inline bool is_finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

/// A sample that is neither rejected nor an atom, nor at a point that is none.
inline bool has_density(const Record& sample) {
  return sample && !(sample->mass > 0) && is_finite(sample->x);
}

inline std::size_t samples_at_once(const SamplingPair& pair) {
  return pair.draw ? Many<double(Vec3)>::kOneByOne : pair.sample.batch();
}

/// Draws samples, in the order of one by one.
///
/// @param see  a span of Records
template <class See>
void draw_in_batches(const SamplingPair& pair, Random& random, std::uint64_t count,
                     const See& see) {
  std::vector<Record> batch(
      static_cast<std::size_t>(std::min<std::uint64_t>(count, samples_at_once(pair))));
  while (count > 0) {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, batch.size()));
    const std::span<Record> samples(batch.data(), now);
    pair.next(random, samples);
    see(std::span<const Record>(samples));
    count -= now;
  }
}

/// f at each of the points.
template <class R, class A>
void ask(const Many<R(A)>& f, std::span<const A> at, std::span<R> out) {
  for (std::size_t first = 0; first < at.size(); first += f.batch()) {
    const std::size_t now = std::min(f.batch(), at.size() - first);
    f(at.subspan(first, now), out.subspan(first, now));
  }
}

template <class R, class A>
std::vector<R> ask(const Many<R(A)>& f, const std::vector<A>& at) {
  std::vector<R> values(at.size());
  ask(f, std::span<const A>(at), std::span<R>(values));
  return values;
}

}  // namespace plumbline::verify
