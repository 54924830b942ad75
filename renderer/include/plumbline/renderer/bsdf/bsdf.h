#pragma once

#include <concepts>
#include <optional>
#include <type_traits>
#include <variant>

#include <plumbline/renderer/bsdf/bsdf_sample.h>
#include <plumbline/renderer/bsdf/lambertian.h>

namespace plumbline::renderer {

/// What every BSDF offers, in any scalar: f, a sample and its density, in the same argument order.
template <class B>
concept BsdfModel = requires(const B& bsdf, const Vec3<double>& w, const Vec2<double>& u) {
  { bsdf.eval(w, w) } -> std::same_as<Rgb<double>>;
  { bsdf.sample(w, u) } -> std::same_as<std::optional<BsdfSample<double>>>;
  { bsdf.pdf(w, w) } -> std::same_as<double>;
};

/// Every BSDF of the renderer. The tests walk this list: an alternative without example parameters
/// does not compile there.
using Bsdf = std::variant<Lambertian>;

static_assert(BsdfModel<Lambertian>);

template <class T>
Rgb<T> eval(const Bsdf& bsdf, const Vec3<T>& wo, const Vec3<T>& wi) {
  return std::visit([&](const auto& b) { return b.eval(wo, wi); }, bsdf);
}

template <class T>
std::optional<BsdfSample<T>> sample(const Bsdf& bsdf, const Vec3<T>& wo, const Vec2<T>& u) {
  return std::visit([&](const auto& b) { return b.sample(wo, u); }, bsdf);
}

template <class T>
T pdf(const Bsdf& bsdf, const Vec3<T>& wo, const Vec3<T>& wi) {
  return std::visit([&](const auto& b) { return b.pdf(wo, wi); }, bsdf);
}

}  // namespace plumbline::renderer
