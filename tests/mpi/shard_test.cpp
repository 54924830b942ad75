#include "shard.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <plumbline/output/checkpoint.h>
#include <plumbline/renderer/core/errors.h>

/// Parts of a state on their way to other ranks and back.
namespace plumbline::tests {
namespace {

using renderer::RenderState;
using tools::put_back;
using tools::Shard;
using tools::taken_out;

/// A state in which no two pixels are alike: 5 × 3, with two nets and three counts of each.
RenderState made_state() {
  RenderState state;
  state.width = 5;
  state.height = 3;
  state.nets = 2;
  for (std::uint32_t i = 0; i < 15; ++i) {
    state.drawn.push_back(100 + i);
    for (std::uint32_t j = 0; j < 2; ++j) {
      state.moments.emplace_back();
      state.moments.back().mean.g = 10.0 * i + j;
    }
    for (std::uint32_t j = 0; j < 3; ++j) state.bsdf_counts.push_back(10 * i + j);
  }
  return state;
}

RenderState without_samples(RenderState state) {
  for (auto& of_net : state.moments) of_net = {};
  for (auto& drawn : state.drawn) drawn = 0;
  for (auto& count : state.bsdf_counts) count = 0;
  return state;
}

TEST(Shards, PutBackAreTheWhole) {
  const RenderState whole = made_state();
  for (const std::uint32_t count : {1u, 2u, 4u, 15u, 20u}) {  // the last ones with empty parts
    RenderState back = without_samples(whole);
    for (std::uint32_t number = 1; number <= count; ++number) {
      const Shard shard{number, count};
      put_back(shard, output::state_of_bytes(output::bytes_of_state(taken_out(shard, whole))),
               back);
    }
    EXPECT_EQ(output::bytes_of_state(back), output::bytes_of_state(whole)) << count;
  }
}

TEST(Shards, InAnotherPlaceOrLostAreNotTheWhole) {
  const RenderState whole = made_state();
  const Shard first{1, 3}, second{2, 3}, third{3, 3};
  RenderState swapped = whole;
  put_back(first, taken_out(second, whole), swapped);
  put_back(second, taken_out(first, whole), swapped);
  EXPECT_NE(output::bytes_of_state(swapped), output::bytes_of_state(whole));
  RenderState lost = without_samples(whole);
  put_back(first, taken_out(first, whole), lost);
  put_back(third, taken_out(third, whole), lost);
  EXPECT_EQ(lost.least_drawn(), 0u);
}

TEST(Shards, OfAnotherSizeAreRefused) {
  RenderState whole = made_state();
  const RenderState part = taken_out(Shard{1, 4}, whole);  // 4 of 15 pixels
  EXPECT_THROW(put_back(Shard{4, 4}, part, whole), renderer::InputError);
  std::string bytes = output::bytes_of_state(part);
  bytes[bytes.size() / 2] ^= 1;
  EXPECT_THROW(output::state_of_bytes(bytes), renderer::InputError);
}

}  // namespace
}  // namespace plumbline::tests
