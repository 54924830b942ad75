#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include <plumbline/verify/detail/random.h>
#include <plumbline/verify/detail/record.h>
#include <plumbline/verify/detail/record_access.h>

/// Calling maps that take numbers one by one, and reading what they return.
namespace plumbline::verify::detail {

struct NoValue {};

template <class T, class F, std::size_t... i>
constexpr bool takes(std::index_sequence<i...>) {
  return std::is_invocable_v<const F&, decltype(static_cast<T>(i))...>;
}

/// How many numbers of type T a map takes, from 1 to 8; 0: a Random&.
template <class T, class F>
constexpr std::size_t numbers_taken() {
  if constexpr (std::is_invocable_v<const F&, Random&>) {
    return 0;
  } else if constexpr (takes<T, F>(std::make_index_sequence<2>())) {
    return 2;
  } else if constexpr (takes<T, F>(std::make_index_sequence<1>())) {
    return 1;
  } else if constexpr (takes<T, F>(std::make_index_sequence<3>())) {
    return 3;
  } else if constexpr (takes<T, F>(std::make_index_sequence<4>())) {
    return 4;
  } else if constexpr (takes<T, F>(std::make_index_sequence<5>())) {
    return 5;
  } else if constexpr (takes<T, F>(std::make_index_sequence<6>())) {
    return 6;
  } else if constexpr (takes<T, F>(std::make_index_sequence<7>())) {
    return 7;
  } else {
    static_assert(takes<T, F>(std::make_index_sequence<8>()),
                  "a map takes one to eight numbers of the point's scalar type, or a Random&");
    return 8;
  }
}

template <class T, std::size_t n, class F>
auto call_with(const F& map, const Uniforms& u) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) { return map(static_cast<T>(u[i])...); }
  (std::make_index_sequence<n>());
}

/// States a weight or a pdf beside its point.
template <class R>
concept PlainRecord = requires(const R& r) {
  r.weight;
}
|| requires(const R& r) { r.throughput; }
|| requires(const R& r) { r.pdf; }
|| requires(const R& r) { r.pdf_w; };

template <class R>
Vec3 point_of_record(const R& r) {
  if constexpr (requires { r.point; }) {
    return to_point(r.point);
  } else if constexpr (requires { r.position; }) {
    return to_point(r.position);
  } else {
    return record_direction(r);
  }
}

template <class P>
void read_plain(const P& point, SampleRecord& out) {
  if constexpr (PlainRecord<P>) {
    out.x = point_of_record(point);
    add_weight(point, out.weight);
    out.pdf = record_pdf(point);
    take_mass(point, out);
  } else {
    out.x = to_point(point);
  }
}

template <class P>
std::optional<SampleRecord> record_of_plain(const P& point) {
  std::optional<SampleRecord> out;
  read_plain(point, out.emplace());
  return out;
}

template <class P>
std::optional<SampleRecord> record_of_plain(const std::optional<P>& point) {
  std::optional<SampleRecord> out;
  if (point) read_plain(*point, out.emplace());
  return out;
}

}  // namespace plumbline::verify::detail
