#include "pipelines/system/little_memory.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::size_t kept_back = std::size_t{1} << 20U;  // bytes

std::atomic<void*> reserve{nullptr};
std::atomic<bool> is_used_up{false};

/// Returns to have the allocation tried again.
void give_reserve() {
  if (void* memory = reserve.exchange(nullptr)) {
    std::free(memory);
    return;
  }
  is_used_up = true;
  throw std::bad_alloc();
}

/// The stack of the first thread grows when it is used: where no address space is left by then, a
/// signal ends the process.
[[gnu::noinline]] void grow_stack() {
  constexpr std::size_t enough = std::size_t{1} << 20U;  // bytes: Eigen puts blocks there
  constexpr std::size_t page = 4096;
  std::array<char, enough> room;
  volatile char* const begin = room.data();
  for (std::size_t i = 0; i < enough; i += page) begin[i] = 0;
}

[[noreturn]] void end_at_once() {
  const std::string_view words =
      is_used_up ? "microslip: out of memory\n"
                 : "microslip: internal error: an exception where none can be handled\n";
  // Neither streams nor destructors: they allocate.
  static_cast<void>(::write(STDERR_FILENO, words.data(), words.size()) < 0);
  std::_Exit(static_cast<int>(is_used_up ? ExitCode::exhausted : ExitCode::internal));
}

}  // namespace

void prepare_for_little_memory() {
  grow_stack();
  reserve = std::malloc(kept_back);
  std::set_new_handler(give_reserve);
  std::set_terminate(end_at_once);
}

}  // namespace microslip::pipelines
