#pragma once

#include <span>
#include <string>
#include <string_view>

#include <plumbline/verify/detail/erase_bsdf.h>

/// How the renderers that people know write BSDFs down, for `BsdfOptions::conventions`: what their
/// interfaces say, in a table in docs/conventions.md. In all of them both directions point away
/// from the surface and pdf is per solid angle; a pdf of 0 means that nothing was sampled.
namespace plumbline::verify::conventions {

/// pbrt-v4, BxDF: f(wo, wi) without the cosine; Sample_f gives f and pdf.
inline BsdfConventions pbrt() {
  BsdfConventions c;
  c.weight = BsdfConventions::Weight::f;
  c.zero_pdf_is_failure = true;
  return c;
}

/// Mitsuba 3, BSDF: eval with the cosine; sample gives the throughput weight f·|cosθ|/pdf.
inline BsdfConventions mitsuba() {
  BsdfConventions c;
  c.cosine_in_eval = true;
  c.zero_pdf_is_failure = true;
  return c;
}

/// Nori, BSDF: eval without the cosine; sample gives f·|cosθ|/pdf and no pdf.
inline BsdfConventions nori() {
  BsdfConventions c;
  c.zero_pdf_is_failure = true;
  return c;
}

/// Open Shading Language, testrender and BSDL: eval gives the weight f·|cosθ|/pdf beside its pdf,
/// as sample does; refraction without η².
inline BsdfConventions osl() {
  BsdfConventions c;
  c.eval_over_pdf = true;
  c.without_eta_squared = true;
  c.zero_pdf_is_failure = true;
  return c;
}

/// OpenPBR's viewer (GLSL): f without the cosine; sample gives f and pdf.
inline BsdfConventions openpbr() { return pbrt(); }

/// Falcor, IMaterialInstance and IBxDF: eval with the cosine; sample gives f·|cosθ|/pdf.
inline BsdfConventions falcor() { return mitsuba(); }

/// Blender Cycles, closures: eval and the value of a sample with the cosine; refraction without η².
inline BsdfConventions blender() {
  BsdfConventions c;
  c.cosine_in_eval = true;
  c.weight = BsdfConventions::Weight::f_cosine;
  c.without_eta_squared = true;
  c.zero_pdf_is_failure = true;
  return c;
}

/// What a convention is called on command lines and in other languages.
struct Word {
  std::string_view word;  ///< "mitsuba", "y-up"
  std::string_view meaning;
  bool all = false;  ///< the whole of a renderer's conventions
  void (*put)(BsdfConventions&) = nullptr;
};

/// All of them: names of renderers, then single conventions.
std::span<const Word> words();

/// @param words  those of `words()`, a renderer's name before single ones; and normal:X,Y,Z, the
///               normal in world space, of any length but 0
/// @throws std::invalid_argument for a word that is not known, or a name that comes later
BsdfConventions from_words(std::span<const std::string> words);

}  // namespace plumbline::verify::conventions
