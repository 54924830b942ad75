#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/core/sampling/pcg32.h>
#include "plain_ggx.h"

/// Nanoseconds per sample, eval + pdf, and all three, of every BSDF as rendered (in float, through
/// the variant), interleaved with a plain GGX in the same run.
namespace plumbline::bench {
namespace {

using namespace renderer;

const ConductorFresnel kGold{{0.143119f, 0.374957f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}};

template <class B>
struct Timed {
  const char* name;
  B bsdf;
};
template <class B>
Timed(const char*, B) -> Timed<B>;

/// In the order of the set: a nested BSDF names its children by their place here.
const std::tuple kTimed{
    Timed{"lambertian", Lambertian{{0.5f, 0.5f, 0.5f}}},
    Timed{"modified_phong", ModifiedPhong{{1, 1, 1}, 50}},
    Timed{"ggx_conductor", GgxConductor{{0.3f, 0.3f}, {}}},
    Timed{"ggx_conductor_gold", GgxConductor{{0.3f, 0.3f}, kGold}},
    Timed{"ggx_dielectric", GgxDielectric{{0.3f, 0.3f}, {1.5f}}},
    Timed{"smooth_conductor", SmoothConductor{kGold}},
    Timed{"smooth_dielectric", SmoothDielectric{{1.5f}}},
    Timed{"clear_coat", ClearCoat(1.5f, 0.1f, {0.5f, 0.5f, 0.5f})},
    Timed{"thin_film_on_rough_gold", ThinFilm{GgxConductor{{0.3f, 0.3f}, kGold}, {300, 1.5f}}},
    Timed{"thin_film_on_rough_glass", ThinFilm{GgxDielectric{{0.3f, 0.3f}, {1.5f}}, {300, 1.3f}}},
    Timed{"two_sided", TwoSided{2, 2}},
    Timed{"mixture", Mixture{0, 2, 0.5f}}};

template <class B, class... T>
constexpr bool kIsOneOf = (... || std::is_same_v<B, T>);
template <class... B, class... T>
constexpr bool all_timed(const std::variant<B...>*, const std::tuple<Timed<T>...>*) {
  return (... && kIsOneOf<B, T...>);
}
static_assert(all_timed(static_cast<const Bsdf*>(nullptr), &kTimed),
              "a BSDF of the variant is not timed");

const BsdfSet& bsdfs() {
  static const BsdfSet set(
      std::apply([](const auto&... timed) { return std::vector<Bsdf>{timed.bsdf...}; }, kTimed));
  return set;
}

/// Directions and numbers that no branch predictor learns by heart.
struct Inputs {
  static constexpr std::size_t kCount = 4096;
  std::vector<Vec3f> wo, wi;
  std::vector<Vec2f> u;

  Inputs() {
    Pcg32 random(1, 0, 0);
    for (std::size_t i = 0; i < kCount; ++i) {
      wo.push_back(square_to_uniform_hemisphere(random.next_2d()));
      wi.push_back(square_to_uniform_hemisphere(random.next_2d()));
      u.push_back(random.next_2d());
    }
  }
};

const Inputs& inputs() {
  static const Inputs all;
  return all;
}

template <class Function>
void over_inputs(benchmark::State& state, const Function& function) {
  const Inputs& in = inputs();
  std::size_t i = 0;
  for (auto _ : state) {
    function(in.wo[i], in.wi[i], in.u[i]);
    i = (i + 1) % Inputs::kCount;
  }
}

template <class B>
void add(const std::string& name, const B& bsdf) {
  const auto add_one = [&name](const char* what, const auto& function) {
    benchmark::RegisterBenchmark(("bsdf_cost/" + name + "/" + what).c_str(),
                                 [function](benchmark::State& s) { over_inputs(s, function); });
  };
  const auto sample = [bsdf](const Vec3f& wo, const Vec3f&, const Vec2f& u) {
    benchmark::DoNotOptimize(bsdf.sample(wo, u));
  };
  const auto eval_pdf = [bsdf](const Vec3f& wo, const Vec3f& wi, const Vec2f&) {
    benchmark::DoNotOptimize(bsdf.evaluate(wo, wi));
  };
  add_one("sample", sample);
  add_one("pdf", [bsdf](const Vec3f& wo, const Vec3f& wi, const Vec2f&) {
    benchmark::DoNotOptimize(bsdf.pdf(wo, wi));
  });
  add_one("eval_pdf", eval_pdf);
  add_one("sample_eval_pdf", [sample, eval_pdf](const Vec3f& wo, const Vec3f& wi, const Vec2f& u) {
    sample(wo, wi, u);
    eval_pdf(wo, wi, u);
  });
}

bool add_all() {
  add("plain_ggx", PlainGgx{0.3f, {1, 1, 1}});
  std::uint32_t index = 0;
  std::apply([&index](const auto&... timed) { (add(timed.name, BsdfRef(bsdfs(), index++)), ...); },
             kTimed);
  return true;
}

[[maybe_unused]] const bool kAdded = add_all();

}  // namespace
}  // namespace plumbline::bench
