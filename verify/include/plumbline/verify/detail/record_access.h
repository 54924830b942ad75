#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <type_traits>

#include <plumbline/verify/detail/record.h>
#include <plumbline/verify/detail/vector_access.h>

/// Reading what samplers of other projects return, by the names that they use.
namespace plumbline::verify {

namespace detail {

/// Adds the channels of a colour to none. What is read is written where it stays: a record is
/// large, and a copy of one that was just written in pieces waits for each of them.
template <class C>
void add_channels(const C& c, Channels& out) {
  const auto put = [&out](auto v) { out.value[out.count++] = static_cast<double>(v); };
  if constexpr (std::is_arithmetic_v<C>) {
    put(c);
  } else if constexpr (requires { c.r, c.g, c.b; }) {
    put(c.r), put(c.g), put(c.b);
  } else if constexpr (HasXyz<C>) {
    put(c.x), put(c.y), put(c.z);
  } else if constexpr (requires { c.size(), c[0]; }) {
    const auto size = static_cast<std::size_t>(c.size());
    const std::size_t kept = std::min(size, Channels::kMost);
    for (std::size_t i = 0; i < kept; ++i) {
      put(c[static_cast<decltype(c.size())>(i * size / kept)]);
    }
  } else {
    put(c[0]), put(c[1]), put(c[2]);
  }
}

}  // namespace detail

/// A colour or spectrum: a number, r g b, x y z, or anything with size() and [].
template <class C>
Channels to_channels(const C& c) {
  Channels out;
  detail::add_channels(c, out);
  return out;
}

namespace detail {

template <class R>
Vec3 record_direction(const R& r) {
  if constexpr (requires { r.wi; }) {
    return to_vec3(r.wi);
  } else if constexpr (requires { r.direction; }) {
    return to_vec3(r.direction);
  } else if constexpr (requires { r.dir; }) {
    return to_vec3(r.dir);
  } else if constexpr (requires { r.w; } && !HasXyz<R>) {
    return to_vec3(r.w);
  } else {
    static_assert(Vector3<R>, "the record has no wi, direction, dir or w, and is no vector itself");
    return to_vec3(r);
  }
}

/// Empty where it states none.
template <class R>
void add_weight(const R& r, Channels& out) {
  if constexpr (requires { r.weight; }) {
    add_channels(r.weight, out);
  } else if constexpr (requires { r.throughput; }) {
    add_channels(r.throughput, out);
  } else if constexpr (requires { r.value; }) {
    add_channels(r.value, out);
  } else if constexpr (requires { r.f; }) {
    add_channels(r.f, out);
  }
}

/// A NaN that the code under test states is a statement too, and a wrong one.
template <class R>
std::optional<double> record_pdf(const R& r) {
  if constexpr (requires { static_cast<double>(r.pdf_w); }) {
    return static_cast<double>(r.pdf_w);
  } else if constexpr (requires { static_cast<double>(r.pdf); }) {
    return static_cast<double>(r.pdf);
  } else {
    return std::nullopt;
  }
}

template <class R>
bool record_is_delta(const R& r) {
  if constexpr (requires { static_cast<bool>(r.is_delta); }) {
    return static_cast<bool>(r.is_delta);
  } else if constexpr (requires { static_cast<bool>(r.delta); }) {
    return static_cast<bool>(r.delta);
  } else {
    return false;
  }
}

/// A record that says only that it is an atom states the probability as its pdf.
template <class R>
void take_mass(const R& r, SampleRecord& out) {
  if constexpr (requires { static_cast<double>(r.mass); }) {
    out.mass = static_cast<double>(r.mass);
  } else if (record_is_delta(r)) {
    out.mass = out.pdf.value_or(kNotApplicable);
    out.pdf = std::nullopt;
  }
}

/// @param out  as it is made
template <class R>
void read_plain_record(const R& r, SampleRecord& out) {
  out.x = record_direction(r);
  add_weight(r, out.weight);
  out.pdf = record_pdf(r);
  take_mass(r, out);
}

}  // namespace detail

/// A record, or an optional or pointer to one; empty stands for a failed sample.
template <class R>
std::optional<SampleRecord> read_record(const R& r) {
  std::optional<SampleRecord> out;
  if constexpr (requires { static_cast<bool>(r), *r; }) {
    if (static_cast<bool>(r)) detail::read_plain_record(*r, out.emplace());
  } else {
    detail::read_plain_record(r, out.emplace());
  }
  return out;
}

}  // namespace plumbline::verify
