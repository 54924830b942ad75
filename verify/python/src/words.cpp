#include "words.h"

#include <cstddef>
#include <stdexcept>

namespace plumbline::python {

namespace {

using verify::Verdict;

template <class T>
struct Name {
  std::string_view word;
  T value;
};

constexpr Name<Verdict> kVerdicts[] = {
    {"pass", Verdict::pass}, {"fail", Verdict::fail}, {"inconclusive", Verdict::inconclusive}};

template <class T, std::size_t n>
T named(const Name<T> (&names)[n], std::string_view what, std::string_view word) {
  std::string known;
  for (const Name<T>& name : names) {
    if (name.word == word) return name.value;
    known += (known.empty() ? "\"" : ", \"") + std::string(name.word) + "\"";
  }
  throw std::invalid_argument(std::string(what) + " is \"" + std::string(word) +
                              "\", wanted one of " + known);
}

}  // namespace

Verdict verdict_of(std::string_view word) { return named(kVerdicts, "expected", word); }

std::optional<std::string> cause_word(verify::CauseKind kind) {
  if (kind == verify::CauseKind::none) return std::nullopt;
  return std::string(to_string(kind));
}

}  // namespace plumbline::python
