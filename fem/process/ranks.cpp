#include "fem/ranks.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <utility>

#include <mpi.h>
#include <sched.h>

#include "fem/process/mpi_error.hpp"

namespace microslip::fem {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

int ranks_here = 1;

/// Variables of the environment that tell how many processes have been started together.
constexpr std::array size_names{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};

constexpr std::int64_t dismissed = -1;
constexpr auto patience = 15s;

bool is_open() {
  int begun = 0;
  int ended = 0;
  check_mpi(MPI_Initialized(&begun));
  check_mpi(MPI_Finalized(&ended));
  return begun != 0 && ended == 0;
}

/// MPI's own wait takes a whole core.
/// @return false: not done within the limit.
bool wait_asleep(MPI_Request& request, Clock::duration limit = Clock::duration::max()) {
  const auto begin = Clock::now();
  int done = 0;
  check_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
  while (done == 0) {
    if (Clock::now() - begin > limit) return false;
    std::this_thread::sleep_for(2ms);
    check_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
  }
  return true;
}

void broadcast(std::string& bytes, int from) {
  constexpr std::size_t most = std::size_t{1} << 30U;  // MPI counts in int
  for (std::size_t at = 0; at < bytes.size(); at += most) {
    const auto n = static_cast<int>(std::min(most, bytes.size() - at));
    check_mpi(MPI_Bcast(bytes.data() + at, n, MPI_BYTE, from, MPI_COMM_WORLD));
  }
}

/// The size of the work, or that there is none and the exit code.
using Head = std::array<std::int64_t, 2>;

void announce(Head head) {
  MPI_Request request = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibcast(head.data(), 2, MPI_INT64_T, 0, MPI_COMM_WORLD, &request));
  wait_asleep(request);
}

}  // namespace

bool started_in_parallel() {
  return std::ranges::any_of(size_names, [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && std::atoi(value) > 1;
  });
}

bool started_as_rank() {
  return std::ranges::any_of(size_names,
                             [](const char* name) { return std::getenv(name) != nullptr; });
}

int rank() {
  int value = 0;
  if (is_open()) check_mpi(MPI_Comm_rank(MPI_COMM_WORLD, &value));
  return value;
}

int n_ranks() {
  int value = 1;
  if (is_open()) check_mpi(MPI_Comm_size(MPI_COMM_WORLD, &value));
  return value;
}

int n_ranks_here() { return ranks_here; }
void know_ranks_here(int n) { ranks_here = n; }

int n_cores() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

int usable_cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  return sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : n_cores();
}

void meet_ranks() {
  if (n_ranks() == 1) return;
  MPI_Comm here = MPI_COMM_NULL;
  check_mpi(MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here));
  check_mpi(MPI_Comm_size(here, &ranks_here));
  cpu_set_t own;
  cpu_set_t all;
  CPU_ZERO(&own);
  CPU_ZERO(&all);
  sched_getaffinity(0, sizeof own, &own);
  check_mpi(MPI_Reduce(&own, &all, sizeof own, MPI_BYTE, MPI_BOR, 0, here));
  check_mpi(MPI_Comm_free(&here));
  if (rank() == 0) sched_setaffinity(0, sizeof all, &all);
}

void give_work(std::string bytes) {
  announce({static_cast<std::int64_t>(bytes.size()), 0});
  broadcast(bytes, 0);
}

void dismiss(int code) {
  if (n_ranks() > 1) announce({dismissed, code});
}

Order await_order() {
  Head head{};
  MPI_Request request = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibcast(head.data(), 2, MPI_INT64_T, 0, MPI_COMM_WORLD, &request));
  wait_asleep(request);
  if (head[0] == dismissed) return {std::nullopt, static_cast<int>(head[1])};
  std::string bytes(static_cast<std::size_t>(head[0]), '\0');
  broadcast(bytes, 0);
  return {std::move(bytes), 0};
}

void end_all(const Failure& failure) {
  std::fprintf(stderr, "microslip: on rank %d: %s\n", rank(), failure.message.c_str());
  MPI_Abort(MPI_COMM_WORLD, failure.code);
  std::_Exit(failure.code);
}

std::optional<Failure> agree(const std::optional<Failure>& own) {
  constexpr int nobody = std::numeric_limits<int>::max();
  const int mine = own ? rank() : nobody;
  int first = nobody;
  MPI_Request request = MPI_REQUEST_NULL;
  const auto tell = [&](int code) {
    if (own && code != MPI_SUCCESS) end_all(*own);  // without memory, MPI has none either
    check_mpi(code);
  };
  tell(MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request));
  if (!wait_asleep(request, own ? Clock::duration(patience) : Clock::duration::max())) {
    end_all(*own);
  }
  if (first == nobody) return std::nullopt;
  Failure failure = first == mine ? *own : Failure{};
  std::array<std::int64_t, 2> head{failure.code, static_cast<std::int64_t>(failure.message.size())};
  tell(MPI_Bcast(head.data(), 2, MPI_INT64_T, first, MPI_COMM_WORLD));
  failure.code = static_cast<int>(head[0]);
  failure.message.resize(static_cast<std::size_t>(head[1]));
  broadcast(failure.message, first);
  return failure;
}

bool anywhere(bool here) {
  int value = here ? 1 : 0;
  if (n_ranks() > 1) {
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD));
  }
  return value != 0;
}

}  // namespace microslip::fem
