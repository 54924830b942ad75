#include "batch.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "batch_kernels.h"
#include "vertex.h"

namespace plumbline::renderer {
namespace {

/// Stable counting sort of 0 … count − 1 by key, into `order`.
class CountingSort {
 public:
  /// @param keys  each < kinds
  void sort(const IndexLanes& keys, std::size_t count, std::size_t kinds) {
    ends_.assign(kinds, 0);
    for (std::size_t i = 0; i < count; ++i) ++ends_[keys[i]];
    std::uint32_t before = 0;
    for (std::uint32_t& end : ends_) before += std::exchange(end, before);
    for (std::size_t i = 0; i < count; ++i)
      order_[ends_[keys[i]]++] = static_cast<std::uint32_t>(i);
  }

  /// Where the run of a key starts in order(), and where it ends.
  std::size_t begin(std::size_t key) const { return key == 0 ? 0 : ends_[key - 1]; }
  std::size_t end(std::size_t key) const { return ends_[key]; }
  const IndexLanes& order() const { return order_; }

 private:
  std::vector<std::uint32_t> ends_;
  IndexLanes order_;
};

template <class T>
void gather(T* __restrict to, const T* __restrict from, const std::uint32_t* __restrict order,
            std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) to[k] = from[order[k]];
}

template <class T>
void gather(Lanes<T>& to, const Lanes<T>& from, const IndexLanes& order, std::size_t count) {
  gather(to.data(), from.data(), order.data(), count);
}

void gather(Vec3Lanes& to, const Vec3Lanes& from, const IndexLanes& order, std::size_t count) {
  gather(to.x, from.x, order, count);
  gather(to.y, from.y, order, count);
  gather(to.z, from.z, order, count);
}

void gather(RgbLanes& to, const RgbLanes& from, const IndexLanes& order, std::size_t count) {
  gather(to.r, from.r, order, count);
  gather(to.g, from.g, order, count);
  gather(to.b, from.b, order, count);
}

/// Where the run of equal values that starts at `first` ends, before `limit`.
std::size_t run_end(const IndexLanes& values, std::size_t first, std::size_t limit) {
  std::size_t end = first + 1;
  while (end < limit && values[end] == values[first]) ++end;
  return end;
}

/// Sources of random numbers side by side.
/// @tparam Source  Pcg32 or SobolSampler, whose second word of state never changes
template <class Source>
struct RandomLanes {
  Lanes<std::uint64_t> state, constant;

  [[gnu::flatten]] void draw(Run run, Lanes<float>& u, Lanes<float>& v) {
    for (std::size_t k = run.first; k < run.end; ++k) {
      Source source({state[k], constant[k]});
      const Vec2f pair = source.next_2d();
      u[k] = pair.x;
      v[k] = pair.y;
      state[k] = source.state()[0];
    }
  }

  /// One number each for the first `count`; where `wanted` is 0 it is drawn in vain.
  [[gnu::flatten]] void draw(const IndexLanes& wanted, std::size_t count, Lanes<float>& u) {
    for (std::size_t k = 0; k < count; ++k) {
      Source source({state[k], constant[k]});
      u[k] = source.next_1d();
      state[k] = wanted[k] != 0 ? source.state()[0] : state[k];
    }
  }
};

template <class Source>
void gather(RandomLanes<Source>& to, const RandomLanes<Source>& from, const IndexLanes& order,
            std::size_t count) {
  gather(to.state, from.state, order, count);
  gather(to.constant, from.constant, order, count);
}

/// @tparam Source  Pcg32 or SobolSampler
template <class Source>
class Batch final : public BatchTracer {
 public:
  Batch(const Scene& scene, const PathOptions& options, std::uint64_t seed)
      : scene_(scene), options_(options), seed_(seed) {}

  std::size_t size() const override { return started_; }

  void start(int x, int y, std::uint64_t net, std::uint64_t index) override {
    const std::size_t i = started_++;
    pixel_x_[i] = x;
    pixel_y_[i] = y;
    now_->random.state[i] = net;
    now_->random.constant[i] = index;
  }

  std::span<const Rgbf> trace(PathCounters& counters) override {
    launch();
    const std::size_t paths = now_->count;
    for (int depth = 1; within(depth) && now_->count > 0; ++depth) {
      (depth == 1 ? counters.camera_rays : counters.bounce_rays) += now_->count;
      scene_.intersect(now_->rays, now_->count, hits_);
      add_emission(depth);
      if (!within(depth + 1)) break;
      shade(depth, counters);
      std::swap(now_, next_);
    }
    return {radiance_.data(), paths};
  }

 private:
  /// Paths on their way to their next vertex, by octant.
  struct Flight {
    std::size_t count = 0;
    RayLanes rays;
    RgbLanes throughput;
    Lanes<float> scale, pdf_w;
    Vec3Lanes ref;  // vertex behind
    IndexLanes path;
    RandomLanes<Source> random;
  };

  [[gnu::flatten]] void launch() {
    Flight& now = *now_;
    now.count = std::exchange(started_, 0);
    const Camera camera = scene_.camera();
    const std::uint64_t seed = seed_;
    for (std::size_t i = 0; i < now.count; ++i) {
      Source random(seed, now.random.state[i], now.random.constant[i]);
      const Ray ray = camera.ray(pixel_x_[i], pixel_y_[i], random.next_2d());
      now.rays.origin.set(i, ray.origin);
      now.rays.direction.set(i, ray.direction);
      now.random.state[i] = random.state()[0];
      now.random.constant[i] = random.state()[1];
    }
    for (std::size_t i = 0; i < now.count; ++i) {
      now.rays.t_max[i] = std::numeric_limits<float>::infinity();
      now.throughput.set(i, {1, 1, 1});
      now.scale[i] = 1;
      now.path[i] = static_cast<std::uint32_t>(i);
      radiance_[i] = {};
    }
  }

  bool within(int depth) const { return options_.max_depth < 0 || depth <= options_.max_depth; }
  bool samples_light() const { return options_.strategy != Strategy::bsdf; }
  bool samples_bsdf() const { return options_.strategy != Strategy::light; }

  /// Emission is rare among the ends of rays, so it is looked at one by one.
  void add_emission(int depth) {
    const Techniques techniques{.n_bsdf = samples_bsdf() ? 1.0f : 0.0f,
                                .n_light = samples_light() ? 1.0f : 0.0f,
                                .draw_bsdf = samples_bsdf(),
                                .draw_light = samples_light()};
    for (std::size_t i = 0; i < now_->count; ++i) {
      const std::uint32_t light = light_at_end(i);
      if (light == kNoLight) continue;
      const Vec3f direction = now_->rays.direction[i];
      Rgbf radiance = renderer::radiance(scene_.lights()[light], direction);
      if (depth > 1) {
        const float pdf_w = now_->pdf_w[i];
        const Arrival arrival{techniques, pdf_w == 0, pdf_w, now_->ref[i]};
        radiance = radiance * arrival_weight(options_, scene_.lights(), arrival, light, direction);
      }
      radiance_[now_->path[i]] += now_->throughput[i] * radiance;
    }
  }

  std::uint32_t light_at_end(std::size_t i) const {
    return hits_.bsdf[i] == kNoHit ? scene_.environment() : hits_.light[i];
  }

  void shade(int depth, PathCounters& counters) {
    choose_lights();
    gather_vertices();
    to_local(s_);
    if (samples_light()) {
      for_each_bsdf([&](std::uint32_t bsdf, Run run) { sample_lights(bsdf, run, counters); });
      weigh_lights(options_, s_);
      cast_shadows(counters);
    }
    random_.draw({0, s_.count}, s_.u, s_.v);
    for_each_bsdf([&](std::uint32_t bsdf, Run run) {
      // Nothing left that the continued path could find.
      if (!samples_bsdf() && !scene_.bsdfs().parts(bsdf).atoms && !within(depth + 2)) {
        for (std::size_t k = run.first; k < run.end; ++k) s_.weight.set(k, {});
      } else {
        counters.rejected += sample_bsdf(scene_.bsdfs(), bsdf, s_, run);
      }
    });
    apply_samples(s_);
    if (depth >= options_.rr_depth) {
      std::fill_n(wanted_.begin(), s_.count, 1u);
      random_.draw(wanted_, s_.count, s_.u);
      roulette(s_);
    }
    continue_paths();
  }

  template <class Function>
  void for_each_bsdf(const Function& function) {
    for (std::size_t first = 0, end = 0; first < s_.count; first = end) {
      end = run_end(s_.bsdf, first, s_.count);
      function(s_.bsdf[first], Run{first, end});
    }
  }

  /// A path that asks no light draws no number for the choice.
  void choose_lights() {
    const LightSet& lights = scene_.lights();
    std::fill_n(chosen_.begin(), now_->count, 0u);
    std::fill_n(chosen_pmf_.begin(), now_->count, 1.0f);
    if (lights.size() < 2 || !samples_light()) return;
    for (std::size_t i = 0; i < now_->count; ++i) {
      const std::uint32_t bsdf = hits_.bsdf[i];
      wanted_[i] = bsdf != kNoHit && scene_.bsdfs().parts(bsdf).density ? 1 : 0;
    }
    now_->random.draw(wanted_, now_->count, s_.u);
    for (std::size_t i = 0; i < now_->count; ++i) {
      const auto choice = lights.choose(s_.u[i]);
      chosen_[i] = choice.index;
      chosen_pmf_[i] = choice.pmf;
    }
  }

  /// Sorts by BSDF and light where their pairs are few enough to count, else by BSDF.
  void gather_vertices() {
    const std::size_t bsdfs = scene_.bsdfs().size(), lights = scene_.lights().size();
    const std::size_t stride = bsdfs * lights <= kBatch ? std::max<std::size_t>(lights, 1) : 1;
    const std::size_t escaped = bsdfs * stride;
    for (std::size_t i = 0; i < now_->count; ++i) {
      const std::uint32_t bsdf = hits_.bsdf[i];
      const std::size_t light = stride > 1 ? chosen_[i] : 0;
      keys_[i] = static_cast<std::uint32_t>(bsdf == kNoHit ? escaped : bsdf * stride + light);
    }
    sort_.sort(keys_, now_->count, escaped + 1);
    const std::size_t count = sort_.begin(escaped);
    const IndexLanes& order = sort_.order();
    s_.count = count;
    gather(s_.bsdf, hits_.bsdf, order, count);
    gather(s_.light, chosen_, order, count);
    gather(s_.pmf, chosen_pmf_, order, count);
    gather(s_.position, hits_.position, order, count);
    gather(s_.normal, hits_.normal, order, count);
    gather(s_.offset, hits_.offset, order, count);
    gather(s_.wo, now_->rays.direction, order, count);
    gather(s_.throughput, now_->throughput, order, count);
    gather(s_.scale, now_->scale, order, count);
    gather(s_.path, now_->path, order, count);
    gather(random_, now_->random, order, count);
  }

  /// A light sample for each of the vertices of one BSDF.
  void sample_lights(std::uint32_t bsdf, Run run, PathCounters& counters) {
    const LightSet& lights = scene_.lights();
    const bool density = scene_.bsdfs().parts(bsdf).density;
    if (density) random_.draw(run, s_.u, s_.v);
    if (!density || lights.empty()) {
      for (std::size_t k = run.first; k < run.end; ++k) s_.pdf_light[k] = s_.mass[k] = 0;
      if (density) counters.rejected += run.end - run.first;
      return;
    }
    for (std::size_t first = run.first, end = 0; first < run.end; first = end) {
      end = run_end(s_.light, first, run.end);
      sample_light(lights[s_.light[first]], s_, {first, end});
    }
    for (std::size_t k = run.first; k < run.end; ++k) {
      counters.rejected += s_.pdf_light[k] > 0 || s_.mass[k] > 0 ? 0u : 1u;
    }
    evaluate(scene_.bsdfs(), bsdf, s_, run);
  }

  void cast_shadows(PathCounters& counters) {
    sort_.sort(s_.shadow_kind, s_.count, kKinds);
    const IndexLanes& order = sort_.order();
    const std::size_t count = sort_.begin(kUnblocked), lit = sort_.end(kUnblocked);
    counters.shadow_rays += lit;
    gather(shadow_.origin, s_.shadow_origin, order, count);
    gather(shadow_.direction, s_.to_light, order, count);
    gather(shadow_.t_max, s_.shadow_t_max, order, count);
    scene_.occluded(shadow_, count, blocked_);
    for (std::size_t i = 0; i < lit; ++i) {
      if (i < count && blocked_[i] != 0) continue;
      radiance_[s_.path[order[i]]] += s_.contribution[order[i]];
    }
  }

  void continue_paths() {
    go_on(s_);
    sort_.sort(s_.next_kind, s_.count, kKinds);
    const IndexLanes& order = sort_.order();
    const std::size_t count = sort_.end(kUnblocked);
    next_->count = count;
    gather(next_->rays.origin, s_.next_origin, order, count);
    gather(next_->rays.direction, s_.next_direction, order, count);
    std::fill_n(next_->rays.t_max.begin(), count, std::numeric_limits<float>::infinity());
    gather(next_->throughput, s_.throughput, order, count);
    gather(next_->scale, s_.scale, order, count);
    gather(next_->pdf_w, s_.pdf_w, order, count);
    gather(next_->ref, s_.position, order, count);
    gather(next_->path, s_.path, order, count);
    gather(next_->random, random_, order, count);
  }

  const Scene& scene_;
  const PathOptions& options_;
  std::uint64_t seed_;
  std::size_t started_ = 0;
  Lanes<int> pixel_x_, pixel_y_;
  Lanes<Rgbf> radiance_;
  Flight flights_[2];
  Flight *now_ = &flights_[0], *next_ = &flights_[1];
  HitLanes hits_;
  IndexLanes chosen_, wanted_, keys_;
  Lanes<float> chosen_pmf_;
  CountingSort sort_;
  Shading s_;
  RandomLanes<Source> random_;  // of the vertices in s_
  RayLanes shadow_;
  Lanes<std::uint8_t> blocked_;
};

}  // namespace

std::unique_ptr<BatchTracer> BatchTracer::make(const Scene& scene, const PathOptions& options,
                                               SamplerType sampler, std::uint64_t seed) {
  const bool one_of_each = options.strategy == Strategy::bsdf ||
                           options.strategy == Strategy::light ||
                           (options.strategy == Strategy::mis && options.bsdf_samples == 1 &&
                            options.light_samples == 1);
  if (!one_of_each) return nullptr;
  if (sampler == SamplerType::sobol)
    return std::make_unique<Batch<SobolSampler>>(scene, options, seed);
  return std::make_unique<Batch<Pcg32>>(scene, options, seed);
}

}  // namespace plumbline::renderer
