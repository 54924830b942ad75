#include <plumbline/reports/measured.h>

#include "record_fields.h"

namespace plumbline::reports {
namespace {

const Distribution& require_values(const Distribution& distribution) {
  if (distribution.name.empty()) throw FormatError("a distribution has no name");
  if (distribution.values.empty()) {
    throw FormatError("distribution \"" + distribution.name + "\" has no values");
  }
  return distribution;
}

const Counter& require_name(const Counter& counter) {
  if (counter.name.empty()) throw FormatError("a counter has no name");
  return counter;
}

}  // namespace

std::string to_json(const Distribution& distribution) {
  return detail::document(detail::kDistributionFormat, require_values(distribution));
}

Distribution parse_distribution(std::string_view json) {
  return require_values(detail::parse_document<Distribution>(detail::kDistributionFormat, json));
}

std::string to_json(const Counter& counter) {
  return detail::document(detail::kCounterFormat, require_name(counter));
}

Counter parse_counter(std::string_view json) {
  return require_name(detail::parse_document<Counter>(detail::kCounterFormat, json));
}

std::string to_json(const SeedRun& run) { return detail::document(detail::kSeedRunFormat, run); }

SeedRun parse_seed_run(std::string_view json) {
  return detail::parse_document<SeedRun>(detail::kSeedRunFormat, json);
}

}  // namespace plumbline::reports
