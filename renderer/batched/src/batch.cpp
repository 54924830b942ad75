#include <plumbline/renderer/batched/batch.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <plumbline/renderer/core/render/vertex.h>

#include "batch_kernels.h"
#include "order.h"
#include "ray_packets.h"

namespace plumbline::renderer {
namespace {

/// Puts values into the order of the vertices that are shaded together.
class Gather {
 public:
  Gather(const IndexLanes& order, std::size_t count) : order_(order), count_(count) {}

  template <class T>
  void operator()(Lanes<T>& to, const Lanes<T>& from) const {
    gather(to.data(), from.data(), order_.data(), count_);
  }
  void operator()(Vec3Lanes& to, const Vec3Lanes& from) const {
    (*this)(to.x, from.x);
    (*this)(to.y, from.y);
    (*this)(to.z, from.z);
  }

  /// In place.
  template <class T>
  void operator()(Lanes<T>& values) const {
    Lanes<T> sorted;
    (*this)(sorted, values);
    std::copy_n(sorted.begin(), count_, values.begin());
  }
  void operator()(RgbLanes& values) const {
    (*this)(values.r);
    (*this)(values.g);
    (*this)(values.b);
  }

 private:
  const IndexLanes& order_;
  std::size_t count_;
};

/// Where the run of equal values that starts at `first` ends, before `limit`.
template <class T>
std::size_t run_end(const std::array<T, kBatch>& values, std::size_t first, std::size_t limit) {
  std::size_t end = first + 1;
  while (end < limit && values[end] == values[first]) ++end;
  return end;
}

/// Sources of random numbers side by side.
/// @tparam Source  Pcg32 or SobolSampler, whose second word of state never changes
template <class Source>
struct RandomLanes {
  Lanes<std::uint64_t> state, constant;

  [[gnu::flatten]] void start(std::uint64_t seed, const Lanes<std::uint64_t>& net,
                              const Lanes<std::uint64_t>& index, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto started = Source(seed, net[k], index[k]).state();
      state[k] = started[0];
      constant[k] = started[1];
    }
  }

  [[gnu::flatten]] void draw(Run run, Lanes<float>& u, Lanes<float>& v) {
    for (std::size_t k = run.first; k < run.end; ++k) {
      Source source({state[k], constant[k]});
      const Vec2f pair = source.next_2d();
      u[k] = pair.x;
      v[k] = pair.y;
      state[k] = source.state()[0];
    }
  }

  /// Where `wanted` is 0 the pair is drawn in vain.
  void draw(const IndexLanes& wanted, std::size_t count, Lanes<float>& u, Lanes<float>& v) {
    const Lanes<std::uint64_t> before = state;
    draw({0, count}, u, v);
    for (std::size_t k = 0; k < count; ++k) state[k] = wanted[k] != 0 ? state[k] : before[k];
  }

  [[gnu::flatten]] void draw(std::size_t count, Lanes<float>& u) {
    for (std::size_t k = 0; k < count; ++k) {
      Source source({state[k], constant[k]});
      u[k] = source.next_1d();
      state[k] = source.state()[0];
    }
  }
};

/// @tparam Source  Pcg32 or SobolSampler
template <class Source>
class Batch final : public PixelSampler {
 public:
  Batch(const Scene& scene, const BsdfKernels& kernels, const PathOptions& options,
        std::uint64_t seed)
      : scene_(scene),
        packets_(scene.geometry()),
        kernels_(kernels),
        options_(options),
        techniques_(Techniques::of_counts(options.strategy == Strategy::light ? 0 : 1,
                                          options.strategy == Strategy::bsdf ? 0 : 1)),
        seed_(seed),
        bsdf_count_(static_cast<std::uint32_t>(scene.bsdfs().size())) {
    for (std::uint32_t i = 0; i < bsdf_count_; ++i) {
      has_density_.push_back(scene.bsdfs().parts(i).density ? 1 : 0);
    }
    has_density_.push_back(0);
    std::fill(s_.pmf.begin(), s_.pmf.end(), 1.0f);  // of the only light
  }

  void sample(int x, int y, std::uint64_t net, std::uint64_t index, PixelMoments& to) override {
    if (started_ == kBatch) finish();
    const std::size_t i = started_++;
    pixel_x_[i] = static_cast<float>(x);
    pixel_y_[i] = static_cast<float>(y);
    net_[i] = net;
    index_[i] = index;
    targets_[i] = &to;
  }

  void finish() override {
    launch();
    const std::size_t paths = s_.count;
    for (int depth = 1; within(options_, depth) && flying_ > 0; ++depth) {
      (depth == 1 ? counters.camera_rays : counters.bounce_rays) += flying_;
      packets_.intersect(s_.next, rays_.order(), flying_, hits_);
      add_emission(depth);
      if (!within(options_, depth + 1)) break;
      shade(depth);
    }
    for (std::size_t first = 0, end = 0; first < paths; first = end) {
      end = run_end(targets_, first, paths);
      targets_[first]->add({&radiance_[first], end - first});
    }
  }

 private:
  [[gnu::flatten]] void launch() {
    s_.count = std::exchange(started_, 0);
    random_.start(seed_, net_, index_, s_.count);
    random_.draw({0, s_.count}, s_.u, s_.v);
    const Camera camera = scene_.camera();
    const Vec3f origin = camera.origin();
    for (std::size_t i = 0, end = s_.count; i < end; ++i) {
      const Vec3f d = camera.direction(pixel_x_[i] + s_.u[i], pixel_y_[i] + s_.v[i]);
      s_.next.direction.set(i, d);
      s_.next.origin.set(i, origin);
    }
    for (std::size_t i = 0; i < s_.count; ++i) {
      s_.throughput.set(i, {1, 1, 1});
      s_.scale[i] = 1;
      s_.path[i] = static_cast<std::uint32_t>(i);
      s_.next_bin[i] = 0;
      radiance_[i] = {};
    }
    launch_next_rays();
  }

  /// Rays that point alike next to each other.
  void launch_next_rays() {
    rays_.sort(s_.next_bin, s_.count, kBins);
    flying_ = rays_.begin(kOctants);
  }

  bool samples_light() const { return techniques_.draw_light > 0; }

  /// Whether there are lights to choose from, by which vertices are sorted then. With one, or none,
  /// numbers are drawn after, for those alone that ask for a light sample.
  bool chooses_light() const { return samples_light() && scene_.lights().size() > 1; }

  /// Emission is rare among the ends of rays, so it is looked at one by one.
  void add_emission(int depth) {
    for (std::size_t k = 0; k < flying_; ++k) {
      const std::uint32_t i = rays_.order()[k];
      const std::uint32_t light = hits_.bsdf[k] == kNoHit ? scene_.environment() : hits_.light[k];
      if (light == kNoLight) continue;
      const Vec3f direction = s_.next.direction[i];
      const Arrival arrival{techniques_, s_.pdf_w[i], s_.atom_mass[i] > 0, s_.position[i]};
      radiance_[s_.path[i]] +=
          s_.throughput[i] * weighted_emission(options_, scene_.lights(),
                                               emission_of(scene_, light, direction), direction,
                                               depth > 1 ? &arrival : nullptr);
    }
  }

  void shade(int depth) {
    choose_lights();
    gather_vertices();
    to_local(s_);
    if (samples_light()) {
      for_each_bsdf([&](std::uint32_t bsdf, Run run) { sample_lights(bsdf, run); });
      weigh_lights(options_, s_);
      cast_shadows();
    }
    random_.draw({0, s_.count}, s_.u, s_.v);
    for_each_bsdf([&](std::uint32_t bsdf, Run run) {
      if (finds_no_more(options_, techniques_, scene_.bsdfs().parts(bsdf), depth)) {
        for (std::size_t k = run.first; k < run.end; ++k) s_.weight.set(k, {});
      } else {
        kernels_.sample(bsdf, s_, run);
        for (std::size_t k = run.first; k < run.end; ++k) {
          counters.rejected += s_.refraction[k] > 0 ? 0u : 1u;
        }
      }
    });
    apply_samples(s_);
    if (depth >= options_.rr_depth) {
      random_.draw(s_.count, s_.u);
      roulette(s_);
    }
    go_on(s_);
    launch_next_rays();
  }

  template <class Function>
  void for_each_bsdf(const Function& function) {
    for (std::uint32_t bsdf = 0; bsdf < bsdf_count_; ++bsdf) {
      const std::size_t first = bsdf * lights_apart_, last = first + lights_apart_ - 1;
      const Run run{vertices_.begin(first), vertices_.end(last)};
      if (run.first < run.end) function(bsdf, run);
    }
  }

  /// A path that asks no light draws no number for it.
  void choose_lights() {
    if (!chooses_light()) return;
    const std::uint32_t* has_density = has_density_.data();
    for (std::size_t k = 0, end = flying_; k < end; ++k) {
      wanted_[rays_.order()[k]] = has_density[std::min(hits_.bsdf[k], bsdf_count_)];
    }
    random_.draw(wanted_, s_.count, s_.u, s_.v);
    for (std::size_t i = 0; i < s_.count; ++i) {
      const auto choice = scene_.lights().choose(Vec2f{s_.u[i], s_.v[i]});
      s_.light[i] = choice.light;
      s_.pmf[i] = choice.pmf;
      s_.u[i] = choice.u.x;
    }
  }

  /// Sorts by BSDF and light where their pairs are few enough to count, else by BSDF.
  void gather_vertices() {
    const std::uint32_t bsdfs = bsdf_count_;
    const std::size_t lights = scene_.lights().size();
    const bool by_light = chooses_light() && bsdfs * lights <= kBatch;
    const auto stride = static_cast<std::uint32_t>(by_light ? lights : 1);
    lights_apart_ = stride;
    for (std::size_t k = 0, end = flying_; k < end; ++k) {
      const std::uint32_t light = by_light ? s_.light[rays_.order()[k]] : 0;
      keys_[k] = std::min(hits_.bsdf[k], bsdfs) * stride + light;
    }
    const std::size_t escaped = std::size_t{bsdfs} * stride;
    vertices_.sort(keys_, flying_, escaped + stride);
    s_.count = vertices_.begin(escaped);
    const Gather gather_hits(vertices_.order(), s_.count);
    gather_hits(s_.position, hits_.position);
    gather_hits(s_.normal, hits_.normal);
    gather_hits(s_.offset, hits_.offset);
    gather_hits(paths_, rays_.order());
    const Gather gather(paths_, s_.count);
    gather(s_.wo, s_.next.direction);
    gather(s_.throughput);
    gather(s_.scale);
    gather(s_.path);
    gather(random_.state);
    gather(random_.constant);
    if (!chooses_light()) return;
    gather(s_.u);
    gather(s_.v);
    gather(s_.light);
    gather(s_.pmf);
  }

  /// A light sample for each of the vertices of one BSDF.
  void sample_lights(std::uint32_t bsdf, Run run) {
    const LightSet& lights = scene_.lights();
    const bool density = scene_.bsdfs().parts(bsdf).density;
    if (density && !chooses_light()) random_.draw(run, s_.u, s_.v);
    if (!density || lights.empty()) {
      for (std::size_t k = run.first; k < run.end; ++k) s_.pdf_light[k] = s_.mass[k] = 0;
      if (density) counters.rejected += run.end - run.first;
      return;
    }
    for (std::size_t first = run.first, end = 0; first < run.end; first = end) {
      end = chooses_light() ? run_end(s_.light, first, run.end) : run.end;
      sample_light(lights[s_.light[first]], s_, {first, end});
    }
    for (std::size_t k = run.first; k < run.end; ++k) {
      counters.rejected += s_.pdf_light[k] > 0 || s_.mass[k] > 0 ? 0u : 1u;
    }
    kernels_.evaluate(bsdf, s_, run);
  }

  void cast_shadows() {
    shadows_.sort(s_.shadow_bin, s_.count, kBins);
    const IndexLanes& order = shadows_.order();
    const std::size_t count = shadows_.begin(kOctants);
    const std::size_t lit = shadows_.end(bin_of(Uncast::unblocked));
    counters.shadow_rays += lit;
    packets_.occluded(s_.shadow, s_.shadow_t_max, order, count, blocked_);
    for (std::size_t k = 0; k < lit; ++k) {
      const std::uint32_t i = order[k];
      if (k < count && blocked_[k] != 0) continue;
      radiance_[s_.path[i]] += s_.contribution[i];
    }
  }

  const Scene& scene_;
  RayPackets packets_;
  const BsdfKernels& kernels_;
  const PathOptions& options_;
  Techniques techniques_;
  std::uint64_t seed_;
  std::uint32_t bsdf_count_;
  std::vector<std::uint32_t> has_density_;  // of each BSDF, 0 or 1; 0 after the last one
  std::size_t lights_apart_ = 1;  // into how many runs the vertices of one BSDF are sorted
  std::size_t started_ = 0;
  Lanes<float> pixel_x_, pixel_y_;
  Lanes<std::uint64_t> net_, index_;
  Lanes<Rgbf> radiance_;
  std::array<PixelMoments*, kBatch> targets_;
  Shading s_{};
  RandomLanes<Source> random_;  // of the paths in s_
  CountingSort rays_;           // by octant, of the indices of those that go on
  std::size_t flying_ = 0;      // how many they are
  HitLanes hits_{};
  IndexLanes wanted_, keys_, paths_;
  CountingSort vertices_, shadows_;
  Lanes<std::uint8_t> blocked_;
};

}  // namespace

std::unique_ptr<PixelSampler> make_batched_sampler(const Scene& scene, const BsdfKernels& kernels,
                                                   const PathOptions& options, SamplerType sampler,
                                                   std::uint64_t seed) {
  const bool one_of_each = options.strategy == Strategy::bsdf ||
                           options.strategy == Strategy::light ||
                           (options.strategy == Strategy::mis && options.bsdf_samples == 1 &&
                            options.light_samples == 1);
  if (!one_of_each) return nullptr;
  if (sampler == SamplerType::sobol) {
    return std::make_unique<Batch<SobolSampler>>(scene, kernels, options, seed);
  }
  return std::make_unique<Batch<Pcg32>>(scene, kernels, options, seed);
}

}  // namespace plumbline::renderer
