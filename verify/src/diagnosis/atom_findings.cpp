#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/ask.h"
#include "diagnosis/direct.h"
#include "streams.h"
#include "text.h"
#include "vec3.h"

namespace plumbline::verify {

std::optional<Finding> find_atoms_with_density(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 1024;
  for (const ViewEvidence* v : views_to_ask(evidence)) {
    double atoms = 0, points = 0;
    for (const SampleRecord& s : draw_samples(*v, kSamples)) {
      (s.mass > 0 ? atoms : points) += 1;
      if (s.mass > 0 && s.pdf && *s.pdf > 0) {
        return Finding{CauseKind::atom_as_density, "a sample that is an atom of mass " +
                                                       number(s.mass) + " states a density, " +
                                                       number(*s.pdf)};
      }
    }
    if (atoms > 0 && points == 0 && v->mass && v->mass->integral > 10 * v->mass->integral_error &&
        v->mass->integral > 1e-6) {
      return Finding{
          CauseKind::atom_as_density,
          "all samples are atoms, but pdf() gives a density, ∫pdf = " + number(v->mass->integral)};
    }
  }
  return std::nullopt;
}

std::optional<Finding> find_atoms_of_other_mass(const ReportEvidence& evidence) {
  constexpr std::size_t kSamples = 20'000;
  constexpr double kSame = 1e-4, kCertain = 7;
  constexpr std::size_t kMostAtoms = 7;
  struct Seen {
    Vec3 x{};
    double mass = 0, count = 0;
  };
  for (const ViewEvidence& v : evidence.views) {
    if (!v.failed || v.pair->domain.dimension() == 0) continue;
    std::vector<Seen> atoms;
    Random random = random_for(Stream::atom_shares);
    for (const Record& s : draw_records(v, random, kSamples)) {
      if (!s || !(s->mass > 0) || !is_finite(s->x) || atoms.size() > kMostAtoms) continue;
      const auto same = std::find_if(atoms.begin(), atoms.end(), [&s](const Seen& a) {
        return length(sum(a.x, scaled(s->x, -1))) < kSame && std::abs(a.mass - s->mass) < kSame;
      });
      if (same == atoms.end()) {
        atoms.push_back({s->x, s->mass, 1});
      } else {
        ++same->count;
      }
    }
    if (atoms.size() > kMostAtoms) continue;  // far too many, and not all draws were looked at
    const auto pull = [](const Seen& a, double mass) {
      const double p = std::clamp(mass, 0.0, 1.0);
      return (a.count - double{kSamples} * mass) / std::sqrt(double{kSamples} * p * (1 - p) + 1);
    };
    for (const Seen& a : atoms) {
      if (!(std::abs(pull(a, a.mass)) > kCertain)) continue;
      const bool exchanged = atoms.size() == 2 &&
                             std::abs(pull(atoms[0], atoms[1].mass)) < kCertain &&
                             std::abs(pull(atoms[1], atoms[0].mass)) < kCertain;
      if (exchanged) {
        return Finding{CauseKind::lobe_probability,
                       "the masses of the two atoms are exchanged: " + number(a.mass) +
                           " is stated by the one that is chosen with probability " +
                           number(std::round(1e4 * a.count / double{kSamples}) / 1e4)};
      }
      return Finding{CauseKind::atom_as_density,
                     "an atom states a mass of " + number(a.mass) + ", but " +
                         percent(a.count / double{kSamples}) + " of the samples are drawn there"};
    }
  }
  return std::nullopt;
}

}  // namespace plumbline::verify
