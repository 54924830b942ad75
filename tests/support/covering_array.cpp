#include <plumbline_tests/covering_array.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace plumbline::tests {
namespace {

bool clash(const Settings& settings, const SettingValue& a, const SettingValue& b) {
  return std::any_of(settings.clashes.begin(), settings.clashes.end(), [&](const auto& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
}

/// Calls `visit` with every combination that extends `begun` to `strength` values.
template <class Visit>
void for_each_combination(const Settings& settings, std::size_t strength, Combination& begun,
                          const Visit& visit) {
  if (begun.size() == strength) return visit(begun);
  const std::size_t first = begun.empty() ? 0 : begun.back().setting + 1;
  for (std::size_t setting = first; setting < settings.value_counts.size(); ++setting) {
    for (std::size_t value = 0; value < settings.value_counts[setting]; ++value) {
      const SettingValue next{setting, value};
      if (std::any_of(begun.begin(), begun.end(),
                      [&](const SettingValue& v) { return clash(settings, v, next); })) {
        continue;
      }
      begun.push_back(next);
      for_each_combination(settings, strength, begun, visit);
      begun.pop_back();
    }
  }
}

/// A row as it is filled in.
class PartialRow {
 public:
  PartialRow(const Settings& settings, const Combination& begin)
      : settings_(settings), values_(settings.value_counts.size()) {
    for (const SettingValue& v : begin) values_[v.setting] = v.value;
  }

  /// Gives a setting that has none yet the value with which the row covers most of what is missing;
  /// of equal ones that with which it still can.
  void fill(std::size_t setting, const std::vector<Combination>& missing) {
    if (values_[setting]) return;
    std::optional<std::tuple<std::size_t, std::size_t>> best;
    std::optional<std::size_t> chosen;
    for (std::size_t value = 0; value < settings_.value_counts[setting]; ++value) {
      if (clashes({setting, value})) continue;
      const auto gain = gain_of({setting, value}, missing);
      if (best && gain <= *best) continue;
      best = gain;
      chosen = value;
    }
    if (!chosen) throw std::logic_error("every value left clashes with a row of settings");
    values_[setting] = chosen;
  }

  SettingsRow finished() const {
    SettingsRow row;
    for (const auto& value : values_) row.push_back(value.value());
    return row;
  }

 private:
  bool clashes(const SettingValue& next) const {
    for (std::size_t s = 0; s < values_.size(); ++s) {
      if (values_[s] && clash(settings_, {s, *values_[s]}, next)) return true;
    }
    return false;
  }

  /// Missing combinations with the value that the row would hold, and that it could still come to
  /// hold.
  std::tuple<std::size_t, std::size_t> gain_of(const SettingValue& next,
                                               const std::vector<Combination>& missing) const {
    std::size_t held = 0, possible = 0;
    for (const Combination& combination : missing) {
      if (std::find(combination.begin(), combination.end(), next) == combination.end()) continue;
      bool open = false, lost = false;
      for (const SettingValue& v : combination) {
        if (v == next) continue;
        open = open || !values_[v.setting];
        lost = lost || (values_[v.setting] && *values_[v.setting] != v.value);
      }
      if (!lost) ++(open ? possible : held);
    }
    return {held, possible};
  }

  const Settings& settings_;
  std::vector<std::optional<std::size_t>> values_;
};

}  // namespace

bool has(const SettingsRow& row, const Combination& combination) {
  return std::all_of(combination.begin(), combination.end(),
                     [&](const SettingValue& v) { return row[v.setting] == v.value; });
}

std::vector<Combination> uncovered(const Settings& settings, std::size_t strength,
                                   const std::vector<SettingsRow>& rows) {
  std::vector<Combination> missing;
  Combination begun;
  for_each_combination(settings, strength, begun, [&](const Combination& combination) {
    if (std::none_of(rows.begin(), rows.end(),
                     [&](const SettingsRow& row) { return has(row, combination); })) {
      missing.push_back(combination);
    }
  });
  return missing;
}

std::vector<SettingsRow> covering_array(const Settings& settings, std::size_t strength) {
  std::vector<SettingsRow> rows;
  std::vector<Combination> missing = uncovered(settings, strength, {});
  while (!missing.empty()) {
    PartialRow row(settings, missing.front());
    for (std::size_t s = 0; s < settings.value_counts.size(); ++s) row.fill(s, missing);
    rows.push_back(row.finished());
    missing.erase(std::remove_if(missing.begin(), missing.end(),
                                 [&](const Combination& c) { return has(rows.back(), c); }),
                  missing.end());
  }
  return rows;
}

Combination shared_by(const std::vector<SettingsRow>& rows) {
  Combination shared;
  if (rows.empty()) return shared;
  for (std::size_t setting = 0; setting < rows.front().size(); ++setting) {
    const std::size_t value = rows.front()[setting];
    if (std::all_of(rows.begin(), rows.end(),
                    [&](const SettingsRow& row) { return row[setting] == value; })) {
      shared.push_back({setting, value});
    }
  }
  return shared;
}

}  // namespace plumbline::tests
