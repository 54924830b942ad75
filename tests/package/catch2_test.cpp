// Version 2, as in Debian 12, is one header; from version 3 on it is a library.
#if __has_include(<catch2/catch.hpp>)
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#else
#include <catch2/catch_test_macros.hpp>
#endif

#include "cosine_pair.h"

TEST_CASE("a right pair passes") {
  const auto report = check_cosine(1);
  INFO(report.summary());
  CHECK(report.ok());
}

TEST_CASE("a wrong pair fails", "[!shouldfail]") {
  const auto report = check_cosine(1.1);
  INFO(report.summary());
  CHECK(report.ok());
}
