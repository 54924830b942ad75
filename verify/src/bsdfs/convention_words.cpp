#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <plumbline/verify/conventions.h>

namespace plumbline::verify::conventions {

namespace {

using C = BsdfConventions;

constexpr Word kWords[] = {
    {"pbrt", "pbrt-v4", true, [](C& c) { c = pbrt(); }},
    {"mitsuba", "Mitsuba 3", true, [](C& c) { c = mitsuba(); }},
    {"nori", "Nori", true, [](C& c) { c = nori(); }},
    {"osl", "Open Shading Language's testrender", true, [](C& c) { c = osl(); }},
    {"openpbr", "OpenPBR's viewer", true, [](C& c) { c = openpbr(); }},
    {"falcor", "Falcor", true, [](C& c) { c = falcor(); }},
    {"blender", "Blender Cycles", true, [](C& c) { c = blender(); }},
    {"cosine-in-eval", "eval is f·|cosθi|", false, [](C& c) { c.cosine_in_eval = true; }},
    {"eval-over-pdf", "eval is f·|cosθi|/pdf", false, [](C& c) { c.eval_over_pdf = true; }},
    {"without-eta-squared", "f of what is refracted lacks η²", false,
     [](C& c) { c.without_eta_squared = true; }},
    {"fibre-cosine", "z is the tangent of a hair, its cosine √(1 − z²)", false,
     [](C& c) { c.cosine = C::Cosine::fibre; }},
    {"sampled-direction-first", "eval and pdf take (wi, wo)", false,
     [](C& c) { c.sampled_direction_first = true; }},
    {"given-points-in", "wo points towards the surface", false,
     [](C& c) { c.given_points_in = true; }},
    {"y-up", "y is the normal", false, [](C& c) { c.frame = C::Frame::local_y_up; }},
    {"zero-pdf-is-failure", "a pdf of 0 means that nothing was sampled", false,
     [](C& c) { c.zero_pdf_is_failure = true; }},
    {"projected-pdf", "pdf is per projected solid angle", false,
     [](C& c) { c.projected_pdf = true; }},
    {"weight-is-f", "the weight is f", false, [](C& c) { c.weight = C::Weight::f; }},
    {"weight-is-f-cosine", "the weight is f·|cosθi|", false,
     [](C& c) { c.weight = C::Weight::f_cosine; }},
    {"weight-unused", "the weight is not checked", false,
     [](C& c) { c.weight = C::Weight::unused; }},
};

constexpr std::string_view kNormal = "normal:";

/// Three numbers with commas between.
std::optional<Vec3> vector_of(std::string_view text) {
  Vec3 v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto read = std::from_chars(text.data(), text.data() + text.size(), v[i]);
    if (read.ec != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    const bool last = i + 1 == v.size();
    if (last ? !text.empty() : !text.starts_with(',')) return std::nullopt;
    if (!last) text.remove_prefix(1);
  }
  return v;
}

void put_normal(const std::string& word, BsdfConventions& conventions) {
  const auto normal = vector_of(std::string_view(word).substr(kNormal.size()));
  const double length = normal ? std::hypot((*normal)[0], (*normal)[1], (*normal)[2]) : 0;
  if (!(length > 0) || std::isinf(length)) {
    throw std::invalid_argument(word + ": must read normal:X,Y,Z, finite and not all 0");
  }
  conventions.frame = C::Frame::world;
  for (std::size_t i = 0; i < 3; ++i) conventions.normal[i] = (*normal)[i] / length;
}

const Word& find(std::string_view word) {
  for (const Word& known : kWords) {
    if (known.word == word) return known;
  }
  throw std::invalid_argument(std::string(word) + ": there is no such convention");
}

}  // namespace

std::span<const Word> words() { return kWords; }

BsdfConventions from_words(std::span<const std::string> words) {
  BsdfConventions conventions;
  for (const std::string& word : words) {
    if (word.starts_with(kNormal)) {
      put_normal(word, conventions);
      continue;
    }
    const Word& known = find(word);
    if (known.all && &word != words.data()) {
      throw std::invalid_argument(word + ": says all conventions and must come first");
    }
    known.put(conventions);
  }
  return conventions;
}

}  // namespace plumbline::verify::conventions
