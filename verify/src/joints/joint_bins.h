#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plumbline/verify/joint.h>

#include "joints/cube.h"
#include "joints/cube_mass.h"
#include "joints/cube_tree.h"
#include "pairs/chi_square_look.h"

/// A joint pair cut into bins: what the pdf expects of each, and what the sampler put there.
namespace plumbline::verify {

using MaybeJoint = std::optional<JointRecord>;

/// @throws std::invalid_argument for a pair that no check can look at
void require_usable(const JointPair& pair, const ContractOptions& options);

/// Draws samples and shows them in spans: the same as one by one.
///
/// @param see  a span of MaybeJoint
template <class See>
void draw_joint(const JointPair& pair, Random& random, std::uint64_t count, const See& see);

bool all_finite(const JointPoint& x);

/// Whether pdf() is positive somewhere within rounding of a point.
bool positive_near(const JointPair& pair, const Cube& cube, const JointPoint& x);

/// "(0.1, 0, 0) × (0.3, 0.2, 0.93)"
std::string place(const JointPair& pair, const JointPoint& x);

/// A share that samples show.
struct CountedShare {
  double hits = 0, trials = 0;

  double value() const { return trials > 0 ? hits / trials : 0; }

  /// Two-sided, at a level.
  double error(double level) const;
};

struct JointCounts {
  std::vector<std::uint64_t> bins;
  std::uint64_t drawn = 0, rejected = 0;
  std::uint64_t stray = 0;       ///< outside the domain, or where the density is 0 all around
  std::uint64_t not_finite = 0;  ///< samples, or densities at them, not finite or negative
  std::optional<JointPoint> stray_at, not_finite_at;  ///< the first
};

class JointBins {
 public:
  /// Draws pilot samples, cuts the cube where they fall, and integrates the density over each bin.
  JointBins(const JointPair& pair, const ContractOptions& options);

  /// Draws more samples and counts them.
  void draw(std::uint64_t count);

  const JointPair& pair() const { return pair_; }
  int depth() const { return depth_; }
  const CubeMass& expected() const { return expected_; }  ///< mass per finest bin
  const JointCounts& counts() const { return counts_; }

  /// Expected and observed counts of the bins of one depth.
  BinTable table(int depth) const;

  /// Share of the samples that are rejected, counted until half the promise of the integral is
  /// known of it, or to a cap.
  CountedShare rejected() const;

  /// By how much, relative and on average, rounding of the point changes the density.
  double rounding() const { return rounding_; }

  /// Share of the pilot samples that have a coordinate of the cube in common with many others.
  double on_lines() const { return on_lines_; }

  /// Middle of a bin of a depth, in the domain.
  JointPoint center(int depth, std::size_t bin) const;

 private:
  void integrate(const ContractOptions& options);
  void measure_rounding();
  void count(std::span<const MaybeJoint> samples);
  void count_point(const JointPoint& x, double density);

  const JointPair& pair_;
  ContractOptions options_;
  Cube cube_;
  Random random_;
  int depth_;
  double rounding_ = 0, on_lines_ = 0;
  std::optional<CubeTree> tree_;
  CubeMass expected_;
  JointCounts counts_;
};

/// What a pass of the integral check promises.
double joint_mass_tolerance(const ContractOptions& options);

template <class See>
void draw_joint(const JointPair& pair, Random& random, std::uint64_t count, const See& see) {
  const bool in_float = pair.epsilon > 0x1p-40;
  const std::size_t at_once = pair.draw ? 512 : pair.sample.batch();
  std::vector<JointUniforms> u;
  std::vector<MaybeJoint> samples;
  while (count > 0) {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, at_once));
    samples.resize(now);
    if (pair.draw) {
      for (MaybeJoint& sample : samples) sample = pair.draw(random);
    } else {
      u.assign(now, JointUniforms{});
      for (JointUniforms& numbers : u) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(pair.numbers); ++i) {
          numbers[i] = in_float ? static_cast<double>(random.uniform_float()) : random.uniform();
        }
      }
      pair.sample(std::span<const JointUniforms>(u), std::span<MaybeJoint>(samples));
    }
    see(std::span<const MaybeJoint>(samples));
    count -= now;
  }
}

}  // namespace plumbline::verify
