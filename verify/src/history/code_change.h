#pragma once

#include <string_view>

namespace plumbline::verify::history {

/// Empties a sequence that has no nights yet or belongs to other code.
///
/// @return whether it did
template <class Sequence>
bool start_again(Sequence& sequence, std::string_view code_hash) {
  if (sequence.nights > 0 && sequence.code == code_hash) return false;
  sequence = Sequence{};
  sequence.code = code_hash;
  return true;
}

}  // namespace plumbline::verify::history
