#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/record_access.h>
#include <plumbline/verify/detail/vector_access.h>
#include <plumbline/verify/pair.h>

namespace plumbline::verify {

/// How a BSDF's author writes things down, one option per difference. The defaults are Plumbline's
/// own.
struct BsdfConventions {
  /// eval returns f·|cosθi| instead of f.
  bool cosine_in_eval = false;

  /// eval and pdf take (wi, wo): first the direction that was sampled.
  bool sampled_direction_first = false;

  /// The given direction points towards the surface, like a ray that arrives.
  bool given_points_in = false;

  enum class Frame {
    local_z_up,  ///< z is the normal
    local_y_up,  ///< y is the normal
    world        ///< directions are in world space, around `normal`
  };
  Frame frame = Frame::local_z_up;
  Vec3 normal{0, 0, 1};  ///< unit, for Frame::world

  /// A record with pdf 0 means that the sample failed.
  bool zero_pdf_is_failure = false;

  /// pdf is per projected solid angle: pdf_w = pdf·|cosθi|.
  bool projected_pdf = false;

  /// What the record calls weight or value.
  enum class Weight {
    throughput,  ///< f·|cosθi|/pdf
    f,           ///< f
    f_cosine,    ///< f·|cosθi|
    unused       ///< nothing that is to be checked
  };
  Weight weight = Weight::throughput;
};

/// What a sampled record says, in the checks' own terms.
struct BsdfRecord {
  Vec3 wi{};
  Channels weight;
  double pdf = kNotApplicable;
  double mass = 0;
};

/// A lobe of a BSDF that exposes its lobes.
struct BsdfLobe {
  std::function<double(const Vec3& wo)> probability;
  std::function<std::optional<BsdfRecord>(const Vec3& wo, const Uniforms&)> sample;
  std::function<double(const Vec3& wo, const Vec3& wi)> pdf;
};

/// A BSDF with its types erased and its conventions brought to Plumbline's: local frame, z the
/// normal, all directions away from the surface, eval without cosine, pdf per solid angle.
struct ErasedBsdf {
  double epsilon = 0x1p-53;  ///< rounding unit of its arithmetic
  int numbers = 2;           ///< uniform numbers that sample takes
  std::function<std::optional<BsdfRecord>(const Vec3& wo, const Uniforms&)> sample;
  std::function<std::optional<BsdfRecord>(const Vec3& wo, Random&)> draw;  ///< or this
  std::function<double(const Vec3& wo, const Vec3& wi)> pdf;
  std::function<Channels(const Vec3& wo, const Vec3& wi)> eval;
  std::vector<BsdfLobe> lobes;  ///< empty: not exposed
};

/// Brings a BSDF from its author's conventions to Plumbline's.
ErasedBsdf apply_conventions(ErasedBsdf raw, const BsdfConventions& conventions);

namespace detail {

/// Direction that `pdf` takes and numbers that `sample` takes, where a plain member function says
/// so.
template <class F>
struct MemberArguments {
  using first = void;
  using second = void;
};
template <class R, class C, class A, class B, class... Rest>
struct MemberArguments<R (C::*)(A, B, Rest...) const> {
  using first = std::remove_cvref_t<A>;
  using second = std::remove_cvref_t<B>;
};

template <class B, class Given>
auto direction_type() {
  if constexpr (!std::is_void_v<Given>) {
    return std::type_identity<Given>{};
  } else if constexpr (requires { &B::pdf; }) {
    return std::type_identity<typename MemberArguments<decltype(&B::pdf)>::first>{};
  } else {
    return std::type_identity<void>{};
  }
}

template <class B, class Given>
auto numbers_type() {
  if constexpr (!std::is_void_v<Given>) {
    return std::type_identity<Given>{};
  } else if constexpr (requires { &B::sample; }) {
    return std::type_identity<typename MemberArguments<decltype(&B::sample)>::second>{};
  } else {
    return std::type_identity<void>{};
  }
}

/// A generator of the user's own that a check can seed.
template <class G>
concept SeededGenerator = requires(typename G::result_type seed) {
  G(seed);
  G::min();
  G::max();
};

/// How `sample` wants its random numbers.
enum class NumbersStyle { generator, own_generator, three, two, vector };

template <class B, class D, class T, class N>
constexpr NumbersStyle numbers_style() {
  if constexpr (requires(const B& b, const D& d, Random& r) { b.sample(d, r); }) {
    return NumbersStyle::generator;
  } else if constexpr (SeededGenerator<N>) {
    return NumbersStyle::own_generator;
  } else if constexpr (requires(const B& b, const D& d, T u) { b.sample(d, u, u, u); }) {
    return NumbersStyle::three;
  } else if constexpr (requires(const B& b, const D& d, T u) { b.sample(d, u, u); }) {
    return NumbersStyle::two;
  } else {
    static_assert(!std::is_void_v<N>,
                  "sample takes neither numbers nor a verify::Random: name the type of its random "
                  "numbers or of its generator, check_bsdf<Direction, Numbers>(…)");
    return NumbersStyle::vector;
  }
}

template <class N>
constexpr int numbers_in_vector() {
  if constexpr (HasXyz<N>) {
    return 3;
  } else {
    return 2;
  }
}

template <class B, class D, class T, class N>
std::vector<BsdfLobe> erase_lobes(const B& bsdf) {
  std::vector<BsdfLobe> lobes;
  const auto count = bsdf.lobe_count();
  if (count < 2) return lobes;
  for (std::remove_const_t<decltype(count)> i = 0; i < count; ++i) {
    BsdfLobe lobe;
    lobe.probability = [bsdf, i](const Vec3& wo) {
      return static_cast<double>(bsdf.lobe_probability(from_vec3<D>(wo), i));
    };
    lobe.sample = [bsdf, i](const Vec3& wo, const Uniforms& u) {
      return read_record(bsdf.sample_lobe(from_vec3<D>(wo), i, from_point<N>(u)));
    };
    lobe.pdf = [bsdf, i](const Vec3& wo, const Vec3& wi) {
      return static_cast<double>(bsdf.pdf_lobe(from_vec3<D>(wo), from_vec3<D>(wi), i));
    };
    lobes.push_back(std::move(lobe));
  }
  return lobes;
}

template <class B, class D, class T, class N>
ErasedBsdf erase(const B& bsdf) {
  constexpr NumbersStyle style = numbers_style<B, D, T, N>();
  ErasedBsdf e;
  e.epsilon = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
  e.pdf = [bsdf](const Vec3& wo, const Vec3& wi) {
    return static_cast<double>(bsdf.pdf(from_vec3<D>(wo), from_vec3<D>(wi)));
  };
  e.eval = [bsdf](const Vec3& wo, const Vec3& wi) {
    return to_channels(bsdf.eval(from_vec3<D>(wo), from_vec3<D>(wi)));
  };
  if constexpr (style == NumbersStyle::generator) {
    e.draw = [bsdf](const Vec3& wo, Random& random) {
      return read_record(bsdf.sample(from_vec3<D>(wo), random));
    };
  } else if constexpr (style == NumbersStyle::own_generator) {
    // Seeded for each sample, so that a sample depends on nothing but the check's seed.
    e.draw = [bsdf](const Vec3& wo, Random& random) {
      N generator(static_cast<typename N::result_type>(random.bits()));
      return read_record(bsdf.sample(from_vec3<D>(wo), generator));
    };
  } else if constexpr (style == NumbersStyle::three) {
    e.numbers = 3;
    e.sample = [bsdf](const Vec3& wo, const Uniforms& u) {
      return read_record(bsdf.sample(from_vec3<D>(wo), static_cast<T>(u[0]), static_cast<T>(u[1]),
                                     static_cast<T>(u[2])));
    };
  } else if constexpr (style == NumbersStyle::two) {
    e.sample = [bsdf](const Vec3& wo, const Uniforms& u) {
      return read_record(bsdf.sample(from_vec3<D>(wo), static_cast<T>(u[0]), static_cast<T>(u[1])));
    };
  } else {
    e.numbers = numbers_in_vector<N>();
    e.sample = [bsdf](const Vec3& wo, const Uniforms& u) {
      return read_record(bsdf.sample(from_vec3<D>(wo), from_point<N>(u)));
    };
    if constexpr (requires { bsdf.lobe_count(); }) e.lobes = erase_lobes<B, D, T, N>(bsdf);
  }
  return e;
}

}  // namespace detail

/// Erases the types of a BSDF with
///   sample(wo, u)   u: two numbers, three, a vector of two or three, or a generator: a
///                   verify::Random& or one of its own with result_type, min, max and a constructor
///                   from a seed; returns a record, an optional or a pointer to one, with wi (or
///                   direction, dir, w), and if it has them weight (value, throughput, f), pdf_w
///                   (pdf), mass or is_delta
///   pdf(wo, wi)
///   eval(wo, wi)    a number, or a colour with r, g, b or x, y, z, or anything with size() and [],
/// and, if it exposes its lobes,
///   lobe_count(), lobe_probability(wo, i), sample_lobe(wo, i, u), pdf_lobe(wo, wi, i).
/// It is copied.
template <class Direction = void, class Numbers = void, class B>
ErasedBsdf erase_bsdf(const B& bsdf, const BsdfConventions& conventions = {}) {
  using D = typename decltype(detail::direction_type<B, Direction>())::type;
  static_assert(!std::is_void_v<D>,
                "pdf is a template or overloaded: name the vector type, check_bsdf<Direction>(…)");
  using N = typename decltype(detail::numbers_type<B, Numbers>())::type;
  return apply_conventions(detail::erase<B, D, ScalarOf<D>, N>(bsdf), conventions);
}

}  // namespace plumbline::verify
