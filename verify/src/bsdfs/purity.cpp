#include "bsdfs/purity.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "directions.h"
#include "pairs/batches.h"
#include "pairs/uniforms.h"
#include "streams.h"

namespace plumbline::verify {

namespace {

constexpr std::size_t kQuestions = 512;

/// The same bits; a NaN is itself.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <std::size_t N>
bool same(const std::array<double, N>& a, const std::array<double, N>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same(x, y); });
}

bool same(const Channels& a, const Channels& b) {
  return a.count == b.count && same(a.value, b.value);
}

bool same(const Record& a, const Record& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return same(a->x, b->x) && same(a->weight, b->weight) && same(a->mass, b->mass) &&
         a->pdf.has_value() == b->pdf.has_value() && same(a->pdf.value_or(0), b->pdf.value_or(0));
}

template <class T>
std::vector<T> reversed(const std::vector<T>& v) {
  return {v.rbegin(), v.rend()};
}

template <class R, class A>
std::vector<R> answers(const Many<R(Vec3, A)>& f, const std::vector<Vec3>& wo,
                       const std::vector<A>& a) {
  std::vector<R> values(a.size());
  for (std::size_t first = 0; first < a.size(); first += f.batch()) {
    const std::size_t now = std::min(f.batch(), a.size() - first);
    f(std::span(wo).subspan(first, now), std::span(a).subspan(first, now),
      std::span(values).subspan(first, now));
  }
  return values;
}

template <class R>
void require_same(const std::string& name, const char* what, const std::vector<R>& there,
                  const std::vector<R>& back) {
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (same(there[i], back[back.size() - 1 - i])) continue;
    throw std::invalid_argument("'" + name + "' cannot be looked at by several threads: " + what +
                                " gives something else for the same input when it is asked in "
                                "another order (a state that it keeps?)");
  }
}

/// Forwards, then backwards.
template <class R, class A>
void ask_twice(const std::string& name, const char* what, const Many<R(Vec3, A)>& f,
               const std::vector<Vec3>& wo, const std::vector<A>& a) {
  require_same(name, what, answers(f, wo, a), answers(f, reversed(wo), reversed(a)));
}

}  // namespace

void require_pure(const std::string& name, const ErasedBsdf& bsdf, std::uint64_t seed) {
  Random random = random_for(seed, Stream::purity);
  std::vector<Vec3> wo(kQuestions), wi(kQuestions);
  std::vector<Uniforms> u(kQuestions);
  std::vector<Random> generators;
  for (std::size_t i = 0; i < kQuestions; ++i) {
    wo[i] = uniform_direction(random);
    wi[i] = uniform_direction(random);
    u[i] = draw_uniforms(random, bsdf.numbers, bsdf.epsilon);
    generators.emplace_back(random.bits());
  }
  ask_twice(name, "pdf", bsdf.pdf, wo, wi);
  ask_twice(name, "eval", bsdf.eval, wo, wi);
  if (!bsdf.draw) return ask_twice(name, "sample", bsdf.sample, wo, u);
  std::vector<Record> there(kQuestions), back(kQuestions);
  for (std::size_t i = 0; i < kQuestions; ++i) {
    Random again = generators[i];
    there[i] = bsdf.draw(wo[i], again);
  }
  for (std::size_t i = kQuestions; i-- > 0;) {
    Random again = generators[i];
    back[kQuestions - 1 - i] = bsdf.draw(wo[i], again);
  }
  require_same(name, "sample", there, back);
}

}  // namespace plumbline::verify
