#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plumbline/renderer/assembly/bsdf.h>

namespace plumbline::tests {

/// What there is to sample when looked at from one side.
enum class Gives { nothing, density, atoms, both };

constexpr bool has_density(Gives gives) { return gives == Gives::density || gives == Gives::both; }
constexpr bool has_atoms(Gives gives) { return gives == Gives::atoms || gives == Gives::both; }

/// The same of both sides. Stated with each example, as its model has it: what a suite expects of a
/// BSDF must not be asked of that BSDF.
struct Faces {
  Gives front, back;

  Gives of(bool is_front) const { return is_front ? front : back; }
  bool density() const { return has_density(front) || has_density(back); }
  bool atoms() const { return has_atoms(front) || has_atoms(back); }
};

/// A BSDF with parameters that the checks look at.
struct Example {
  std::string name;  ///< "GgxConductor/alpha 0.1"
  std::shared_ptr<const renderer::BsdfSet> set;
  renderer::BsdfRef bsdf;  ///< the last of `set`
  double eta;              ///< index inside over index outside; 1 where light does not pass
  Faces gives;
};

/// A set whose last BSDF is meant.
struct NamedSet {
  std::string name;
  std::vector<renderer::Bsdf> bsdfs;
  Faces gives;
};
using Sets = std::vector<NamedSet>;

/// Parameters worth checking of one alternative of the variant. The type list drives the tests: an
/// alternative that this is not specialised for does not compile.
template <class B>
struct ExamplesOf;

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

/// The examples of one alternative: at least one, or no suite would look at it.
template <class B>
std::vector<Example> examples_of() {
  std::vector<Example> examples;
  for (auto& [name, bsdfs, gives] : ExamplesOf<B>::sets()) {
    const auto last = static_cast<std::uint32_t>(bsdfs.size() - 1);
    auto set = std::make_shared<const renderer::BsdfSet>(std::move(bsdfs));
    const renderer::BsdfRef bsdf(*set, last);
    examples.push_back(
        {std::string(ExamplesOf<B>::kName) + "/" + name, set, bsdf, eta_of(*set, last), gives});
  }
  if (examples.empty()) throw std::logic_error("a BSDF has no examples");
  return examples;
}

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
