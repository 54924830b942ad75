#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "correct_pairs.h"
#include "seen_ratios.h"

/// Area for solid angle of planar lights, and what else is mistaken between the two.
namespace plumbline::verify {
namespace {

/// A light in a plane z = 1 or x = 1, by area for solid angle: dA = r²/cosθ_l dω, r = 1/cosθ_l.
TEST(Lights, PlanarOnesAreNamed) {
  struct Row {
    const char* words;
    double power;
  };
  const Row rows[] = {{"density per area in place of solid angle in", -3},
                      {"r² missing from", -2},
                      {"cosθ at the light missing from", -1},
                      {"cosθ at the light too many in", 1},
                      {"cosθ at the light multiplied instead of divided, and no r², in", -4},
                      {"cosθ at the light multiplied instead of divided in", 2}};
  const Vec3 normals[] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0.48, 0.36, 0.8}};
  for (const Vec3& n : normals) {
    std::vector<Vec3> points;
    for (const Vec3& w : even_directions(400, true)) {
      if (dot_of(w, n) > 0.3 && points.size() < kRatiosPerView) points.push_back(w);
    }
    for (const Row& row : rows) {
      SeenRatios seen(
          Domain::sphere(), [](const Vec3& x) { return 1 + 0.2 * x[0]; }, points,
          [&](const Vec3& x) { return 1.7 * std::pow(std::abs(dot_of(n, x)), row.power); });
      const Said said = simplest(Observations::of_density(seen.evidence()),
                                 light_hypotheses(seen.evidence(), of_pdf()));
      EXPECT_EQ(said.words, row.words + std::string(" pdf() (a planar light)"));
      EXPECT_EQ(said.kind, CauseKind::distance_or_area);
      // A light across an axis has no normal to be fitted.
      const bool on_axis = n[0] == 1 || n[1] == 1 || n[2] == 1;
      EXPECT_EQ(said.cost < 2 * kPerNumber, on_axis);
    }
  }
}

}  // namespace
}  // namespace plumbline::verify
