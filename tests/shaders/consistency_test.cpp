#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <plumbline/exchange/answerer.h>
#include <plumbline/renderer/core/bsdf/fresnel.h>
#include <plumbline/renderer/core/bsdf/ggx_conductor.h>
#include <plumbline/renderer/core/bsdf/ggx_dielectric.h>
#include <plumbline/renderer/core/bsdf/lambertian.h>
#include <plumbline/renderer/core/math.h>
#include <plumbline/verify/detail/random.h>

#include "shaders.h"

/// The renderer's BSDFs in C++ and those of examples/vulkan_glsl give the same: same rows in, same
/// directions, densities and weights out, but for rounding.
namespace plumbline::tests {
namespace {

using namespace renderer;

/// What rounding does between the inputs of a row and what comes out of it, in units of 2⁻²⁴: about
/// forty operations one after the other, of which five are quotients and roots, which Vulkan lets
/// be off by five units (2.5 ulp). That is 64 units at most, or twice √64 where their signs are as
/// good as random.
constexpr double kRounding = 16, kUnit = 0x1p-24;
/// A row whose tolerance is a larger share of the value than this, next to a zero, a border of the
/// choice of a lobe or a critical angle, shows nothing.
constexpr double kUseless = 1e-3;
/// So many rows may be of that kind.
constexpr double kUselessShare = 0.05;
/// What rounding of constants (π, α, η, each at most squared) shifts all rows by, in units: the
/// rounding of rows averages out.
constexpr double kShift = 8;
constexpr std::size_t kRows = 4000;

/// wo, and wi or random numbers.
using Row = std::array<double, 6>;

/// Values of a row, and the size that rounding of each is relative to; none where there is no
/// sample.
struct Values {
  std::vector<double> value, size;

  void add(double v) { value.push_back(v), size.push_back(std::abs(v)); }
  void add_direction(const std::array<double, 3>& w) {
    for (const double v : w) value.push_back(v), size.push_back(1);
  }
};

template <class T>
Vec3<T> first(const Row& row) {
  return {T(row[0]), T(row[1]), T(row[2])};
}
template <class T>
Vec3<T> second(const Row& row) {
  return {T(row[3]), T(row[4]), T(row[5])};
}

/// One of the renderer's as it is.
template <class B>
struct AsItIs {
  B bsdf;

  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec3<T>& u) const {
    return bsdf.sample(wo, Vec2<T>{u.x, u.y});
  }
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return bsdf.pdf(wo, wi);
  }
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return bsdf.eval(wo, wi);
  }
};

/// The renderer's rough glass, its lobe chosen by Fresnel's term F of the normal, as Walter et al.
/// 2007 do and the shader does, where the renderer takes a table over cosθo.
struct ChosenByFresnel {
  GgxDielectric bsdf;

  template <class T>
  std::optional<BsdfSample<T>> sample(const Vec3<T>& wo, const Vec3<T>& u) const {
    const Vec3<T> up{wo.x, wo.y, std::abs(wo.z)};
    const auto normal = bsdf.ggx.sample_visible(up, Vec2<T>{u.x, u.y});
    // The cosine as the renderer forms it: next to the critical angle it is of double's digits.
    using W = Wide<T>;
    const W along =
        wo.z > T(0) ? W(normal.cosine) : dot(vec_cast<W>(up), vec_cast<W>(normal.normal));
    const W cos2 = std::min(W(sqr(along) / length_squared(vec_cast<W>(normal.normal))), W(1));
    const auto split = bsdf.interface.template split<T>(cos2, wo.z > T(0));
    const std::uint32_t lobe = u.z < split.reflected ? 0 : 1;
    const T probability = lobe == 0 ? split.reflected : split.transmitted;
    auto sample = bsdf.sample_lobe(wo, lobe, Vec2<T>{u.x, u.y});
    if (!sample) return sample;
    sample->weight = sample->weight * T(T(1) / probability);
    sample->pdf_w *= probability;
    return sample;
  }

  /// f = F G1(wi)/cosθi pdf of the lobe, and (1 − F)/η² in the place of F: GgxDielectric.
  template <class T>
  T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const {
    const T refracted = static_cast<T>(sqr(relative_index<T>(bsdf.interface.eta, wo.z > T(0))));
    const T scale = wo.z * wi.z > T(0) ? T(1) : refracted;
    return bsdf.eval(wo, wi).g * T(scale * bsdf.ggx.visible_area(wi) / T(2));
  }
  template <class T>
  Rgb<T> eval(const Vec3<T>& wo, const Vec3<T>& wi) const {
    return bsdf.eval(wo, wi);
  }
};

template <class T, class B>
Values sample_at(const B& bsdf, const Row& row) {
  Values values;
  if (const auto s = bsdf.sample(first<T>(row), second<T>(row))) {
    values.add_direction({double{s->wi.x}, double{s->wi.y}, double{s->wi.z}});
    for (const T w : {s->weight.r, s->weight.g, s->weight.b}) values.add(double{w});
  }
  return values;
}

template <class T, class B>
Values pdf_at(const B& bsdf, const Row& row) {
  Values values;
  values.add(double{bsdf.pdf(first<T>(row), second<T>(row))});
  return values;
}

template <class T, class B>
Values eval_at(const B& bsdf, const Row& row) {
  Values values;
  const Rgb<T> f = bsdf.eval(first<T>(row), second<T>(row));
  for (const T v : {f.r, f.g, f.b}) values.add(double{v});
  return values;
}

/// How far a value may be off, for each: as far as it moves where every input moves by
/// kRounding units, and as many units itself.
///
/// @param at        the values of a row, in double
/// @param absolute  how many of the inputs are coordinates of unit vectors: their unit is that of 1
/// @return          infinite where a sample comes or goes
template <class At>
std::vector<double> tolerances(const At& at, const Row& row, const Values& truth,
                               std::size_t absolute) {
  std::vector<double> tolerance;
  for (const double size : truth.size) tolerance.push_back(kRounding * kUnit * size);
  for (std::size_t i = 0; i < row.size(); ++i) {
    std::vector<double> moves(truth.value.size());
    for (const double sign : {-1.0, 1.0}) {
      Row moved = row;
      moved[i] += sign * kRounding * kUnit * (i < absolute ? 1 : row[i]);
      const Values there = at(moved);
      for (std::size_t k = 0; k < moves.size(); ++k) {
        const double move = there.value.size() == truth.value.size()
                                ? std::abs(there.value[k] - truth.value[k])
                                : std::numeric_limits<double>::infinity();
        moves[k] = std::max(moves[k], move);
      }
    }
    for (std::size_t k = 0; k < moves.size(); ++k) tolerance[k] += moves[k];
  }
  return tolerance;
}

/// What was seen of one function in both languages.
struct Seen {
  std::size_t values = 0, useless = 0, missing = 0;  // missing: one of both had no sample
  double of_tolerance = 0;        ///< largest error of the shader, as a share of its tolerance
  double of_float_tolerance = 0;  ///< the same against C++ in float
  double units = 0;               ///< largest difference of both in float, in units of the size
  double sum = 0;                 ///< of (shader − double)/size

  double shift() const { return sum / static_cast<double>(values) / kUnit; }
};

/// @param table  relative error that the renderer's float allows itself
void compare(const Values& shader, const Values& in_float, const Values& truth,
             const std::vector<double>& tolerance, double table, Seen& seen) {
  for (std::size_t k = 0; k < truth.value.size(); ++k) {
    const double size = truth.size[k];
    if (!(tolerance[k] <= kUseless * size)) {
      // Also where nothing is to come, and nothing does.
      if (size > 0 || !(shader.value.size() == truth.value.size() && shader.value[k] == 0)) {
        ++seen.useless;
      }
      continue;
    }
    ++seen.values;
    if (shader.value.size() != truth.value.size() || in_float.value.size() != truth.value.size()) {
      ++seen.missing;
      continue;
    }
    const double off = shader.value[k] - truth.value[k];
    const double apart = std::abs(shader.value[k] - in_float.value[k]);
    seen.of_tolerance = std::max(seen.of_tolerance, std::abs(off) / tolerance[k]);
    seen.of_float_tolerance =
        std::max(seen.of_float_tolerance, apart / (2 * tolerance[k] + table * size));
    seen.units = std::max(seen.units, apart / size / kUnit);
    seen.sum += off / size;
  }
}

std::vector<verify::Vec3> columns(const std::vector<Row>& rows, std::size_t from) {
  std::vector<verify::Vec3> vectors;
  for (const Row& row : rows) vectors.push_back({row[from], row[from + 1], row[from + 2]});
  return vectors;
}

std::vector<Values> samples_of(exchange::Answerer& host, const std::vector<Row>& rows) {
  std::vector<std::optional<verify::SampleRecord>> records(rows.size());
  host.sample(columns(rows, 0), columns(rows, 3), records);
  std::vector<Values> values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!records[i]) continue;
    values[i].add_direction(records[i]->x);
    for (std::size_t k = 0; k < 3; ++k) values[i].add(records[i]->weight[k]);
  }
  return values;
}

std::vector<Values> pdfs_of(exchange::Answerer& host, const std::vector<Row>& rows) {
  std::vector<double> pdfs(rows.size());
  host.pdf(columns(rows, 0), columns(rows, 3), pdfs);
  std::vector<Values> values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) values[i].add(pdfs[i]);
  return values;
}

std::vector<Values> evals_of(exchange::Answerer& host, const std::vector<Row>& rows) {
  std::vector<verify::Channels> f(rows.size());
  host.eval(columns(rows, 0), columns(rows, 3), f);
  std::vector<Values> values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[i].add(f[i][k]);
  }
  return values;
}

/// Directions to look from, 6° or more above the surface, or below it too; with random numbers.
std::vector<Row> random_rows(verify::Random& random, bool both_sides) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < kRows; ++i) {
    const double cosine = 0.1 + 0.9 * random.uniform(), sine = std::sqrt(1 - cosine * cosine);
    const double phi = 2 * std::numbers::pi * random.uniform();
    const double side = both_sides && random.uniform() < 0.5 ? -1 : 1;
    Row row{sine * std::cos(phi), sine * std::sin(phi), side * cosine};
    for (double& x : row) x = static_cast<float>(x);
    for (std::size_t k = 3; k < 6; ++k) row[k] = double{random.uniform_float()};
    rows.push_back(row);
  }
  return rows;
}

/// The same with directions in the place of numbers: the samples where there are any, else wo.
template <class B>
std::vector<Row> with_directions(const B& bsdf, std::vector<Row> rows) {
  for (Row& row : rows) {
    const auto sample = bsdf.sample(first<float>(row), second<float>(row));
    const Vec3f wi = sample ? sample->wi : first<float>(row);
    row[3] = double{wi.x}, row[4] = double{wi.y}, row[5] = double{wi.z};
  }
  return rows;
}

/// What all three functions of a shader and a BSDF of the renderer have apart.
template <class B>
std::array<Seen, 3> compare_all(const std::string& module, const B& bsdf, bool both_sides,
                                double table) {
  const auto host = start_host(module);
  verify::Random random(check_seed("consistency " + module));
  const std::vector<Row> rows = random_rows(random, both_sides);
  const std::vector<Row> pairs = with_directions(bsdf, rows);
  const auto samples = samples_of(*host, rows), pdfs = pdfs_of(*host, pairs),
             evals = evals_of(*host, pairs);
  std::array<Seen, 3> seen;
  const auto judge = [&](const Row& row, const Values& shader, const auto& in_double,
                         const Values& in_float, std::size_t absolute, Seen& of) {
    const Values truth = in_double(row);
    compare(shader, in_float, truth, tolerances(in_double, row, truth, absolute), table, of);
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    judge(
        rows[i], samples[i], [&](const Row& r) { return sample_at<double>(bsdf, r); },
        sample_at<float>(bsdf, rows[i]), 3, seen[0]);
    judge(
        pairs[i], pdfs[i], [&](const Row& r) { return pdf_at<double>(bsdf, r); },
        pdf_at<float>(bsdf, pairs[i]), 6, seen[1]);
    judge(
        pairs[i], evals[i], [&](const Row& r) { return eval_at<double>(bsdf, r); },
        eval_at<float>(bsdf, pairs[i]), 6, seen[2]);
  }
  EXPECT_EQ(host->finish(), "");
  return seen;
}

bool consistent(const Seen& seen) {
  return seen.missing == 0 && seen.of_tolerance <= 1 && seen.of_float_tolerance <= 1 &&
         std::abs(seen.shift()) <= kShift;
}

std::string shown(const Seen& seen) {
  return std::to_string(seen.values) + " values, " + std::to_string(seen.useless) +
         " ill-conditioned, " + std::to_string(seen.missing) + " without a sample in one; " +
         std::to_string(seen.of_tolerance) + " of the tolerance, against float " +
         std::to_string(seen.of_float_tolerance) + "; " + std::to_string(seen.units) +
         " units apart, shifted by " + std::to_string(seen.shift());
}

void expect_consistent(const std::array<Seen, 3>& all) {
  constexpr std::array kFunctions{"sample", "pdf", "eval"};
  for (std::size_t i = 0; i < 3; ++i) {
    testing::Test::RecordProperty(kFunctions[i], shown(all[i]));
    EXPECT_TRUE(consistent(all[i])) << kFunctions[i] << ": " << shown(all[i]);
    const auto useless = static_cast<double>(all[i].useless);
    EXPECT_LE(useless, kUselessShare * (useless + static_cast<double>(all[i].values)))
        << kFunctions[i] << ": " << shown(all[i]);
  }
}

const AsItIs<Lambertian> kLambertian{{{0.5f, 0.2f, 0.8f}}};
const ChosenByFresnel kGlass{GgxDielectric({0.3f, 0.5f}, {1.5f})};

const AsItIs<GgxConductor>& gold() {
  static const AsItIs<GgxConductor> bsdf{
      {{0.2f, 0.4f}, ConductorFresnel({0.18f, 0.42f, 1.37f}, {3.42f, 2.35f, 1.77f})}};
  return bsdf;
}
/// In float the renderer takes the reflectance of metals from a table: ReflectanceTable.
constexpr double kTable = 1e-5;

TEST(ShaderAndRenderer, AgreeOnLambertian) {
  expect_consistent(compare_all("lambertian", kLambertian, false, 0));
}

TEST(ShaderAndRenderer, AgreeOnRoughGold) {
  expect_consistent(compare_all("ggx", gold(), false, kTable));
}

TEST(ShaderAndRenderer, AgreeOnRoughGlassFromBothSides) {
  expect_consistent(compare_all("rough_glass", kGlass, true, 0));
}

TEST(ShaderAndRenderer, FaultsAreFound) {
  EXPECT_FALSE(consistent(compare_all("lambertian_1", kLambertian, false, 0)[1]));
  EXPECT_FALSE(consistent(compare_all("ggx_2", gold(), false, kTable)[2]));
  const auto glass = compare_all("rough_glass_2", kGlass, true, 0);
  EXPECT_FALSE(consistent(glass[0])) << "the weight";
  EXPECT_FALSE(consistent(glass[2]));
}

TEST(ShaderAndRenderer, AConstantThatIsOffByAMillionthIsFound) {
  const auto coarse = compare_all("ggx_coarse", gold(), false, kTable);
  EXPECT_FALSE(consistent(coarse[1])) << shown(coarse[1]);
  EXPECT_FALSE(consistent(coarse[2])) << shown(coarse[2]);
}

}  // namespace
}  // namespace plumbline::tests
