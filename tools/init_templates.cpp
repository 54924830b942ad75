#include "init_templates.h"

namespace plumbline::tools {
namespace {

constexpr const char* kCMake = R"(cmake_minimum_required(VERSION 3.25)
project(sampling_tests LANGUAGES CXX)

set(CMAKE_CXX_STANDARD 20)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_package(GTest REQUIRED)
find_package(plumbline QUIET COMPONENTS verify)
if(NOT plumbline_FOUND)
  set(PLUMBLINE_SOURCE "@SOURCES@" CACHE PATH "Plumbline's sources, where it is not installed")
  add_subdirectory("${PLUMBLINE_SOURCE}" plumbline EXCLUDE_FROM_ALL)
endif()

enable_testing()
include(GoogleTest)
add_executable(my_bsdf_test my_bsdf_test.cpp)
target_link_libraries(my_bsdf_test PRIVATE plumbline::verify GTest::gtest_main)
gtest_discover_tests(my_bsdf_test)
)";

constexpr const char* kBsdf = R"(#pragma once

#include <cmath>
#include <optional>

// Stands for your renderer's own: any vector class will do.
struct Vec3 {
  float x, y, z;
};

struct BsdfSample {
  Vec3 wi;
  float weight;  // f·|cosθ|/pdf
  float pdf;     // per steradian
};

// A diffuse reflection. z is the normal, all directions point away from the surface.
class MyBsdf {
 public:
  float eval(const Vec3& wo, const Vec3& wi) const {
    return wo.z > 0 && wi.z > 0 ? kAlbedo / kPi : 0.f;
  }

  float pdf(const Vec3& wo, const Vec3& wi) const {
    return wo.z > 0 && wi.z > 0 ? wi.z / kPi : 0.f;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, float u, float v) const {
    if (wo.z <= 0) return std::nullopt;
    const float r = std::sqrt(u), phi = 2 * kPi * v;
    const Vec3 wi{r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
    return BsdfSample{wi, kAlbedo, pdf(wo, wi)};
  }

 private:
  static constexpr float kPi = 3.14159265f, kAlbedo = 0.8f;
};
)";

constexpr const char* kBsdfTest = R"(#include "my_bsdf.h"

#include <gtest/gtest.h>

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/conventions.h>
#include <plumbline/verify/gtest.h>

namespace verify = plumbline::verify;

TEST(MyBsdf, SamplesWhatItsPdfSays) {
  verify::BsdfOptions options;
  // options.conventions = verify::conventions::mitsuba();  // or pbrt(), …: how yours is written
  PLUMBLINE_EXPECT_PASS(verify::check_bsdf("my_bsdf", MyBsdf(), options));
}
)";

constexpr const char* kPythonBsdf =
    R"("""A diffuse reflection. z is the normal, all directions point away from the surface."""

import numpy as np

ALBEDO = 0.8


def evaluate(wo, wi):
    """f [1/sr] of directions (n, 3)."""
    return np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), ALBEDO / np.pi, 0)


def pdf(wo, wi):
    """Per steradian."""
    return np.where((wo[:, 2] > 0) & (wi[:, 2] > 0), wi[:, 2] / np.pi, 0)


def sample(wo, u):
    """wi, pdf, weight f·|cosθ|/pdf, and whether there is one, from u (n, 2) in [0, 1)."""
    r, phi = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
    wi = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[:, 0])], axis=-1)
    return wi, pdf(wo, wi), np.full(len(u), ALBEDO), wo[:, 2] > 0
)";

constexpr const char* kPythonTest = R"(import plumbline

import my_bsdf


def test_samples_what_its_pdf_says():
    report = plumbline.check_bsdf(
        "my_bsdf",
        sample=my_bsdf.sample,
        pdf=my_bsdf.pdf,
        eval=my_bsdf.evaluate,
        conventions=[],  # "mitsuba", "pbrt", …: plumbline.CONVENTIONS
    )
    assert report, report
)";

constexpr const char* kConftest = R"(# Shows reports in full where a test fails.
pytest_plugins = ["plumbline.pytest_plugin"]
)";

std::string with_sources(std::string text, const std::string& sources) {
  const std::string mark = "@SOURCES@";
  return text.replace(text.find(mark), mark.size(), sources);
}

}  // namespace

std::vector<TemplateFile> cpp_template(const std::string& sources) {
  return {{"CMakeLists.txt", with_sources(kCMake, sources)},
          {"my_bsdf.h", kBsdf},
          {"my_bsdf_test.cpp", kBsdfTest}};
}

std::vector<TemplateFile> python_template() {
  return {
      {"my_bsdf.py", kPythonBsdf}, {"test_my_bsdf.py", kPythonTest}, {"conftest.py", kConftest}};
}

}  // namespace plumbline::tools
