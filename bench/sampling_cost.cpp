#include <benchmark/benchmark.h>

#include <plumbline/renderer/assembly/bsdf.h>
#include <plumbline/renderer/core/light/light.h>
#include <plumbline/renderer/core/sampling/sampler.h>

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
    benchmark::DoNotOptimize(kBsdfs[bsdf].eval(kWo, wi));
    benchmark::DoNotOptimize(kBsdfs[bsdf].pdf(kWo, wi));
  }
}

const Rgbf kWhite{1, 1, 1};
const Light kSphere = SphereLight{{0, 0, 2}, 0.5f, false, kWhite};
const Light kRectangle = RectangleLight{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}, kWhite};
const Light kDisk = DiskLight{{0, 0, 2}, {0, 0, -1}, 1, kWhite};
const Light kTriangle = TriangleLight{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}, kWhite};
const Light kEnvironment = ConstantEnvironment{kWhite};
const Light kSun = SunAndSky::make({0, 0, 1}, 0.005, kWhite, kWhite);
const Light kPoint = PointLight{{0, 0, 2}, kWhite};

/// Sampled by the solid angle that it subtends.
template <class L>
Light by_solid_angle(const Light& light) {
  auto copy = std::get<L>(light);
  copy.by_solid_angle = true;
  return copy;
}

const Light kSphericalRectangle = by_solid_angle<RectangleLight>(kRectangle);
const Light kSphericalTriangle = by_solid_angle<TriangleLight>(kTriangle);

/// 1024 by 512 pixels of noise, as many choices as an outdoor map has.
Light noise_map() {
  Pcg32 random(2, 0, 0);
  std::vector<Rgbf> pixels(std::size_t{1024} * 512);
  for (Rgbf& pixel : pixels) pixel = kWhite * random.next_1d();
  return EnvironmentMap{std::make_shared<EnvironmentTable>(1024, 512, std::move(pixels), false)};
}

const Light kMap = noise_map();

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

/// What an emitter shows in a direction; of the others it is a constant.
void light_eval(benchmark::State& state, const Light& light) {
  Pcg32 random(1, 0, 0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(radiance(light, square_to_uniform_hemisphere(random.next_2d())));
  }
}

/// Irradiance of a floor below the corner of a light, near it or far: what a sample costs, and as
/// the counter `variance` what it is worth, relative to the square of the mean.
void irradiance(benchmark::State& state, const Light& light, float distance) {
  Pcg32 random(1, 0, 0);
  const Vec3f reference{-1.2f, -1.2f, 2 - distance};
  double count = 0, sum = 0, squares = 0;
  for (auto _ : state) {
    const auto s = sample(light, reference, random.next_2d());
    const double x = s ? static_cast<double>(std::max(s->wi.z, 0.0f) / s->pdf_w) : 0;
    count += 1;
    sum += x;
    squares += x * x;
  }
  state.counters["variance"] = squares * count / (sum * sum) - 1;
}

/// A map of the square.
template <class Function>
void warp(benchmark::State& state, const Function& function) {
  Pcg32 random(1, 0, 0);
  for (auto _ : state) benchmark::DoNotOptimize(function(random.next_2d()));
}

/// A choice among `count` lights of different power.
void light_selection(benchmark::State& state, std::uint32_t count) {
  Pcg32 random(1, 0, 0);
  std::vector<double> weights(count);
  for (double& weight : weights) weight = static_cast<double>(random.next_1d());
  const DiscreteDistribution distribution(weights);
  for (auto _ : state) benchmark::DoNotOptimize(distribution.sample(random.next_1d()));
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
BENCHMARK_CAPTURE(light_sample, rectangle_by_solid_angle, kSphericalRectangle);
BENCHMARK_CAPTURE(light_pdf, rectangle_by_solid_angle, kSphericalRectangle);
BENCHMARK_CAPTURE(light_sample, triangle_by_solid_angle, kSphericalTriangle);
BENCHMARK_CAPTURE(light_pdf, triangle_by_solid_angle, kSphericalTriangle);
BENCHMARK_CAPTURE(light_sample, environment_map, kMap);
BENCHMARK_CAPTURE(light_pdf, environment_map, kMap);
BENCHMARK_CAPTURE(light_sample, sun_and_sky, kSun);
BENCHMARK_CAPTURE(light_pdf, sun_and_sky, kSun);
BENCHMARK_CAPTURE(light_eval, environment_map, kMap);
BENCHMARK_CAPTURE(light_eval, sun_and_sky, kSun);
BENCHMARK_CAPTURE(light_sample, point, kPoint);
BENCHMARK_CAPTURE(light_pdf, environment, kEnvironment);
BENCHMARK_CAPTURE(warp, cosine_hemisphere, square_to_cosine_hemisphere<float>);
BENCHMARK_CAPTURE(warp, uniform_hemisphere, square_to_uniform_hemisphere<float>);
BENCHMARK_CAPTURE(warp, uniform_sphere, square_to_uniform_sphere<float>);
BENCHMARK_CAPTURE(warp, uniform_disk, square_to_uniform_disk<float>);
BENCHMARK_CAPTURE(warp, uniform_triangle, square_to_uniform_triangle<float>);
BENCHMARK_CAPTURE(irradiance, rectangle_near, kRectangle, 0.2f);
BENCHMARK_CAPTURE(irradiance, rectangle_by_solid_angle_near, kSphericalRectangle, 0.2f);
BENCHMARK_CAPTURE(irradiance, rectangle_far, kRectangle, 4.0f);
BENCHMARK_CAPTURE(irradiance, rectangle_by_solid_angle_far, kSphericalRectangle, 4.0f);
BENCHMARK_CAPTURE(irradiance, triangle_near, kTriangle, 0.2f);
BENCHMARK_CAPTURE(irradiance, triangle_by_solid_angle_near, kSphericalTriangle, 0.2f);
BENCHMARK_CAPTURE(irradiance, triangle_far, kTriangle, 4.0f);
BENCHMARK_CAPTURE(irradiance, triangle_by_solid_angle_far, kSphericalTriangle, 4.0f);
BENCHMARK_CAPTURE(light_selection, 1, 1);
BENCHMARK_CAPTURE(light_selection, 5, 5);
BENCHMARK_CAPTURE(light_selection, 1000, 1000);

}  // namespace
}  // namespace plumbline::renderer
