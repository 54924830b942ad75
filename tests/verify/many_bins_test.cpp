#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include <plumbline/verify/detail/random.h>

#include "pairs/bin_tree.h"
#include "pairs/tree_cell.h"

/// What is looked up for many points at once.
namespace plumbline::verify {
namespace {

TEST(BinTree, FindsManyPointsAsItFindsOne) {
  Random random(1);
  for (const int dimension : {1, 2}) {
    std::vector<Point2> points(1000);
    for (Point2& p : points) p = {random.uniform() * random.uniform(), random.uniform()};
    std::vector<Point2> pilot = points;
    const BinTree tree(pilot, 7, dimension, 0x1p-53);
    points.push_back({0, 0});
    points.push_back({1, 1});
    std::vector<std::size_t> bins(points.size());
    tree.locate(points, bins);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(bins[i], tree.locate(points[i]));
  }
}

TEST(PilotsOfBins, KeepTheirOrderWithinABin) {
  const std::vector<PilotPoint> points{{{0.1, 0}}, {{0.2, 0}}, {{0.3, 0}}, {{0.4, 0}}};
  const PilotsOfBins pilots(points, {2, 0, 2, 0}, 4);
  ASSERT_EQ(pilots.of(0).size(), 2U);
  EXPECT_EQ(pilots.of(0)[0].p[0], 0.2);
  EXPECT_EQ(pilots.of(0)[1].p[0], 0.4);
  EXPECT_TRUE(pilots.of(1).empty());
  EXPECT_EQ(pilots.of(2)[1].p[0], 0.3);
  EXPECT_TRUE(pilots.of(3).empty());
}

}  // namespace
}  // namespace plumbline::verify
