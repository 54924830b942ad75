#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace plumbline::duet {

/// Instructions that `measured` executes in user mode on its thread, counted one by one in a child
/// process under ptrace: exact, for whatever the processor knows (valgrind 3.19 does not know
/// AVX-512). A repeated string instruction counts once for each repetition. Call it before there
/// are threads.
///
/// @param prepare  makes, in the child, what is counted
/// @param most     where the count ends without a result: each takes microseconds, on virtual
///                 machines up to 50
/// @return         nullopt beyond `most`, or where the system does not let a process be traced
std::optional<std::uint64_t> count_instructions(
    const std::function<std::function<void()>()>& prepare, std::uint64_t most);

}  // namespace plumbline::duet
