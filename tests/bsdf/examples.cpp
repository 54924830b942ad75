#include "examples.h"

namespace plumbline::tests {

using namespace renderer;

ConductorFresnel gold() { return {{0.18f, 0.42f, 1.37f}, {3.42f, 2.35f, 1.77f}}; }
ConductorFresnel copper() { return {{0.27f, 0.68f, 1.32f}, {3.61f, 2.63f, 2.29f}}; }

namespace {

const Rgbf kWhite{1, 1, 1};
const ConductorFresnel kNoLoss;

constexpr Faces kDensityInFront{Gives::density, Gives::nothing};
constexpr Faces kDensity{Gives::density, Gives::density};
constexpr Faces kAtomsInFront{Gives::atoms, Gives::nothing};
constexpr Faces kAtoms{Gives::atoms, Gives::atoms};

/// Index inside over the one outside of each alternative of the variant, 1 where light does not
/// pass; one that has none here does not compile.
struct EtaOf {
  const BsdfSet& set;

  double of(std::uint32_t index) const { return std::visit(*this, set.alternative(index)); }

  double operator()(const Lambertian&) const { return 1; }
  double operator()(const ModifiedPhong&) const { return 1; }
  double operator()(const GgxConductor&) const { return 1; }
  double operator()(const SmoothConductor&) const { return 1; }
  double operator()(const ClearCoat&) const { return 1; }
  double operator()(const TwoSided&) const { return 1; }
  double operator()(const GgxDielectric& b) const { return double{b.interface.eta}; }
  double operator()(const SmoothDielectric& b) const { return double{b.interface.eta}; }
  double operator()(const ThinFilm& b) const { return std::visit(*this, b.base()); }
  /// Both children of a mixture have the same medium behind them.
  double operator()(const Mixture& b) const { return of(b.first); }
};

}  // namespace

double eta_of(const BsdfSet& set, std::uint32_t index) { return EtaOf{set}.of(index); }

Sets ExamplesOf<Lambertian>::sets() {
  return {{"coloured", {Lambertian{{0.5f, 0.2f, 0.8f}}}, kDensityInFront}};
}

Sets ExamplesOf<ModifiedPhong>::sets() {
  return {{"n 1", {ModifiedPhong{{0.2f, 0.6f, 1}, 1}}, kDensityInFront},
          {"n 20", {ModifiedPhong{{0.9f, 0.5f, 0.1f}, 20}}, kDensityInFront},
          {"n 1000", {ModifiedPhong{kWhite, 1000}}, kDensityInFront},
          {"n 1e6", {ModifiedPhong{kWhite, 1e6f}}, kDensityInFront}};
}

Sets ExamplesOf<GgxConductor>::sets() {
  return {{"alpha 1e-4", {GgxConductor{{1e-4f, 1e-4f}, kNoLoss}}, kDensityInFront},
          {"alpha 1e-3 gold", {GgxConductor{{1e-3f, 1e-3f}, gold()}}, kDensityInFront},
          {"alpha 0.1", {GgxConductor{{0.1f, 0.1f}, kNoLoss}}, kDensityInFront},
          {"alpha 0.05, 0.4 copper", {GgxConductor{{0.05f, 0.4f}, copper()}}, kDensityInFront},
          {"alpha 1e-4, 1", {GgxConductor{{1e-4f, 1}, kNoLoss}}, kDensityInFront},
          {"alpha 1", {GgxConductor{{1, 1}, kNoLoss}}, kDensityInFront}};
}

Sets ExamplesOf<GgxDielectric>::sets() {
  return {{"eta 1.5 alpha 1e-4", {GgxDielectric{{1e-4f, 1e-4f}, {1.5f}}}, kDensity},
          {"eta 1.5 alpha 0.1", {GgxDielectric{{0.1f, 0.1f}, {1.5f}}}, kDensity},
          {"eta 1/1.5 alpha 0.02", {GgxDielectric{{0.02f, 0.02f}, {1 / 1.5f}}}, kDensity},
          {"eta 1.01 alpha 0.3", {GgxDielectric{{0.3f, 0.3f}, {1.01f}}}, kDensity},
          {"eta 1.5 alpha 0.2, 0.6", {GgxDielectric{{0.2f, 0.6f}, {1.5f}}}, kDensity},
          {"eta 2.5 alpha 1", {GgxDielectric{{1, 1}, {2.5f}}}, kDensity},
          {"eta 1/2.5 alpha 0.5", {GgxDielectric{{0.5f, 0.5f}, {0.4f}}}, kDensity}};
}

Sets ExamplesOf<SmoothConductor>::sets() {
  return {{"mirror", {SmoothConductor{kNoLoss}}, kAtomsInFront},
          {"gold", {SmoothConductor{gold()}}, kAtomsInFront}};
}

Sets ExamplesOf<SmoothDielectric>::sets() {
  return {{"eta 1.5", {SmoothDielectric{{1.5f}}}, kAtoms},
          {"eta 1", {SmoothDielectric{{1}}}, kAtoms},
          {"eta 1/2.5", {SmoothDielectric{{0.4f}}}, kAtoms}};
}

Sets ExamplesOf<ClearCoat>::sets() {
  return {{"eta 1.5 alpha 0.1", {ClearCoat(1.5f, 0.1f, {0.8f, 0.3f, 0.1f})}, kDensityInFront},
          {"eta 1.5 alpha 1e-4", {ClearCoat(1.5f, 1e-4f, {0, 0.5f, 0.9f})}, kDensityInFront},
          {"eta 2.5 alpha 0.5 white", {ClearCoat(2.5f, 0.5f, kWhite)}, kDensityInFront},
          {"eta 1.3 alpha 1 black", {ClearCoat(1.3f, 1, {0, 0, 0})}, kDensityInFront}};
}

Sets ExamplesOf<ThinFilm>::sets() {
  return {{"300 nm on rough gold",
           {ThinFilm{GgxConductor{{0.1f, 0.1f}, gold()}, {300, 1.5f}}},
           kDensityInFront},
          {"2000 nm on rough glass",
           {ThinFilm{GgxDielectric{{0.2f, 0.2f}, {1.5f}}, {2000, 1.8f}}},
           kDensity},
          {"100 nm on rough glass, coated lens",
           {ThinFilm{GgxDielectric{{0.05f, 0.05f}, {1.5f}}, {100, 1.38f}}},
           kDensity},
          {"0 nm on rough copper",
           {ThinFilm{GgxConductor{{0.3f, 0.3f}, copper()}, {0, 1.33f}}},
           kDensityInFront},
          {"550 nm on gold", {ThinFilm{SmoothConductor{gold()}, {550, 1.33f}}}, kAtomsInFront},
          {"400 nm on glass", {ThinFilm{SmoothDielectric{{1.5f}}, {400, 1.33f}}}, kAtoms}};
}

Sets ExamplesOf<TwoSided>::sets() {
  const Bsdf diffuse = Lambertian{{0.7f, 0.5f, 0.2f}};
  const Bsdf metal = GgxConductor{{0.1f, 0.3f}, copper()};
  const Bsdf mirror = SmoothConductor{kNoLoss};
  const Bsdf phong = ModifiedPhong{{0.4f, 0.9f, 1}, 50};
  return {{"rough copper", {metal, TwoSided{0, 0}}, kDensity},
          {"diffuse, phong behind", {diffuse, phong, TwoSided{0, 1}}, kDensity},
          {"coat, mirror behind",
           {ClearCoat(1.5f, 0.2f, {0.3f, 0.5f, 0.8f}), mirror, TwoSided{0, 1}},
           {Gives::density, Gives::atoms}}};
}

Sets ExamplesOf<Mixture>::sets() {
  const Bsdf diffuse = Lambertian{{0.7f, 0.5f, 0.2f}};
  const Bsdf metal = GgxConductor{{0.05f, 0.05f}, gold()};
  const Bsdf mirror = SmoothConductor{kNoLoss};
  const Bsdf glass = GgxDielectric{{0.2f, 0.2f}, {1.5f}};
  const Bsdf clear = SmoothDielectric{{1.5f}};
  return {
      {"diffuse and rough gold", {diffuse, metal, Mixture{0, 1, 0.3f}}, kDensityInFront},
      {"diffuse and mirror", {diffuse, mirror, Mixture{0, 1, 0.5f}}, {Gives::both, Gives::nothing}},
      {"mixture in mixture",
       {diffuse, metal, Mixture{0, 1, 0.4f}, mirror, Mixture{2, 3, 0.2f}},
       {Gives::both, Gives::nothing}},
      {"rough and clear glass", {glass, clear, Mixture{0, 1, 0.25f}}, {Gives::both, Gives::both}},
      {"two-sided mixture",
       {diffuse, metal, Mixture{0, 1, 0.9f}, TwoSided{2, 0}, Mixture{3, 3, 0.5f}},
       kDensity},
      {"nearly all of the second", {diffuse, metal, Mixture{0, 1, 0.999f}}, kDensityInFront}};
}

}  // namespace plumbline::tests
