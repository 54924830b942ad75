#pragma once

#include <cstddef>
#include <utility>
#include <vector>

/// Few rows of settings in which all values meet each other: where all rows there are would be too
/// many, and rows by hand forget some.
namespace plumbline::tests {

/// One value, by its number, of one setting, by its number.
struct SettingValue {
  std::size_t setting = 0, value = 0;

  friend bool operator==(const SettingValue&, const SettingValue&) = default;
};

/// How many values each setting has, and which values of two settings do not go together.
struct Settings {
  std::vector<std::size_t> value_counts;
  std::vector<std::pair<SettingValue, SettingValue>> clashes{};
};

/// A value of every setting, in their order.
using SettingsRow = std::vector<std::size_t>;

/// Values of different settings that go together, in the settings' order.
using Combination = std::vector<SettingValue>;

/// The combinations of `strength` values that no row has: none, if the rows cover them. With no
/// rows all there are.
std::vector<Combination> uncovered(const Settings& settings, std::size_t strength,
                                   const std::vector<SettingsRow>& rows);

/// Rows without clashes that leave no combination of `strength` values uncovered: the same every
/// time. Each row takes the first combination that is missing and as many others as it can; it is
/// not the smallest array.
///
/// @throws std::logic_error where a row cannot be completed without a clash
/// @source Cohen, Dalal, Fredman, Patton 1997 (IEEE TSE 23:7), Section 3, with one candidate row
std::vector<SettingsRow> covering_array(const Settings& settings, std::size_t strength);

/// Whether a row has all of these values.
bool has(const SettingsRow& row, const Combination& combination);

/// The values that all rows have in common: of rows that fail, what to look at first. All values of
/// a single row, none of no rows.
Combination shared_by(const std::vector<SettingsRow>& rows);

}  // namespace plumbline::tests
