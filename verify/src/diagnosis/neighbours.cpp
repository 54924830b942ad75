#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "diagnosis/ask.h"
#include "diagnosis/direct.h"
#include "streams.h"
#include "vec3.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kGroup = 8;

struct Valued {
  Vec3 x{};
  double logarithm = 0;  ///< of the ratio
  double numerator = 0;  ///< the record's pdf
};

std::vector<Valued> valued_samples(const ViewEvidence& view, bool of_weight) {
  constexpr std::size_t kSamples = 12'000;
  Random random = random_for(Stream::groups);
  std::vector<Valued> out;
  std::vector<Record> samples = draw_records(view, random, kSamples);
  std::erase_if(samples, [](const Record& s) { return !has_density(s); });
  const std::vector<Vec3> points = points_of_density(samples);
  const std::vector<double> pdfs = pdfs_at(view, points);
  const auto values = of_weight ? values_at(view, points) : std::vector<double>();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SampleRecord& s = *samples[i];
    const double stated = s.pdf.value_or(kNotApplicable);
    const double ratio = of_weight ? brightest(s.weight) * pdfs[i] / values[i] : stated / pdfs[i];
    if (ratio > 0 && std::isfinite(ratio)) out.push_back({s.x, std::log(ratio), stated});
  }
  return out;
}

/// Logarithms of a sample and its nearest ones, sorted.
std::array<double, kGroup> group_around(const std::vector<Valued>& all, std::size_t center) {
  std::vector<std::pair<double, double>> by_distance;
  by_distance.reserve(all.size());
  for (const Valued& v : all) {
    const Vec3 d = sum(v.x, scaled(all[center].x, -1));
    by_distance.emplace_back(dot(d, d), v.logarithm);
  }
  std::partial_sort(by_distance.begin(), by_distance.begin() + kGroup, by_distance.end());
  std::array<double, kGroup> values{};
  for (std::size_t i = 0; i < kGroup; ++i) values[i] = by_distance[i].second;
  std::sort(values.begin(), values.end());
  return values;
}

/// A good part of the records, and only a part, states the same multiple of cosθ, or the same
/// number, though pdf() does not: one lobe's own density.
bool states_one_lobe(const std::vector<Valued>& all, bool of_cosine) {
  constexpr double kSame = 1e-6;
  std::vector<double> logarithms;
  for (const Valued& v : all) {
    if (std::abs(v.logarithm) < kSame) continue;
    const double c = of_cosine ? std::abs(v.x[2]) : 1;
    if (c > 0 && v.numerator > 0) logarithms.push_back(std::log(v.numerator / c));
  }
  if (logarithms.size() < 100) return false;
  std::sort(logarithms.begin(), logarithms.end());
  std::size_t most = 0;
  for (std::size_t i = 0, j = 0; i < logarithms.size(); ++i) {
    while (logarithms[i] - logarithms[j] > kSame) ++j;
    most = std::max(most, i - j + 1);
  }
  const double share = static_cast<double>(most) / static_cast<double>(logarithms.size());
  return share > 0.03 && share < 0.97;
}

}  // namespace

Dependence dependence_of(const ReportEvidence& evidence, bool of_weight) {
  constexpr std::size_t kGroups = 200;
  // Two groups with little in between them; a smooth function spreads its values out.
  constexpr double kGap = 0.85;
  double uneven = 0, in_two = 0, groups = 0, scatter = 0, whole = 0;
  for (const ViewEvidence& v : evidence.views) {
    if (v.pair->domain.dimension() == 0) continue;
    const std::vector<Valued> all = valued_samples(v, of_weight);
    if (all.size() < 4 * kGroups) continue;
    if (!of_weight && v.pair->domain.directions() &&
        (states_one_lobe(all, true) || states_one_lobe(all, false))) {
      return Dependence::on_a_choice;
    }
    double low = 1e300, high = -1e300, total = 0;
    for (const Valued& a : all) {
      low = std::min(low, a.logarithm);
      high = std::max(high, a.logarithm);
    }
    const double unit = 4096 * v.pair->epsilon;
    if (high - low < unit) continue;
    for (std::size_t g = 0; g < kGroups; ++g) {
      const auto values = group_around(all, g * (all.size() / kGroups));
      const double range = values.back() - values.front();
      ++groups;
      total += range;
      if (range < unit) continue;
      ++uneven;
      double largest = 0;
      for (std::size_t i = 2; i + 1 < kGroup; ++i) {
        largest = std::max(largest, values[i] - values[i - 1]);
      }
      if (largest > kGap * range) ++in_two;
    }
    scatter += total / double(kGroups);
    whole += high - low;
    if (groups >= 4 * kGroups) break;
  }
  if (groups == 0 || uneven == 0) return Dependence::on_the_point;
  if (in_two > 0.3 * uneven && in_two > 0.1 * groups) return Dependence::on_a_choice;
  if (scatter > 0.3 * whole) return Dependence::on_the_last_bits;
  return Dependence::on_the_point;
}

std::size_t multiples_in_records(const ReportEvidence& evidence) {
  constexpr double kSame = 1e-5, kFewest = 5, kMostly = 0.8;
  constexpr std::size_t kMost = 64;
  for (const ViewEvidence& v : evidence.views) {
    if (!v.failed || v.pair->domain.dimension() == 0) continue;
    std::vector<double> logarithms;
    for (const Valued& s : valued_samples(v, false)) logarithms.push_back(s.logarithm);
    std::sort(logarithms.begin(), logarithms.end());
    std::size_t multiples = 0;
    double covered = 0, right = 0;
    for (std::size_t i = 0, j = 0; i < logarithms.size(); i = j) {
      while (j < logarithms.size() && logarithms[j] - logarithms[i] < kSame) ++j;
      const auto count = static_cast<double>(j - i);
      if (count < kFewest) continue;
      ++multiples;
      covered += count;
      if (std::abs(logarithms[i]) < kSame) right = count;
    }
    const auto all = static_cast<double>(logarithms.size());
    if (multiples < 2 || multiples > kMost || covered < kMostly * all || right > all / 2) return 0;
    return multiples;
  }
  return 0;
}

bool takes_more_at_times(const SamplingPair& pair) {
  if (!pair.draw) return false;
  constexpr int kSamples = 200, kMost = 64;
  Random random = random_for(Stream::consumed);
  int usual = -1;
  for (int i = 0; i < kSamples; ++i) {
    Random before = random;
    pair.draw(random);
    const std::uint64_t next = Random(random).bits();
    int taken = 0;
    while (taken < kMost && Random(before).bits() != next) {
      before.bits();
      ++taken;
    }
    if (usual >= 0 && taken != usual) return true;
    usual = taken;
  }
  return false;
}

namespace {

/// Across the plane of incidence, which contains the normal and wo.
double across(const Vec3& wo, const Vec3& x) { return wo[0] * x[1] - wo[1] * x[0]; }

bool is_symmetric(const ViewEvidence& view, const std::vector<Vec3>& points) {
  const Vec3& wo = *view.wo;
  const double r2 = wo[0] * wo[0] + wo[1] * wo[1];
  const auto turned = [](const Vec3& w) { return turned_around(w, {0, 0, 1}, 1.1); };
  double near = 0, tested = 0;
  for (const Vec3& x : points) {
    const double here = pdf_at(view, x);
    if (!(here > 0)) continue;
    const double a = across(wo, x) / r2;
    const Vec3 mirrored = {x[0] + 2 * a * wo[1], x[1] - 2 * a * wo[0], x[2]};
    const double there = pdf_at(view, mirrored);
    const double around = pdf_at(view, turned(wo), turned(x));
    ++tested;
    const double tolerance = 1e-3 * here;
    near += std::abs(there - here) < tolerance && std::abs(around - here) < tolerance ? 1 : 0;
  }
  return tested > 20 && near > 0.95 * tested;
}

}  // namespace

bool samples_break_a_symmetry(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 40'000;
  constexpr std::size_t kRings = 8;
  double statistic = 0;
  for (const ViewEvidence& v : evidence.views) {
    if (v.bsdf == nullptr || !has_wo(v)) continue;
    if (std::hypot((*v.wo)[0], (*v.wo)[1]) < 0.05) continue;
    Random random = random_for(Stream::sides);
    std::vector<Vec3> points = points_of_density(draw_records(v, random, kSamples));
    if (points.size() < 1000) continue;
    if (!is_symmetric(v, {points.begin(), points.begin() + 200})) return false;
    // By height, in rings of equal counts: left against right in each.
    std::sort(points.begin(), points.end(),
              [](const Vec3& a, const Vec3& b) { return a[2] < b[2]; });
    for (std::size_t k = 0; k < kRings; ++k) {
      const std::size_t from = k * points.size() / kRings, to = (k + 1) * points.size() / kRings;
      double left = 0;
      for (std::size_t i = from; i < to; ++i) left += across(*v.wo, points[i]) > 0 ? 1 : 0;
      const double n = static_cast<double>(to - from);
      const double z = (left - n / 2) / std::sqrt(n / 4);
      statistic = std::max(statistic, std::abs(z));
    }
  }
  constexpr double kCertain = 6;
  return statistic > kCertain;
}

double share_never_sampled(const ViewEvidence& view) {
  constexpr std::size_t kCells = 48;
  constexpr std::size_t kSamples = 100'000;
  constexpr std::size_t kSteps = 3;
  // A cell that expects so many stays empty by chance once in 5e8 times.
  constexpr double kMany = 20;
  const Domain& domain = view.pair->domain;
  if (domain.dimension() == 0) return 0;
  const Chart& chart = domain.chart();
  const auto cell_of = [](double c) {
    return std::min(kCells - 1, static_cast<std::size_t>(c * kCells));
  };
  std::vector<int> seen(kCells * kCells);
  Random random = random_for(Stream::empty_cells);
  for (const Vec3& x : points_of_density(draw_records(view, random, kSamples))) {
    const Point2 p = chart.to_square(x);
    ++seen[cell_of(p[0]) * kCells + (domain.dimension() == 1 ? 0 : cell_of(p[1]))];
  }
  double never = 0, total = 0;
  const std::size_t second = domain.dimension() == 1 ? 1 : kCells;
  for (std::size_t i = 0; i < kCells; ++i) {
    std::vector<Point2> places;
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < second * kSteps * kSteps; ++k) {
      const std::size_t column = k % kSteps, row = k / kSteps;
      const Point2& p = places.emplace_back(
          Point2{(static_cast<double>(i) + (static_cast<double>(column) + 0.5) / kSteps) / kCells,
                 (static_cast<double>(row) + 0.5) / static_cast<double>(second * kSteps)});
      points.push_back(chart.from_square(p));
    }
    const std::vector<double> pdfs = pdfs_at(view, points);
    for (std::size_t j = 0; j < second; ++j) {
      double mass = 0;
      for (std::size_t k = j * kSteps * kSteps; k < (j + 1) * kSteps * kSteps; ++k) {
        mass += pdfs[k] * chart.element(places[k]) /
                static_cast<double>(kSteps * kSteps * kCells * second);
      }
      total += mass;
      if (mass * double{kSamples} > kMany && seen[i * kCells + j] == 0) never += mass;
    }
  }
  return total > 0 ? never / total : 0;
}

}  // namespace plumbline::verify
