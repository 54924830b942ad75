#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <plumbline/verify/bsdf.h>
#include "examples.h"
#include "known_albedo.h"

/// `check_bsdf` on every BSDF, in double, as its users are told to call it: lobe by lobe, with the
/// albedo by quadrature.
namespace plumbline::tests {
namespace {

using namespace renderer;
using verify::CheckKind;

constexpr std::array kAngles{0.0, 60.0, 80.0, 88.0, 89.9};

/// Angles in front from which the mass stays known to a few thousandths only, after all evaluations
/// that are allowed: from a ridge 1e-4 wide that bends through the whole hemisphere, and a
/// refracted lobe that is a thousand times as wide as it is high, cut off at the critical angle 17
/// of its widths away.
bool beyond_cubature(const Example& example, double degrees) {
  return (example.name == "GgxConductor/alpha 1e-4, 1" && degrees >= 60) ||
         (example.name == "GgxDielectric/eta 1.5 alpha 1e-4" && degrees == 89.9);
}

/// One call of check_bsdf.
struct Look {
  std::vector<double> angles;
  bool front, back;
  std::size_t channel;  ///< whose albedo is held to the known one
  bool hard = false;    ///< beyond cubature
  bool reciprocal = false;
};

/// All angles: at night for every example, in the gate examples take turns; the channels take turns
/// from angle to angle, so that each costs a third of the cubatures. Hard angles on their own, so
/// that what they are allowed is allowed to them alone. Reciprocity once, with the first look.
std::vector<Look> looks_at(const Example& example, std::size_t position) {
  std::vector<Look> looks;
  const auto add = [&](double angle, Look like) {
    const auto same = std::find_if(looks.begin(), looks.end(), [&](const Look& look) {
      return look.channel == like.channel && look.front == like.front && look.back == like.back &&
             look.hard == like.hard;
    });
    Look& look = same == looks.end() ? looks.emplace_back(like) : *same;
    look.angles.push_back(angle);
  };
  for (std::size_t k = 0; k < kAngles.size(); ++k) {
    if (!nightly() && (k + position) % 2 != 0) continue;
    const std::size_t channel = (k + position) % 3;
    if (!beyond_cubature(example, kAngles[k])) {
      add(kAngles[k], {{}, true, true, channel});
    } else {
      add(kAngles[k], {{}, true, false, channel, true});
      add(kAngles[k], {{}, false, true, channel});
    }
  }
  const auto both_sides = std::find_if(looks.begin(), looks.end(),
                                       [](const Look& look) { return look.front && look.back; });
  if (both_sides != looks.end()) both_sides->reciprocal = true;
  return looks;
}

verify::BsdfOptions options_for(const Example& example, const Look& look,
                                const std::string& subject) {
  verify::BsdfOptions options;
  options.contract = contract_options(subject);
  options.eta = example.eta;
  options.angles = look.angles;
  options.random_directions = 0;
  options.front = look.front;
  options.back = look.back;
  options.reciprocal = look.reciprocal;
  options.contract.points = nightly() ? 10'000 : 1'000;
  // A ridge, curved across the chart of directions.
  if (example.name == "GgxConductor/alpha 1e-4, 1") {
    options.contract.finest_bins = 16384;
    options.contract.mass_tolerance.reset();
    // With 4 million the masses and the rejected share are known to 9e-4 together, of 1e-3.
    options.contract.evaluations = 16'000'000;
  }
  options.albedo_channel = look.channel;
  options.albedo = [&example, channel = look.channel](const verify::Vec3& wo) {
    const double albedo = known_albedo(example, {wo[0], wo[1], wo[2]}, channel);
    EXPECT_LE(albedo, 1 + 1e-6) << example.name;
    return albedo;
  };
  options.energy_tolerance = albedo_tolerance(example);
  if (look.hard) {
    // The bounds of what is known at 99.9 %, twice: once for what is found, once for what may be.
    options.contract.mass_tolerance = 5e-3;
    options.energy_tolerance = 3e-3;
  }
  return options;
}

/// The checks that there are to make from a side.
std::multiset<CheckKind> checks_of(Gives gives) {
  std::multiset<CheckKind> kinds{CheckKind::finite, CheckKind::jacobian, CheckKind::integral,
                                 CheckKind::chi_square, CheckKind::energy};
  if (gives != Gives::nothing) kinds.insert({CheckKind::record_pdf, CheckKind::support});
  if (has_density(gives)) kinds.insert(CheckKind::weight);
  if (has_atoms(gives)) kinds.insert(CheckKind::atoms);
  return kinds;
}

/// The checks of all views of a look.
std::multiset<CheckKind> checks_of(const Example& example, const Look& look) {
  std::multiset<CheckKind> kinds;
  if (look.reciprocal) kinds.insert(CheckKind::reciprocity);
  for (const bool front : {true, false}) {
    if (!(front ? look.front : look.back)) continue;
    for (std::size_t i = 0; i < look.angles.size(); ++i) {
      kinds.merge(checks_of(example.gives.of(front)));
    }
  }
  // Where there is nothing from anywhere, that is said once more.
  const bool nothing = (!look.front || example.gives.front == Gives::nothing) &&
                       (!look.back || example.gives.back == Gives::nothing);
  if (nothing) kinds.insert(CheckKind::samples);
  return kinds;
}

verify::Verdict expected_of(const Example& example, const verify::CheckResult& result) {
  const bool front = result.subject.find("/front ") != std::string::npos;
  // Atoms have no Jacobian.
  const bool jacobian_skipped =
      result.kind == CheckKind::jacobian && !has_density(example.gives.of(front));
  return jacobian_skipped || result.kind == CheckKind::samples ? verify::Verdict::inconclusive
                                                               : verify::Verdict::pass;
}

void look_at(const Example& example, const Look& look, const std::string& subject) {
  const verify::BsdfOptions options = options_for(example, look, subject);
  std::multiset<CheckKind> made;
  for (verify::CheckResult& result : verify::check_bsdf(
           example.name, verify::erase_bsdf<Vec3<double>, Vec2<double>>(example.bsdf), options)) {
    made.insert(result.kind);
    if (look.hard && result.kind == CheckKind::chi_square) {
      // Bins whose masses are known no better may leave it undecided, but must not refute it.
      EXPECT_NE(result.verdict, verify::Verdict::fail) << verify::describe(result);
      continue;
    }
    result.expected = expected_of(example, result);
    expect_verdict(result);
  }
  EXPECT_EQ(made, checks_of(example, look)) << subject;
}

template <class B>
class Battery : public testing::Test {};

TYPED_TEST_SUITE(Battery, BsdfTypes, );

TYPED_TEST(Battery, KeepsTheContractWithTheAlbedoByQuadrature) {
  const std::vector<Example> examples = examples_of<TypeParam>();
  for (std::size_t i = 0; i < examples.size(); ++i) {
    int part = 0;
    for (const Look& look : looks_at(examples[i], i)) {
      look_at(examples[i], look, examples[i].name + "/battery " + std::to_string(++part));
    }
  }
}

}  // namespace
}  // namespace plumbline::tests
