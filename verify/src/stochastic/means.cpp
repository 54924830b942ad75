#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bsdfs/bsdf_result.h"
#include "directions.h"
#include "means/joint_agreement.h"
#include "stochastic/views.h"
#include "streams.h"
#include "text.h"

namespace plumbline::verify {

namespace {

std::string channel_name(std::size_t channel, std::size_t channels) {
  return channels == 1 ? std::string()
                       : "channel " + number(static_cast<std::uint64_t>(channel)) + ", ";
}

/// Each channel in the whole, then in each region.
class RegionQuantities {
 public:
  RegionQuantities(const Regions& regions, std::size_t channels, const std::string& of)
      : stride_(1 + regions.count()) {
    for (std::size_t c = 0; c < channels; ++c) {
      const std::string channel = channel_name(c, channels);
      list_.push_back({channel + of, c * stride_});
      for (std::size_t r = 0; r < regions.count(); ++r) {
        list_.push_back(
            {channel + of + " of the region around " + place(regions.center(r)), c * stride_});
      }
    }
  }

  const std::vector<JointQuantity>& list() const { return list_; }

  void add(JointMoments& moments, std::size_t channel, std::size_t region, double x) const {
    moments.add(channel * stride_, x);
    moments.add(channel * stride_ + 1 + region, x);
  }

 private:
  std::size_t stride_;
  std::vector<JointQuantity> list_;
};

bool has_finite_numbers(const Vec3& x) { return std::isfinite(x[0] + x[1] + x[2]); }

constexpr double kNaNWeight = std::numeric_limits<double>::quiet_NaN();

}  // namespace

CheckResult check_eval_mean(const StochasticView& view) {
  const RegionQuantities quantities(view.regions, view.channels, "what is reflected");
  Random of_samples = random_for(view.seed, Stream::stochastic_samples);
  Random of_points = random_for(view.seed, Stream::stochastic_points);
  const auto samples = [&](std::uint64_t count, JointMoments& moments) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::optional<SampleRecord> s = view.bsdf.sample(view.wo, of_samples);
      if (!s || is_atom(*s)) continue;
      const std::size_t region = view.regions.locate(s->x);
      for (std::size_t c = 0; c < view.channels; ++c) {
        quantities.add(moments, c, region, has_finite_numbers(s->x) ? s->weight[c] : kNaNWeight);
      }
    }
  };
  const auto points = [&](std::uint64_t count, JointMoments& moments) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const Regions::Point p = view.regions.draw(of_points);
      const Channels f = view.bsdf.eval(view.wo, p.x, of_points);
      const double factor = std::abs(p.x[2]) * p.inverse_density;
      for (std::size_t c = 0; c < view.channels; ++c) {
        quantities.add(moments, c, p.region, f[c] * factor);
      }
    }
  };
  return agree_jointly(mean_options(view, "eval"), quantities.list(), samples, points);
}

CheckResult check_pdf_mean(const StochasticView& view) {
  const RegionQuantities quantities(view.regions, 1, "the share of samples");
  Random of_samples = random_for(view.seed + 1, Stream::stochastic_samples);
  Random of_points = random_for(view.seed + 1, Stream::stochastic_points);
  const auto samples = [&](std::uint64_t count, JointMoments& moments) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::optional<SampleRecord> s = view.bsdf.sample(view.wo, of_samples);
      if (s && !is_atom(*s)) quantities.add(moments, 0, view.regions.locate(s->x), 1);
    }
  };
  const auto points = [&](std::uint64_t count, JointMoments& moments) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const Regions::Point p = view.regions.draw(of_points);
      const double pdf = pdf_or_nan(view.bsdf.pdf(view.wo, p.x, of_points));
      quantities.add(moments, 0, p.region, pdf * p.inverse_density);
    }
  };
  return agree_jointly(mean_options(view, "pdf"), quantities.list(), samples, points);
}

CheckResult check_known_albedo(const StochasticView& view) {
  MeanOptions o = mean_options(view, "albedo");
  o.reference = view.options.albedo(view.wo);
  o.relative = o.reference != 0;
  Random random = random_for(view.seed, Stream::stochastic_albedo);
  return check_mean(o, [&](std::uint64_t, std::uint64_t count) {
    Moments moments;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::optional<SampleRecord> s = view.bsdf.sample(view.wo, random);
      if (s) {
        moments.add(s->weight[0]);
      } else {
        moments.add_rejected();
      }
    }
    return moments;
  });
}

namespace {

/// Two directions, `first` as wo one way and as wi the other, sorted so that an error of one way is
/// not averaged with the same one of the other.
struct SortedPair {
  Vec3 first, second;
  std::size_t kind = 0;  ///< side, distance of the cosines, sense of the turn
};

constexpr std::size_t kKindsOfPairs = 12;
// About half of all pairs of one side are nearer.
constexpr double kNearCosines = 0.25;

/// Pairs at random, and pairs that are sampled: in narrow lobes nothing else falls. Both ways are
/// asked about pairs of one distribution, whatever that is.
class SortedPairs {
 public:
  SortedPairs(const StochasticBsdf& bsdf, const StochasticOptions& options)
      : bsdf_(bsdf), options_(options) {}

  SortedPair draw(Random& random) const {
    Vec3 a = looked_at(random), b = looked_at(random);
    if (random.uniform() < 0.5) {
      const std::optional<SampleRecord> s = bsdf_.sample(a, random);
      if (s && !is_atom(*s) && (s->x[2] > 0 ? options_.front : options_.back)) b = s->x;
    }
    const bool one_side = a[2] * b[2] > 0;
    const bool in_order = one_side ? std::abs(a[2]) >= std::abs(b[2]) : a[2] > b[2];
    if (!in_order) std::swap(a, b);
    const std::size_t side = one_side ? (a[2] > 0 ? 0 : 1) : 2;
    const bool far = std::abs(std::abs(a[2]) - std::abs(b[2])) > kNearCosines;
    const bool left = a[0] * b[1] - a[1] * b[0] > 0;
    return {a, b, 4 * side + (far ? 2 : 0) + (left ? 1 : 0)};
  }

 private:
  Vec3 looked_at(Random& random) const {
    Vec3 w = uniform_direction(random);
    if (!options_.back) w[2] = std::abs(w[2]);
    if (!options_.front) w[2] = -std::abs(w[2]);
    return w;
  }

  const StochasticBsdf& bsdf_;
  const StochasticOptions& options_;
};

std::vector<JointQuantity> quantities_of_pairs(std::size_t channels) {
  std::vector<JointQuantity> list;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t whole = list.size();
    list.push_back({channel_name(c, channels) + "all pairs", whole});
    for (std::size_t kind = 0; kind < kKindsOfPairs; ++kind) {
      static constexpr const char* kSides[] = {"above", "below", "on either side"};
      list.push_back({channel_name(c, channels) + "pairs " + kSides[kind / 4] + ", cosines " +
                          ((kind & 2) != 0 ? "far" : "near") + ", turned " +
                          ((kind & 1) != 0 ? "left" : "right"),
                      whole});
    }
  }
  return list;
}

}  // namespace

CheckResult check_stochastic_reciprocity(const StochasticBsdf& bsdf,
                                         const StochasticOptions& options) {
  Random there = random_for(options.seed, Stream::stochastic_there);
  Random back = random_for(options.seed, Stream::stochastic_back);
  const std::size_t channels = bsdf.eval({0, 0, 1}, {0, 0, 1}, there).count;
  MeanOptions o;
  o.subject = bsdf.name + "/reciprocity";
  o.seed = options.seed;
  o.budget = options.budget;
  o.tolerance = options.tolerance;
  o.n0 = kFirstJointLook;
  o.max_samples = options.max_samples;
  const SortedPairs pairs(bsdf, options);
  const auto sampler = [&](Random& random, bool reversed) {
    return [&bsdf, &options, &pairs, &random, reversed, channels](std::uint64_t count,
                                                                  JointMoments& moments) {
      for (std::uint64_t i = 0; i < count; ++i) {
        SortedPair p = pairs.draw(random);
        if (reversed) std::swap(p.first, p.second);
        const Channels f = bsdf.eval(p.first, p.second, random);
        // Both cosines: f itself may have no variance near the horizon.
        const double factor =
            std::abs(p.first[2] * p.second[2]) / eta_squared(p.first, options.eta);
        for (std::size_t c = 0; c < channels; ++c) {
          moments.add(c * (1 + kKindsOfPairs), f[c] * factor);
          moments.add(c * (1 + kKindsOfPairs) + 1 + p.kind, f[c] * factor);
        }
      }
    };
  };
  CheckResult result =
      agree_jointly(o, quantities_of_pairs(channels), sampler(there, false), sampler(back, true));
  result.kind = CheckKind::reciprocity;
  return result;
}

}  // namespace plumbline::verify
