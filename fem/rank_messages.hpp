/// @file
/// Messages between rank 0 and one other, while both have a part in one piece of work (ranks.hpp).
/// Those from one rank arrive in the order they were sent. Threads of rank 0 may speak at the same
/// time, each with a rank of its own; nothing else may call MPI meanwhile.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace microslip::fem {

/// Returns at once: the bytes are kept until the other has taken them.
/// @throws std::length_error  2 GiB or more, which MPI does not count.
void send_message(int to, std::string bytes);

/// The oldest that was not taken yet; empty: none is there.
[[nodiscard]] std::optional<std::string> take_message(int from);

/// The same, asleep until there is one.
/// @param meanwhile  called every 2 ms.
[[nodiscard]] std::string await_message(
    int from, const std::function<void()>& meanwhile = [] {});

}  // namespace microslip::fem
