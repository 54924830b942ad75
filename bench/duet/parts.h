#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

/// What compare-runs measures of a revision: the same fixed work, whatever the revision, as these
/// sources stand outside of the trees that are compared.
namespace plumbline::duet {

/// What one unit of a part's work comes to. The same in every run of one build.
struct Counters {
  std::uint64_t rays = 0;     ///< of all kinds
  std::uint64_t samples = 0;  ///< that a check took until it decided
  std::uint64_t bytes = 0;    ///< of the file written
  std::uint64_t result = 0;   ///< hash of what was computed: it has changed if this has

  Counters& operator+=(const Counters& other) {
    rays += other.rays;
    samples += other.samples;
    bytes += other.bytes;
    result += other.result;
    return *this;
  }
};

/// One unit of work.
using Work = std::function<Counters()>;

/// How much one unit of work is.
enum class Size {
  timed,   ///< about a millisecond or less
  counted  ///< some ten thousand instructions, where that can be: each costs some 40 µs to count
};

struct Part {
  std::string name;
  std::function<Work(Size)> prepare;  ///< what is not measured
  /// Not where a unit is long, or asks the clock: what its answer needs is not always the same.
  bool counts_instructions = true;
};

std::span<const Part> render_parts();
std::span<const Part> bsdf_parts();
std::span<const Part> light_parts();
std::span<const Part> verify_parts();

/// Adds the bits of a number to a hash.
std::uint64_t with_bits(std::uint64_t hash, double value);

}  // namespace plumbline::duet
