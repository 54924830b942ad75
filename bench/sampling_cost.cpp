#include <benchmark/benchmark.h>

#include <plumbline/renderer/bsdf/bsdf.h>
#include <plumbline/renderer/light/light.h>
#include <plumbline/renderer/sampling/sampler.h>

/// Nanoseconds per sample, pdf and eval, as rendered: in float, through the variant.
namespace plumbline::renderer {
namespace {

const BsdfSet kBsdfs({Lambertian{{0.5f, 0.5f, 0.5f}}});
const Vec3f kWo = normalize(Vec3f{0.3f, 0.2f, 0.8f});

void bsdf_sample(benchmark::State& state, std::uint32_t bsdf) {
  Pcg32 random(1, 0, 0);
  for (auto _ : state) benchmark::DoNotOptimize(kBsdfs.sample(bsdf, kWo, random.next_2d()));
}

void bsdf_eval_and_pdf(benchmark::State& state, std::uint32_t bsdf) {
  Pcg32 random(1, 0, 0);
  for (auto _ : state) {
    const Vec3f wi = square_to_uniform_hemisphere(random.next_2d());
    benchmark::DoNotOptimize(kBsdfs.eval(bsdf, kWo, wi));
    benchmark::DoNotOptimize(kBsdfs.pdf(bsdf, kWo, wi));
  }
}

const Rgbf kWhite{1, 1, 1};
const Light kSphere = SphereLight{{0, 0, 2}, 0.5f, false, kWhite};
const Light kRectangle = RectangleLight{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}, kWhite};
const Light kDisk = DiskLight{{0, 0, 2}, {0, 0, -1}, 1, kWhite};
const Light kTriangle = TriangleLight{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}, kWhite};
const Light kEnvironment = ConstantEnvironment{kWhite};

void light_sample(benchmark::State& state, const Light& light) {
  Pcg32 random(1, 0, 0);
  for (auto _ : state) benchmark::DoNotOptimize(sample(light, Vec3f{}, random.next_2d()));
}

void light_pdf(benchmark::State& state, const Light& light) {
  Pcg32 random(1, 0, 0);
  for (auto _ : state) {
    const Vec3f wi = square_to_uniform_hemisphere(random.next_2d());
    benchmark::DoNotOptimize(pdf(light, Vec3f{}, wi));
  }
}

/// Two numbers, through the variant. What starting a sample costs is spread over the 16 pairs of a
/// path.
void random_pair(benchmark::State& state, SamplerType type) {
  std::uint64_t sample = 0;
  constexpr int kPairs = 16;
  while (state.KeepRunningBatch(kPairs)) {
    Sampler random(type, 1, 0, sample++);
    for (int i = 0; i < kPairs; ++i) benchmark::DoNotOptimize(random.next_2d());
  }
}

BENCHMARK_CAPTURE(random_pair, independent, SamplerType::independent);
BENCHMARK_CAPTURE(random_pair, sobol, SamplerType::sobol);
BENCHMARK_CAPTURE(bsdf_sample, lambertian, 0);
BENCHMARK_CAPTURE(bsdf_eval_and_pdf, lambertian, 0);
BENCHMARK_CAPTURE(light_sample, sphere, kSphere);
BENCHMARK_CAPTURE(light_pdf, sphere, kSphere);
BENCHMARK_CAPTURE(light_sample, rectangle, kRectangle);
BENCHMARK_CAPTURE(light_pdf, rectangle, kRectangle);
BENCHMARK_CAPTURE(light_sample, disk, kDisk);
BENCHMARK_CAPTURE(light_pdf, disk, kDisk);
BENCHMARK_CAPTURE(light_sample, triangle, kTriangle);
BENCHMARK_CAPTURE(light_pdf, triangle, kTriangle);
BENCHMARK_CAPTURE(light_sample, environment, kEnvironment);

}  // namespace
}  // namespace plumbline::renderer
