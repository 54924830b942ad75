#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "cosine_pair.h"

TEST_CASE("a right pair passes") {
  const auto report = check_cosine(1);
  CHECK_MESSAGE(report.ok(), report.summary());
}

TEST_CASE("a wrong pair fails" * doctest::should_fail()) {
  const auto report = check_cosine(1.1);
  CHECK_MESSAGE(report.ok(), report.summary());
}
