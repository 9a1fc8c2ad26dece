#include "fem/rank_messages.hpp"

#include <chrono>
#include <limits>
#include <list>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include <mpi.h>

#include "fem/process/mpi_error.hpp"

namespace microslip::fem {
namespace {

constexpr int tag = 1;

struct Parcel {
  std::string bytes;
  MPI_Request request = MPI_REQUEST_NULL;
};

/// One thread at a time calls MPI: SlepcSession asks for no more.
std::mutex& turn() {
  static std::mutex mutex;
  return mutex;
}

/// Not taken yet. Under turn().
std::list<Parcel>& under_way() {
  static std::list<Parcel> parcels;
  return parcels;
}

void forget_taken() {
  std::erase_if(under_way(), [](Parcel& parcel) {
    int done = 0;
    check_mpi(MPI_Test(&parcel.request, &done, MPI_STATUS_IGNORE));
    return done != 0;
  });
}

}  // namespace

void send_message(int to, std::string bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::length_error("a message to another rank has 2 GiB or more");
  }
  const std::lock_guard lock(turn());
  forget_taken();
  Parcel& parcel = under_way().emplace_back();
  parcel.bytes = std::move(bytes);
  check_mpi(MPI_Isend(parcel.bytes.data(), static_cast<int>(parcel.bytes.size()), MPI_BYTE, to, tag,
                      MPI_COMM_WORLD, &parcel.request));
}

std::optional<std::string> take_message(int from) {
  const std::lock_guard lock(turn());
  forget_taken();
  int there = 0;
  MPI_Status status;
  check_mpi(MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, &status));
  if (there == 0) return std::nullopt;
  int n = 0;
  check_mpi(MPI_Get_count(&status, MPI_BYTE, &n));
  std::string bytes(static_cast<std::size_t>(n), '\0');
  check_mpi(MPI_Recv(bytes.data(), n, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE));
  return bytes;
}

std::string await_message(int from, const std::function<void()>& meanwhile) {
  using namespace std::chrono_literals;
  while (true) {
    if (auto bytes = take_message(from)) return *std::move(bytes);
    meanwhile();
    std::this_thread::sleep_for(2ms);
  }
}

}  // namespace microslip::fem
