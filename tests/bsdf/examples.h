#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>

namespace plumbline::tests {

/// A BSDF with parameters that the checks look at.
struct Example {
  std::string name;  ///< "GgxConductor/alpha 0.1"
  std::shared_ptr<const renderer::BsdfSet> set;
  renderer::BsdfRef bsdf;  ///< the last of `set`
  double eta;              ///< index inside over index outside; 1 where light does not pass
};

/// Parameters worth checking of one alternative of the variant: name, and the set whose last BSDF
/// is meant. The type list drives the tests: an alternative that this is not specialised for does
/// not compile in `all_examples`.
template <class B>
struct ExamplesOf;

using Sets = std::vector<std::pair<std::string, std::vector<renderer::Bsdf>>>;

#define PLUMBLINE_EXAMPLES(BSDF)                \
  template <>                                   \
  struct ExamplesOf<renderer::BSDF> {           \
    static Sets sets();                         \
    static constexpr const char* kName = #BSDF; \
  };
PLUMBLINE_EXAMPLES(Lambertian)
PLUMBLINE_EXAMPLES(ModifiedPhong)
PLUMBLINE_EXAMPLES(GgxConductor)
PLUMBLINE_EXAMPLES(GgxDielectric)
PLUMBLINE_EXAMPLES(SmoothConductor)
PLUMBLINE_EXAMPLES(SmoothDielectric)
PLUMBLINE_EXAMPLES(ClearCoat)
PLUMBLINE_EXAMPLES(ThinFilm)
PLUMBLINE_EXAMPLES(TwoSided)
PLUMBLINE_EXAMPLES(Mixture)
#undef PLUMBLINE_EXAMPLES

/// Index of a BSDF's inside over its outside.
double eta_of(const renderer::BsdfSet& set, std::uint32_t index);

/// The examples of one alternative.
template <class B>
std::vector<Example> examples_of() {
  std::vector<Example> examples;
  for (auto& [name, bsdfs] : ExamplesOf<B>::sets()) {
    const auto last = static_cast<std::uint32_t>(bsdfs.size() - 1);
    auto set = std::make_shared<const renderer::BsdfSet>(std::move(bsdfs));
    const renderer::BsdfRef bsdf(*set, last);
    examples.push_back(
        {std::string(ExamplesOf<B>::kName) + "/" + name, set, bsdf, eta_of(*set, last)});
  }
  return examples;
}

/// Every example of every alternative of the variant.
std::vector<Example> all_examples();

/// The variant's alternatives, for typed test suites.
template <class Variant>
struct TypesOf;
template <class... B>
struct TypesOf<std::variant<B...>> {
  using Types = testing::Types<B...>;
};
using BsdfTypes = TypesOf<renderer::Bsdf>::Types;

/// Metals, measured at the channels' middle wavelengths.
renderer::ConductorFresnel gold();
renderer::ConductorFresnel copper();

}  // namespace plumbline::tests
