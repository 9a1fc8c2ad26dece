/// @file
/// Work of rank 0 in which the other ranks of an MPI start take part (fem/ranks.hpp).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fem/ranks.hpp"

namespace microslip::pipelines {

/// The part of the other ranks in a kind of work, which they know by its name.
struct Part {
  std::string_view name;
  void (*take)(std::string_view bytes);
};

/// Runs `work` here and its counterpart, the part of that name, on the other ranks; alone where
/// there are none.
/// @param bytes  what the others need to know; asked for where there are others.
/// @throws what `work` throws; what another rank alone has thrown, as the error of its exit code.
void on_all_ranks(std::string_view name, const std::function<std::string()>& bytes,
                  const std::function<void()>& work);

/// What a rank above 0 does: its part of the work of rank 0, until that has ended.
/// It leaves interrupts to rank 0.
/// @param parts  of all kinds of work there are.
/// @return the exit code of rank 0.
int serve_rank_zero(std::span<const Part> parts);

/// How a piece of work has failed, for another rank; empty: it has not.
[[nodiscard]] std::optional<fem::Failure> failure_of(const std::function<void()>& work);
/// What another rank has failed by, as the error of its exit code.
[[noreturn]] void throw_failure(const fem::Failure& failure);

}  // namespace microslip::pipelines
