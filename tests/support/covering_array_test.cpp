#include <gtest/gtest.h>
#include <plumbline_tests/covering_array.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace plumbline::tests {
namespace {

std::vector<SettingsRow> without(std::vector<SettingsRow> rows, std::size_t i) {
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
  return rows;
}

/// Four settings of three values in nine rows: the smallest there is, each pair in one row only.
/// @source Taguchi's L9
const Settings kNine{{3, 3, 3, 3}};
const std::vector<SettingsRow> kNineRows{{0, 0, 0, 0}, {0, 1, 1, 1}, {0, 2, 2, 2},
                                         {1, 0, 1, 2}, {1, 1, 2, 0}, {1, 2, 0, 1},
                                         {2, 0, 2, 1}, {2, 1, 0, 2}, {2, 2, 1, 0}};

TEST(CoveringArray, CombinationsAreAsManyAsTheProductsOfTheValues) {
  // 2·3 + 2·4 + 3·4 pairs of values, 2·3·4 triples.
  const Settings settings{{2, 3, 4}};
  EXPECT_EQ(uncovered(settings, 1, {}).size(), 9u);
  EXPECT_EQ(uncovered(settings, 2, {}).size(), 26u);
  EXPECT_EQ(uncovered(settings, 3, {}).size(), 24u);
}

TEST(CoveringArray, ACombinationThatClashesIsNotAskedFor) {
  // A pair of values is in one pair, and with each of the two values of the rest in one triple.
  const Settings settings{{2, 3, 2}, {{{1, 2}, {0, 0}}}};
  EXPECT_EQ(uncovered(settings, 2, {}).size(), 16u - 1u);
  EXPECT_EQ(uncovered(settings, 3, {}).size(), 12u - 2u);
}

TEST(CoveringArray, ARowThatIsNeededLeavesItsSixPairsUncovered) {
  EXPECT_EQ(uncovered(kNine, 2, kNineRows), std::vector<Combination>{});
  for (std::size_t i = 0; i < kNineRows.size(); ++i) {
    const std::vector<Combination> missing = uncovered(kNine, 2, without(kNineRows, i));
    ASSERT_EQ(missing.size(), 6u) << "without row " << i;
    EXPECT_EQ(missing.front(), (Combination{{0, kNineRows[i][0]}, {1, kNineRows[i][1]}}));
  }
}

TEST(CoveringArray, EveryCombinationIsInARow) {
  const std::vector<Settings> many{
      kNine, {{2, 2, 2, 2, 2, 2}}, {{7, 6, 5, 4, 3, 2}}, {{4, 3, 5, 2}, {{{0, 3}, {1, 2}}}}};
  for (const Settings& settings : many) {
    for (const std::size_t strength : {1u, 2u, 3u}) {
      const std::vector<SettingsRow> rows = covering_array(settings, strength);
      EXPECT_EQ(uncovered(settings, strength, rows), std::vector<Combination>{});
      // The last row was added for a combination that none before it has.
      EXPECT_FALSE(uncovered(settings, strength, without(rows, rows.size() - 1)).empty());
      EXPECT_EQ(rows, covering_array(settings, strength));
    }
  }
}

TEST(CoveringArray, OfFullStrengthIsEveryRowThatThereIs) {
  EXPECT_EQ(covering_array({{3, 2, 4}}, 3).size(), 24u);
}

TEST(CoveringArray, IsFarSmallerThanAllRows) {
  // 42 pairs of the two longest settings need 42 rows; all there are would be 5,040.
  const std::size_t rows = covering_array({{7, 6, 5, 4, 3, 2}}, 2).size();
  EXPECT_GE(rows, 42u);
  EXPECT_LE(rows, 50u);
}

TEST(CoveringArray, NoRowHoldsAClash) {
  const Settings settings{{4, 3, 5, 2}, {{{0, 3}, {1, 2}}}};
  const std::vector<SettingsRow> rows = covering_array(settings, 2);
  ASSERT_GE(rows.size(), 20u);  // 4·5 pairs of the two longest
  for (const SettingsRow& row : rows) {
    EXPECT_FALSE(row[0] == 3 && row[1] == 2);
  }
}

TEST(CoveringArray, SettingsThatClashInEveryWayAreRefused) {
  const Settings settings{{2, 1}, {{{0, 0}, {1, 0}}}};
  EXPECT_THROW(covering_array(settings, 1), std::logic_error);
}

TEST(CoveringArray, RowsShareTheValuesThatAllOfThemHave) {
  EXPECT_EQ(shared_by({{0, 2, 1}, {1, 2, 1}, {0, 2, 0}}), (Combination{{1, 2}}));
  EXPECT_EQ(shared_by({{0, 2}, {1, 1}}), Combination{});
  EXPECT_EQ(shared_by({{0, 2}}), (Combination{{0, 0}, {1, 2}}));
  EXPECT_EQ(shared_by({}), Combination{});
}

}  // namespace
}  // namespace plumbline::tests
