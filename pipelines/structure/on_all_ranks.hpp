/// @file
/// Work of rank 0 in which the other ranks of an MPI start take part (fem/ranks.hpp).
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace microslip::pipelines {

/// Runs `work` here and its counterpart, a row of the table in on_all_ranks.cpp, on the other
/// ranks; alone where there are none.
/// @param bytes  what the others need to know; asked for where there are others.
/// @throws what `work` throws; what another rank alone has thrown, as the error of its exit code.
void on_all_ranks(std::string_view name, const std::function<std::string()>& bytes,
                  const std::function<void()>& work);

/// What a rank above 0 does: its part of the work of rank 0, until that has ended.
/// It leaves interrupts to rank 0.
/// @return the exit code of rank 0.
int serve_rank_zero();

}  // namespace microslip::pipelines
