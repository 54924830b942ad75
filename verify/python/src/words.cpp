#include "words.h"

#include <cstddef>
#include <stdexcept>

namespace plumbline::python {

namespace {

using verify::Verdict;
using Frame = verify::BsdfConventions::Frame;
using Weight = verify::BsdfConventions::Weight;

template <class T>
struct Name {
  std::string_view word;
  T value;
};

constexpr Name<Verdict> kVerdicts[] = {
    {"pass", Verdict::pass}, {"fail", Verdict::fail}, {"inconclusive", Verdict::inconclusive}};

constexpr Name<Frame> kFrames[] = {
    {"z-up", Frame::local_z_up}, {"y-up", Frame::local_y_up}, {"world", Frame::world}};

constexpr Name<Weight> kWeights[] = {{"throughput", Weight::throughput},
                                     {"f", Weight::f},
                                     {"f-cosine", Weight::f_cosine},
                                     {"unused", Weight::unused}};

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

Frame frame_of(std::string_view word) { return named(kFrames, "frame", word); }

Weight weight_of(std::string_view word) { return named(kWeights, "weight", word); }

std::optional<std::string> cause_word(verify::CauseKind kind) {
  if (kind == verify::CauseKind::none) return std::nullopt;
  return std::string(to_string(kind));
}

}  // namespace plumbline::python
