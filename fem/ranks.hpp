/// @file
/// Processes that mpirun has started together. Rank 0 is the program: it reads, decides, writes.
/// The others sleep until it gives them work, do their part of what is collective,
/// and are dismissed in the end.
///
/// What fails on one rank must end on all. Each tells the others how its part ended (agree()); a
/// rank that has failed and is waited for inside a library by others, which therefore never come to
/// tell, ends all processes.
#pragma once

#include <optional>
#include <string>

namespace microslip::fem {

/// Whether mpirun (or a batch system by PMI) has started several processes: known by the
/// environment, before a session.
[[nodiscard]] bool started_in_parallel();
/// The same of one process as well: those that it starts itself cannot open a session of their own,
/// for they would take its place among the ranks.
[[nodiscard]] bool started_as_rank();

[[nodiscard]] int rank();          ///< 0 without a session
[[nodiscard]] int n_ranks();       ///< 1 without a session
[[nodiscard]] int n_ranks_here();  ///< on this machine, 1 without a session
[[nodiscard]] int n_cores();       ///< of the machine
/// Of them, those this process may run on, by a batch system or taskset.
[[nodiscard]] int usable_cores();

/// What meet_ranks() has found in another copy of this code, that of the module.
void know_ranks_here(int n);

/// Begins a session: counts who is on this machine, and lets rank 0, which does alone what is not
/// solved on all, use the cores of all of them: mpirun binds each rank to cores of its own.
void meet_ranks();

/// Rank 0: the others get the bytes.
void give_work(std::string bytes);
/// Rank 0: the others end with this exit code.
void dismiss(int code);

struct Order {
  std::optional<std::string> work;  ///< none: dismissed
  int code = 0;                     ///< then the exit code
};
/// Ranks above 0, asleep until rank 0 has something to say.
[[nodiscard]] Order await_order();

struct Failure {
  int code = 0;  ///< of exit
  std::string message;
};

/// For a rank that has failed where others wait for it: ends all processes,
/// with its message and code.
[[noreturn]] void end_all(const Failure& failure);

/// After what all ranks did together.
/// @param own  of this rank; none: it has done its part.
/// @return     that of the lowest rank with one.
/// @note Ends all processes with the code of `own` where others do not come within a quarter of a
///       minute, or cannot be told.
[[nodiscard]] std::optional<Failure> agree(const std::optional<Failure>& own);

/// Whether it is so on any rank. Collective.
[[nodiscard]] bool anywhere(bool here);

}  // namespace microslip::fem
