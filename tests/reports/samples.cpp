#include "samples.h"

#include <limits>

namespace plumbline::tests {

verify::CheckResult sample_check() {
  verify::CheckResult check;
  check.kind = verify::CheckKind::mean;
  check.subject = "furnace_sphere/mis/power";
  check.verdict = verify::Verdict::fail;
  check.expected = verify::Verdict::inconclusive;
  check.estimate = 1.0 / 3;
  check.reference = 0.25;
  check.tolerance = 5e-3;
  check.bound = 1.5e-3;
  check.detectable = 2.5e-3;
  check.p_value = 1e-300;
  check.interval = {-0.125, 0.375};
  check.samples = 9'007'199'254'740'993;  // 2^53 + 1, which a double cannot hold
  check.seconds = 0.75;
  check.leaned_on = "exact variance";
  check.reason = "the bias is proven";
  check.diagnosis = "observed/expected = 2: factor?";
  check.advice = "state break lines";
  check.waived = "known (until 2027-01-31)";
  check.seed = 18'446'744'073'709'551'615u;
  check.replay = "ctest -R '^A\\.B$'";
  check.bins = {{{0, 0.5}, {0.25, 1}, 10.5, 0.125, 12}, {{0.5, 1}, {0, 1}, 1, 0, 0}};
  check.figures = {{verify::Figure::bins, 4096}, {"a \"quoted\" name", 0.5}};
  return check;
}

reports::RunEnvironment sample_environment() {
  reports::RunEnvironment environment;
  environment.version = "1.2.3";
  environment.commit = "0123456789abcdef";
  environment.dirty = true;
  environment.compiler = "g++ 12";
  environment.flags = "Release -O3";
  environment.cpu = "a processor";
  environment.cores = 2;
  environment.system = "Linux";
  environment.load_average = 0.5;
  environment.time = "2024-02-29T12:00:00Z";
  environment.libraries = {{"embree", "3.13.5"}};
  return environment;
}

reports::RenderRecord sample_render() {
  reports::RenderRecord render;
  render.scene = "furnace_sphere";
  render.strategy = "mis";
  render.heuristic = "power";
  render.samples_per_pixel = 64;
  render.adaptive = true;
  render.first_sample = 128;
  render.end_sample = 192;
  render.seconds = 1.5;
  render.camera_rays = 1;
  render.bounce_rays = 2;
  render.shadow_rays = 3;
  render.rejected = 4;
  render.non_finite = 5;
  render.mean = {0.5, 0.25, 0.125};
  render.seed = 18'446'744'073'709'551'614u;
  render.sampler = "sobol";
  render.replicates = 4;
  render.light_selection = "power";
  render.accelerator = "embree";
  render.version = "1.2.3";
  render.max_depth = 7;
  render.width = 192;
  render.height = 144;
  render.threads = 8;
  render.image = "images/a.exr";
  render.parameters = {{"albedo", "0.5"}, {"le", "2"}};
  return render;
}

reports::SpeedPoint sample_speed_point() {
  reports::SpeedPoint point;
  point.scene = "small_light";
  point.strategy = "one-sample";
  point.heuristic = "balance";
  point.sampler = "independent";
  point.samples_per_pixel = 16;
  point.seconds = 0.25;
  point.rays = 1'000'000;
  point.rel_mse = 0.04;
  point.rel_mse_low = 0.03;
  point.rel_mse_high = 0.05;
  point.replicates = 12;
  return point;
}

reports::RayCost sample_ray_cost() {
  reports::RayCost cost;
  cost.scene = "small_light";
  cost.rays = "as rendered";
  cost.occluded_fraction = 0.375;
  cost.width = 16;
  cost.count = 100'000;
  cost.intersect_ns = 120;
  cost.occluded_ns = 90;
  cost.ratio = 0.75;
  cost.ratio_low = 0.7;
  cost.ratio_high = 0.8;
  return cost;
}

reports::Bar sample_bar() {
  reports::Bar bar;
  bar.name = "equal error";
  bar.unit = "relMSE × s";
  bar.at_least = true;
  bar.limit = 2.5;
  bar.measured = 2;
  bar.low = 1.75;
  bar.high = 2.25;
  bar.indicative = true;
  bar.comparison = "another renderer: 20";
  bar.note = "16 replicates";
  return bar;
}

reports::StabilityRecord sample_stability_record() {
  reports::StabilityRecord record;
  record.bsdf = "GgxDielectric/eta 1.01 alpha 0.3";
  record.function = "weight";
  record.points = 10'000;
  record.error = 2.5e-5;
  record.tolerance = 1e-3;
  record.place = "wo (0, 0, 1), u (0.5, 0.25)";
  record.ill_conditioned = 12;
  record.ill_conditioned_error = 0.125;
  record.condition = 3e5;
  record.ill_conditioned_place = "wo (1, 0, 0), u (0, 0.75)";
  return record;
}

reports::CausesRecord sample_causes_record() {
  reports::CausesRecord record;
  record.set = "third";
  record.seed = 18'446'744'073'709'551'613u;
  record.twins = {{"ggx/pdf half", "pdf has a factor of 1/2", "constant", "constant", true},
                  {"ggx/frame", "any tangent", "tangent frame", "shifted", true},
                  {"coat/weight", "a wrong power of the index", "Fresnel", "", false}};
  return record;
}

reports::DuetRecord sample_duet_record() {
  reports::DuetRecord record;
  record.part = "bsdf-sample/ggx_conductor";
  record.revision_a = "0123456789abcdef0123456789abcdef01234567";
  record.revision_b = "0123456789abcdef0123456789abcdef01234567+";
  record.identical_code = true;
  record.confidence = 0.999;
  record.ratio = 1.03125;
  record.low = 1.015625;
  record.high = 1.0625;
  record.a_seconds = {0.25, 0.125};
  record.b_seconds = {0.5, 0.0625};
  record.counters_a = {{"rays", 12}, {"result", 18'446'744'073'709'551'613u}};
  record.counters_b = {{"rays", 13}};
  return record;
}

reports::Figure sample_figure() {
  reports::Figure figure;
  figure.group = "Integrals with known answers";
  figure.title = "Error against samples";
  figure.caption = "The dashed line is exact.";
  figure.x = {"samples", true};
  figure.y = {"error", false};
  figure.series = {
      {"mis", reports::SeriesStyle::points, {1, 2, 4}, {3, 2, 1}, {2, 1, 0}, {4, 3, 2}},
      {"exact", reports::SeriesStyle::dashed, {1, 4}, {3, 1}, {}, {}},
  };
  return figure;
}

reports::Table sample_table() {
  reports::Table table;
  table.group = "Integrals with known answers";
  table.title = "Efficiency";
  table.caption = "Larger is better.";
  table.columns = {"method", "MSE"};
  table.rows = {{"equal", "1"}, {"root", "1.25"}};
  return table;
}

reports::Distribution sample_distribution() {
  return {"speed/veach", "samples/s", false, {1.5, 2, 2.5}};
}

reports::Counter sample_counter() { return {"rays", "rays of a path", 12'345'678'901}; }

reports::SeedRun sample_seed_run() {
  return {18'446'744'073'709'551'614u, "0123abcd-dirty", "2024-03-02T12:00:00Z", 2500, {"A.B"}};
}

reports::HistoryRecord sample_history() {
  constexpr double kMissing =
      std::numeric_limits<double>::infinity();  // NaN is not equal to itself
  reports::HistoryRecord record;
  record.machine = "a processor x 2, g++, -O3";
  record.kind = "nightly";
  record.nights = {{1, "2024-03-01T12:00:00Z", "abc", true, "01", 10, 2, 3, 4, 5, 6, {}},
                   {7,
                    "2024-03-02T12:00:00Z",
                    "def",
                    false,
                    "02",
                    11,
                    12,
                    13,
                    14,
                    15,
                    16,
                    {{"mutants", reports::PartStatus::timed_out, 90.5, "ended"}}}};
  reports::HistoryChange change;
  change.drift = change.regression = true;
  change.first_night = 0;
  change.last_night = 1;
  change.commit_before = "a";
  change.commit_first = "b";
  change.commit_last = "c";
  change.before = 1.5;
  change.after = 2.5;
  change.relative = 0.625;
  change.low = 0.5;
  change.high = 0.75;
  change.means_p_value = 0.001;
  change.distribution_p_value = 0.002;
  record.numbers = {
      {"cost", "ns", true, false, {1, 2}, {0.5, kMissing}, {1.5, 2.5}, {change}, {1}}};
  record.sequences = {{verify::CheckKind::chi_square,
                       "a/b",
                       verify::Verdict::fail,
                       2,
                       0.25,
                       {0.125, kMissing},
                       {-1, 3},
                       "refuted"}};
  record.failing_gate_runs = {sample_seed_run()};
  return record;
}

}  // namespace plumbline::tests
