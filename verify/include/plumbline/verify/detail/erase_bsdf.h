#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
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

  /// eval returns f·|cosθi|/pdf, what pdf() is to be multiplied by.
  bool eval_over_pdf = false;

  /// f of what is refracted lacks the square of the relative index that radiance gains or loses.
  bool without_eta_squared = false;

  enum class Cosine {
    surface,  ///< |z|, z the normal
    fibre     ///< √(1 − z²), z the tangent of a curve or hair
  };
  Cosine cosine = Cosine::surface;

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

  /// A pdf of 0 means that the sample failed: the one in the record, or where it states none, the
  /// one that pdf() gives.
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

  friend bool operator==(const BsdfConventions&, const BsdfConventions&) = default;
};

/// A lobe of a BSDF that exposes its lobes.
struct BsdfLobe {
  std::function<double(const Vec3& wo)> probability;
  Many<std::optional<SampleRecord>(Vec3, Uniforms)> sample;                       ///< of wo, u
  Many<double(Vec3, Vec3)> pdf;                                                   ///< of wo, wi
  std::function<std::optional<SampleRecord>(const Vec3& wo, Random&)> draw = {};  ///< or `sample`
  int numbers = 2;  ///< uniform numbers that `sample` takes
};

/// A BSDF with its types erased and its conventions brought to Plumbline's: local frame, z the
/// normal, all directions away from the surface, eval without cosine, pdf per solid angle.
struct ErasedBsdf {
  double epsilon = 0x1p-53;                                  ///< rounding unit of its arithmetic
  int numbers = 2;                                           ///< uniform numbers that sample takes
  Many<std::optional<SampleRecord>(Vec3, Uniforms)> sample;  ///< of wo, u
  std::function<std::optional<SampleRecord>(const Vec3& wo, Random&)> draw;  ///< or this
  Many<double(Vec3, Vec3)> pdf;                                              ///< of wo, wi
  Many<Channels(Vec3, Vec3)> eval;                                           ///< of wo, wi
  std::vector<BsdfLobe> lobes;                                               ///< empty: not exposed

  // What no translation takes out: what f is, not how it is written down.
  bool without_eta_squared = false;
  BsdfConventions::Cosine cosine = BsdfConventions::Cosine::surface;

  /// |cosθ| of a direction.
  double cosine_of(const Vec3& w) const;
};

/// Brings a BSDF from its author's conventions to Plumbline's.
ErasedBsdf apply_conventions(ErasedBsdf bsdf, const BsdfConventions& conventions);

namespace detail {

/// Argument number I of a plain function, where its type says so; else void.
template <std::size_t I, class F>
struct ArgumentOf {
  using type = void;
};
template <std::size_t I, class... A>
struct NthOf {
  using type = void;
};
template <std::size_t I, class... A>
requires(I < sizeof...(A)) struct NthOf<I, A...> {
  using type = std::remove_cvref_t<std::tuple_element_t<I, std::tuple<A...>>>;
};
template <std::size_t I, class R, class C, class... A, bool N>
struct ArgumentOf<I, R (C::*)(A...) const noexcept(N)> : NthOf<I, A...> {};
template <std::size_t I, class R, class... A, bool N>
struct ArgumentOf<I, R (*)(A...) noexcept(N)> : NthOf<I, A...> {};

/// Its vector type.
template <class B, class Given>
auto direction_type() {
  if constexpr (!std::is_void_v<Given>) {
    return std::type_identity<Given>{};
  } else if constexpr (requires { &B::pdf; }) {
    return ArgumentOf<0, decltype(&B::pdf)>{};
  } else {
    return std::type_identity<void>{};
  }
}

/// Type of the random numbers of `sample`.
template <class B, class Given>
auto numbers_type() {
  if constexpr (!std::is_void_v<Given>) {
    return std::type_identity<Given>{};
  } else if constexpr (requires { &B::sample; }) {
    return ArgumentOf<1, decltype(&B::sample)>{};
  } else {
    return std::type_identity<void>{};
  }
}

/// Type of the random numbers of `sample_lobe`.
template <class B>
auto lobe_numbers_type() {
  if constexpr (requires { &B::sample_lobe; }) {
    return ArgumentOf<2, decltype(&B::sample_lobe)>{};
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

/// `sample` as a function of wo and of what it takes as random numbers. Holds the user's object.
template <class B>
struct SampleOf {
  std::shared_ptr<const B> bsdf;

  template <class D, class... U>
  requires requires(const B& b, const D& wo, U&&... u) { b.sample(wo, std::forward<U>(u)...); }
  auto operator()(const D& wo, U&&... u) const { return bsdf->sample(wo, std::forward<U>(u)...); }
};

/// The same of one lobe.
template <class B>
struct SampleLobeOf {
  using Index = std::remove_cvref_t<decltype(std::declval<const B&>().lobe_count())>;
  std::shared_ptr<const B> bsdf;
  Index lobe;

  template <class D, class... U>
  requires requires(const B& b, const D& wo, Index i, U&&... u) {
    b.sample_lobe(wo, i, std::forward<U>(u)...);
  }
  auto operator()(const D& wo, U&&... u) const {
    return bsdf->sample_lobe(wo, lobe, std::forward<U>(u)...);
  }
};

/// How a sampler wants its random numbers.
enum class NumbersStyle { generator, own_generator, three, two, vector, unknown };

template <class Sampler, class D, class N>
constexpr NumbersStyle numbers_style() {
  using T = ScalarOf<D>;
  if constexpr (std::is_invocable_v<const Sampler&, const D&, Random&>) {
    return NumbersStyle::generator;
  } else if constexpr (std::is_invocable_v<const Sampler&, const D&, T, T, T>) {
    return NumbersStyle::three;
  } else if constexpr (std::is_invocable_v<const Sampler&, const D&, T, T>) {
    return NumbersStyle::two;
  } else if constexpr (SeededGenerator<N>) {
    return std::is_invocable_v<const Sampler&, const D&, N&> ? NumbersStyle::own_generator
                                                             : NumbersStyle::unknown;
  } else if constexpr ((HasXy<N> || HasIndex<N>)&&!std::is_pointer_v<N>) {
    return std::is_invocable_v<const Sampler&, const D&, const N&> ? NumbersStyle::vector
                                                                   : NumbersStyle::unknown;
  } else {
    return NumbersStyle::unknown;
  }
}

/// Gives a BSDF or a lobe the `sample` or the `draw` that fits.
template <class D, class N, class Erased, class Sampler>
void put_sampler(Erased& e, const Sampler& sampler) {
  using T = ScalarOf<D>;
  constexpr NumbersStyle style = numbers_style<Sampler, D, N>();
  if constexpr (style == NumbersStyle::generator) {
    e.draw = [sampler](const Vec3& wo, Random& random) {
      return read_record(sampler(from_vec3<D>(wo), random));
    };
  } else if constexpr (style == NumbersStyle::own_generator) {
    // Seeded for each sample, so that a sample depends on nothing but the check's seed.
    e.draw = [sampler](const Vec3& wo, Random& random) {
      N generator(static_cast<typename N::result_type>(random.bits()));
      return read_record(sampler(from_vec3<D>(wo), generator));
    };
  } else if constexpr (style == NumbersStyle::three) {
    e.numbers = 3;
    e.sample = [sampler](const Vec3& wo, const Uniforms& u) {
      return read_record(sampler(from_vec3<D>(wo), static_cast<T>(u[0]), static_cast<T>(u[1]),
                                 static_cast<T>(u[2])));
    };
  } else if constexpr (style == NumbersStyle::two) {
    e.sample = [sampler](const Vec3& wo, const Uniforms& u) {
      return read_record(sampler(from_vec3<D>(wo), static_cast<T>(u[0]), static_cast<T>(u[1])));
    };
  } else {
    e.numbers = has_two_components<N>() ? 2 : 3;
    e.sample = [sampler](const Vec3& wo, const Uniforms& u) {
      return read_record(sampler(from_vec3<D>(wo), from_point<N>(u)));
    };
  }
}

/// @tparam N  type of the random numbers that was named, if any
template <class B, class D, class N>
std::vector<BsdfLobe> erase_lobes(const std::shared_ptr<const B>& bsdf) {
  using Index = typename SampleLobeOf<B>::Index;
  using Found = typename decltype(lobe_numbers_type<B>())::type;
  // A sampler by numbers may have lobes by a vector, and the other way round.
  constexpr bool fits =
      numbers_style<SampleLobeOf<B>, D, N>() != NumbersStyle::unknown || std::is_void_v<Found>;
  using Numbers = std::conditional_t<fits, N, Found>;
  static_assert(numbers_style<SampleLobeOf<B>, D, Numbers>() != NumbersStyle::unknown,
                "lobe_count() is there, but no sample_lobe(wo, i, u) is understood: u may be two "
                "numbers, three, a vector (name its type, check_bsdf<Direction, Numbers>(…), where "
                "sample_lobe is overloaded or a template), or a generator");
  static_assert(
      requires(const B& b, const D& w, Index i) { static_cast<double>(b.pdf_lobe(w, w, i)); },
      "lobe_count() is there, but no pdf_lobe(wo, wi, i)");
  static_assert(
      requires(const B& b, const D& w, Index i) { static_cast<double>(b.lobe_probability(w, i)); },
      "lobe_count() is there, but no lobe_probability(wo, i)");
  std::vector<BsdfLobe> lobes;
  const Index count = bsdf->lobe_count();
  if (count < Index{2}) return lobes;
  for (Index i{0}; i < count; ++i) {
    BsdfLobe lobe;
    lobe.probability = [bsdf, i](const Vec3& wo) {
      return static_cast<double>(bsdf->lobe_probability(from_vec3<D>(wo), i));
    };
    put_sampler<D, Numbers>(lobe, SampleLobeOf<B>{bsdf, i});
    lobe.pdf = [bsdf, i](const Vec3& wo, const Vec3& wi) {
      return static_cast<double>(bsdf->pdf_lobe(from_vec3<D>(wo), from_vec3<D>(wi), i));
    };
    lobes.push_back(std::move(lobe));
  }
  return lobes;
}

template <class B, class D, class N>
ErasedBsdf erase(const std::shared_ptr<const B>& bsdf) {
  static_assert(numbers_style<SampleOf<B>, D, N>() != NumbersStyle::unknown,
                "sample takes neither numbers nor a verify::Random: name the type of its random "
                "numbers or of its generator, check_bsdf<Direction, Numbers>(…)");
  ErasedBsdf e;
  e.epsilon = std::is_same_v<ScalarOf<D>, float> ? 0x1p-24 : 0x1p-53;
  put_sampler<D, N>(e, SampleOf<B>{bsdf});
  e.pdf = [bsdf](const Vec3& wo, const Vec3& wi) {
    return static_cast<double>(bsdf->pdf(from_vec3<D>(wo), from_vec3<D>(wi)));
  };
  e.eval = [bsdf](const Vec3& wo, const Vec3& wi) {
    return to_channels(bsdf->eval(from_vec3<D>(wo), from_vec3<D>(wi)));
  };
  if constexpr (requires { bsdf->lobe_count(); }) e.lobes = erase_lobes<B, D, N>(bsdf);
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
/// The object is held, not copied, and must not change.
template <class Direction = void, class Numbers = void, class MaybeConst>
ErasedBsdf erase_bsdf(const std::shared_ptr<MaybeConst>& bsdf,
                      const BsdfConventions& conventions = {}) {
  using B = std::remove_const_t<MaybeConst>;
  using D = typename decltype(detail::direction_type<B, Direction>())::type;
  static_assert(!std::is_void_v<D>,
                "pdf is a template or overloaded: name the vector type, check_bsdf<Direction>(…)");
  using N = typename decltype(detail::numbers_type<B, Numbers>())::type;
  return apply_conventions(detail::erase<B, D, N>(std::shared_ptr<const B>(bsdf)), conventions);
}

/// The same; the object is copied once.
template <class Direction = void, class Numbers = void, class B>
ErasedBsdf erase_bsdf(const B& bsdf, const BsdfConventions& conventions = {}) {
  return erase_bsdf<Direction, Numbers>(std::shared_ptr<const B>(std::make_shared<B>(bsdf)),
                                        conventions);
}

}  // namespace plumbline::verify
