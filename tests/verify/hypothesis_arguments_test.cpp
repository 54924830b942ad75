#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "moved_arguments.h"

/// A function that is asked with mistaken arguments is named by the mistake: what samples have is
/// pdf(), or f, of the arguments that the test says.
namespace plumbline::verify {
namespace {

using std::numbers::pi;
using Moved = std::function<Vec3(const Vec3&)>;

ErasedBsdf bsdf_valued(const OfDirections& f) {
  ErasedBsdf b;
  b.pdf = [f](const Vec3& wo, const Vec3& wi) { return f(wo, wi); };
  b.eval = [f](const Vec3& wo, const Vec3& wi) {
    Channels c;
    c.count = 1;
    c.value[0] = f(wo, wi);
    return c;
  };
  return b;
}
double of_both(const Vec3& wo, const Vec3& wi) { return lopsided(wi) * (1.2 + wo[0] * wi[1]); }

const std::vector<Vec3> kBothSides = {{0.48, 0.36, 0.8}, {-0.6, 0.64, -0.48}};

Said said_of_bsdf(const std::vector<Vec3>& wo, const OfDirections& samples,
                  const OfDirections& pdf = of_both) {
  SeenRatios seen(bsdf_valued(pdf), wo, even_directions(kRatiosPerView, true), 1,
                  RatioKind::density_over_pdf,
                  [&](const Vec3& o, const Vec3& i) { return samples(o, i) / pdf(o, i); });
  return simplest(Observations::of_density(seen.evidence()),
                  argument_hypotheses(seen.evidence(), of_pdf(), false));
}

std::string mirrored_as(const std::string& axes) {
  return "directions are mirrored between sample and pdf(): the density of the samples at (x, y, "
         "z) "
         "is that of " +
         axes;
}

TEST(Arguments, ThatAreExchangedAreNamed) {
  const Said said =
      said_of_bsdf(kViews, [](const Vec3& o, const Vec3& i) { return of_both(i, o); });
  EXPECT_EQ(said.kind, CauseKind::directions_swapped);
  EXPECT_EQ(said.words,
            "wo and wi are exchanged in pdf(): the density of the samples is what it gives for "
            "(wi, wo)");
  const auto swapped = [](const Vec3& w) { return Vec3{w[1], w[0], w[2]}; };
  EXPECT_EQ(said_of_bsdf(kViews, [&](const Vec3& o,
                                     const Vec3& i) { return of_both(swapped(o), swapped(i)); })
                .words,
            "x and y are exchanged in pdf(): the density of the samples is what it gives for both "
            "directions with x and y exchanged (as with the roughnesses along x and y)");
}

/// The same of values: weight · pdf() over f·|cosθi|.
TEST(Arguments, OfValuesAreNamed) {
  const auto said = [](double eta, const OfDirections& weight_times_pdf) {
    SeenRatios seen(bsdf_valued(of_both), kViews, even_directions(kRatiosPerView, true), eta,
                    RatioKind::weight_over_value, [&](const Vec3& o, const Vec3& i) {
                      return weight_times_pdf(o, i) / (of_both(o, i) * std::abs(i[2]));
                    });
    return simplest(Observations::of_series(seen.evidence(), RatioKind::weight_over_value),
                    argument_hypotheses(seen.evidence(), {"f·|cosθ|", "weight · pdf()"}, true));
  };
  const std::string swapped =
      "wo and wi are exchanged in f·|cosθ|: weight · pdf() is what it gives for (wi, wo)";
  const Said with_own = said(1, [](auto& o, auto& i) { return of_both(i, o) * std::abs(i[2]); });
  const Said with_other = said(1, [](auto& o, auto& i) { return of_both(i, o) * std::abs(o[2]); });
  EXPECT_EQ(with_own.words, swapped);
  EXPECT_EQ(with_other.words, swapped);
  EXPECT_LT(with_own.cost, with_other.cost);
  // Of a refraction f the other way differs by η² alone: farther fetched.
  EXPECT_GT(said(1.5, [](auto& o, auto& i) { return of_both(i, o) * std::abs(i[2]); }).cost,
            with_own.cost);
  EXPECT_EQ(said(1,
                 [](auto& o, auto& i) {
                   return of_both({o[1], o[0], o[2]}, {i[1], i[0], i[2]}) * std::abs(i[2]);
                 })
                .kind,
            CauseKind::mirrored);
}

TEST(Arguments, ThatAreMirroredAreNamed) {
  struct Row {
    const char* axes;
    Moved moved;
  };
  const Row rows[] = {{"(−x, y, z)",
                       [](auto& x) {
                         return Vec3{-x[0], x[1], x[2]};
                       }},
                      {"(x, −y, z)",
                       [](auto& x) {
                         return Vec3{x[0], -x[1], x[2]};
                       }},
                      {"(x, y, −z)",
                       [](auto& x) {
                         return Vec3{x[0], x[1], -x[2]};
                       }},
                      {"(−x, −y, −z)",
                       [](auto& x) {
                         return Vec3{-x[0], -x[1], -x[2]};
                       }},
                      {"(y, x, z)",
                       [](auto& x) {
                         return Vec3{x[1], x[0], x[2]};
                       }},
                      {"(z, y, x)",
                       [](auto& x) {
                         return Vec3{x[2], x[1], x[0]};
                       }},
                      {"(y, z, −x)", [](auto& x) {
                         return Vec3{x[1], x[2], -x[0]};
                       }}};
  for (const Row& row : rows) {
    const Said said = said_of_bsdf(
        kViews, [&](const Vec3& o, const Vec3& i) { return of_both(o, row.moved(i)); });
    EXPECT_EQ(said.words, mirrored_as(row.axes));
    EXPECT_EQ(said.kind, CauseKind::mirrored);
  }
  EXPECT_EQ(said_of_bsdf(kViews,
                         [](const Vec3& o, const Vec3& i) {
                           return of_both(o, {0.8 * i[0], 0.6 * i[1], i[2]});
                         })
                .words,
            "");
}

/// Where several say the same, the one with the fewest signs and exchanges is named.
TEST(Arguments, TheSimplestMistakeIsNamed) {
  // The same for −w as for w: a sign of z is one of x and y.
  const OfDirections even = [](const Vec3& o, const Vec3& i) {
    return 1 + o[2] * (0.3 * i[0] * i[1] + 0.2 * i[1] * i[2] + 0.25 * i[2] * i[0]);
  };
  EXPECT_EQ(said_of_bsdf(
                kViews,
                [&](const Vec3& o, const Vec3& i) {
                  return even(o, {i[0], i[1], -i[2]});
                },
                even)
                .words,
            mirrored_as("(x, y, −z)"));
  // Depends on x and z alone, in the same way: exchanged, and not with signs of y beside it.
  const OfDirections flat = [](const Vec3&, const Vec3& i) { return 2 + 0.5 * i[0]; };
  const Said said = said_of_bsdf(
      kViews,
      [&](const Vec3& o, const Vec3& i) {
        return flat(o, {i[2], i[1], i[0]});
      },
      flat);
  EXPECT_EQ(said.words, mirrored_as("(z, y, x)"));
}

/// Mirrored in the plane of wo and a fibre's axis.
TEST(Arguments, AzimuthsOfFibresAreNamed) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    const Said said = said_of_bsdf(kViews, [axis](const Vec3& o, const Vec3& i) {
      // In the plane across the axis: the azimuth twice that of wo, less its own.
      const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
      const double phi = 2 * std::atan2(o[b], o[a]) - std::atan2(i[b], i[a]);
      const double r = std::hypot(i[a], i[b]);
      Vec3 turned = i;
      turned[a] = r * std::cos(phi);
      turned[b] = r * std::sin(phi);
      return of_both(o, turned);
    });
    EXPECT_EQ(said.words, "the azimuth around the " + std::string(axis == 0 ? "x" : "y") +
                              " axis, counted from that of wo, has the other sign in pdf()");
  }
}

TEST(Arguments, ThatAreMirroredFromBehindAreNamed) {
  const Said said = said_of_bsdf(kBothSides, [](const Vec3& o, const Vec3& i) {
    return of_both(o, o[2] < 0 ? Vec3{i[0], -i[1], i[2]} : i);
  });
  EXPECT_EQ(said.words,
            "seen from behind, directions are mirrored between sample and pdf(): the density of "
            "the samples at (x, y, z) is that of (x, −y, z)");
  EXPECT_EQ(said.kind, CauseKind::mirrored);
}

TEST(Arguments, TurnedFramesAreNamedWithTheirAngle) {
  EXPECT_EQ(said_of_bsdf(kViews,
                         [](const Vec3& o, const Vec3& i) { return of_both(o, turned_by(i, 25)); })
                .words,
            "sample and pdf() are in tangent frames that are turned by 25° against each other");
  // Another angle from each direction costs as many numbers; half a turn is a sign.
  const Said by_view = said_of_bsdf(kViews, [](const Vec3& o, const Vec3& i) {
    return of_both(o, turned_by(i, o[0] > 0.4 ? 25 : -60));
  });
  EXPECT_EQ(by_view.kind, CauseKind::tangent_frame);
  EXPECT_GT(by_view.cost, 3 * kPerNumber);
  const Said half = said_of_bsdf(kViews, [](const Vec3& o, const Vec3& i) {
    return of_both(o, turned_by(i, o[0] > 0.4 ? 180 : 0));
  });
  EXPECT_EQ(half.kind, CauseKind::none) << half.words;
}

TEST(Arguments, OfPointsAreNamed) {
  struct Row {
    Domain domain;
    const char* words;
    Moved moved;
  };
  const Domain disk = Domain::disk(2), triangle = Domain::triangle(), line = Domain::interval(1, 4),
               square = Domain::unit_square();
  const char* order = "barycentric coordinates are in another order";
  const Row rows[] = {{disk, "x has its sign changed",
                       [](auto& x) {
                         return Vec3{-x[0], x[1], 0};
                       }},
                      {disk, "y has its sign changed",
                       [](auto& x) {
                         return Vec3{x[0], -x[1], 0};
                       }},
                      {disk, "x and y have their signs changed",
                       [](auto& x) {
                         return Vec3{-x[0], -x[1], 0};
                       }},
                      {disk, "x and y are exchanged",
                       [](auto& x) {
                         return Vec3{x[1], x[0], 0};
                       }},
                      {triangle, order,
                       [](auto& x) {
                         return Vec3{x[1], x[0], 0};
                       }},
                      {triangle, order,
                       [](auto& x) {
                         return Vec3{x[0], 1 - x[0] - x[1], 0};
                       }},
                      {triangle, order,
                       [](auto& x) {
                         return Vec3{1 - x[0] - x[1], x[1], 0};
                       }},
                      {triangle, order,
                       [](auto& x) {
                         return Vec3{x[1], 1 - x[0] - x[1], 0};
                       }},
                      {triangle, order,
                       [](auto& x) {
                         return Vec3{1 - x[0] - x[1], x[0], 0};
                       }},
                      {line, "the first coordinate runs the other way",
                       [](auto& x) {
                         return Vec3{5 - x[0], 0, 0};
                       }},
                      {square, "the first coordinate runs the other way",
                       [](auto& x) {
                         return Vec3{1 - x[0], x[1], 0};
                       }},
                      {square, "the second coordinate runs the other way",
                       [](auto& x) {
                         return Vec3{x[0], 1 - x[1], 0};
                       }},
                      {square, "both coordinates run the other way",
                       [](auto& x) {
                         return Vec3{1 - x[0], 1 - x[1], 0};
                       }},
                      {square, "the two coordinates are exchanged", [](auto& x) {
                         return Vec3{x[1], x[0], 0};
                       }}};
  for (const Row& row : rows) {
    const Said said = said_of_moved_points(row.domain, lopsided,
                                           [&](const Vec3& x) { return lopsided(row.moved(x)); });
    EXPECT_EQ(said.words, row.words + std::string(" between sample and pdf()"));
    EXPECT_EQ(said.kind, CauseKind::mirrored);
  }
}

TEST(Arguments, OfIndicesAreNamed) {
  constexpr int kSize = 60;
  const OfPoint pmf = [](const Vec3& x) { return (x[0] + 1) * (x[0] + 1); };
  const auto named = [&](const OfPoint& samples) {
    std::vector<Vec3> points;
    for (int i = 0; i < kSize; ++i) points.push_back({double(i), 0, 0});
    SeenRatios seen(Domain::discrete(kSize), pmf, points,
                    [&](const Vec3& x) { return samples(x) / pmf(x); });
    return simplest(Observations::of_density(seen.evidence()),
                    argument_hypotheses(seen.evidence(), of_pdf(), false))
        .words;
  };
  const auto around = [&](const Vec3& x, int by) {
    return pmf({double((int(x[0]) + by + kSize) % kSize), 0, 0});
  };
  EXPECT_EQ(named([&](auto& x) {
              return pmf({kSize - 1 - x[0], 0, 0});
            }),
            "indices run the other way between sample and pdf()");
  for (const int by : {1, -1, 2, -2}) {
    EXPECT_EQ(named([&](auto& x) { return around(x, by); }),
              "pdf() is off by " + std::to_string(by) + " in the index");
  }
  EXPECT_EQ(named([&](auto& x) { return around(x, 3); }), "");
  EXPECT_EQ(named([](auto&) { return 1.0 / kSize; }), "all are chosen alike, whatever pdf() says");
}

/// Of the cube 8 times 1/3 of the cubed way to its border; of the ball 1/(4π).
TEST(Arguments, CornersOfACubeAreNamed) {
  SeenRatios seen(
      Domain::sphere(), [](const Vec3&) { return 1 / (4 * pi); },
      even_directions(kRatiosPerView, true),
      [](const Vec3& x) {
        const double way = 1 / std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
        return way * way * way / 3 / 8 * 4 * pi;
      });
  // Samples of the domain, from which a turn of the whole is guessed.
  seen.pair().sample = [](const Uniforms& u) {
    const double z = 1 - 2 * u[0], r = std::sqrt(1 - z * z);
    return SampleRecord{{r * std::cos(2 * pi * u[1]), r * std::sin(2 * pi * u[1]), z}, {}, {}};
  };
  EXPECT_EQ(
      simplest(Observations::of_density(seen.evidence()),
               argument_hypotheses(seen.evidence(), of_pdf(), false))
          .words,
      "points of the cube outside the ball are not rejected, where pdf() is that of the ball");
}

}  // namespace
}  // namespace plumbline::verify
