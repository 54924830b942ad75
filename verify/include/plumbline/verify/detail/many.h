#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace plumbline::verify {

template <class Signature>
class Many;

/// A function that is asked for many values at once, or for one. Made from code that answers one by
/// one, as most is written; from code that takes and fills spans: vector instructions, another
/// process, another language, for which a call costs more than a value does; or from code that does
/// both.
///
///   Many<double(Vec3)> pdf = [](const Vec3& wi) { return wi[2] / pi; };
///   pdf = [](std::span<const Vec3> wi, std::span<double> out) { … };
///
/// Copies share the function. Values must not depend on which others are asked for with them, or in
/// which order.
template <class R, class... A>
class Many<R(A...)> {
  template <class F>
  static constexpr bool answers_one = std::is_invocable_r_v<R, F&, const A&...>;
  template <class F>
  static constexpr bool answers_spans =
      std::is_invocable_v<F&, std::span<const A>..., std::span<R>>;

 public:
  /// Values that are worth a call where code answers one by one: as many as caches hold.
  static constexpr std::size_t kOneByOne = 512;
  /// The same of code that takes spans alone.
  static constexpr std::size_t kInSpans = std::size_t{1} << 16;

  Many() = default;
  Many(std::nullptr_t) {}

  template <class F>
  requires(!std::same_as<F, Many> && (answers_one<F> || answers_spans<F>)) Many(F f)
      : Many(std::move(f), answers_one<F> ? kOneByOne : kInSpans) {}

  /// @param batch  how many values are worth a call
  template <class F>
  requires(answers_one<F> || answers_spans<F>) Many(F f, std::size_t batch) : batch_(batch) {
    if (is_there(f)) function_ = std::make_shared<Holder<F>>(std::move(f));
  }

  explicit operator bool() const { return function_ != nullptr; }

  /// @throws std::bad_function_call where there is none; so does the other
  R operator()(const A&... a) const { return function().one(a...); }

  /// @param a    as many of each as `out` has room for
  /// @throws std::invalid_argument unless they are
  void operator()(std::span<const A>... a, std::span<R> out) const {
    if (!((a.size() == out.size()) && ...)) {
      throw std::invalid_argument("spans of different sizes");
    }
    if (!out.empty()) function().many(a..., out);
  }

  std::size_t batch() const { return batch_; }

 private:
  struct Function {
    Function() = default;
    Function(const Function&) = delete;
    Function& operator=(const Function&) = delete;
    virtual ~Function() = default;
    virtual R one(const A&... a) = 0;
    virtual void many(std::span<const A>... a, std::span<R> out) = 0;
  };

  template <class F>
  struct Holder : Function {
    F f;
    explicit Holder(F function) : f(std::move(function)) {}

    R one(const A&... a) override {
      if constexpr (answers_one<F>) {
        return f(a...);
      } else {
        R out{};
        f(std::span<const A>(&a, 1)..., std::span<R>(&out, 1));
        return out;
      }
    }

    void many(std::span<const A>... a, std::span<R> out) override {
      if constexpr (answers_spans<F>) {
        f(a..., out);
      } else {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = f(a[i]...);
      }
    }
  };

  Function& function() const {
    if (!function_) throw std::bad_function_call();
    return *function_;
  }

  /// Pointers and functions that may be empty say so.
  template <class F>
  static bool is_there(const F& f) {
    if constexpr (std::is_constructible_v<bool, const F&>) {
      return static_cast<bool>(f);
    } else {
      return true;
    }
  }

  std::shared_ptr<Function> function_;
  std::size_t batch_ = kOneByOne;
};

}  // namespace plumbline::verify
