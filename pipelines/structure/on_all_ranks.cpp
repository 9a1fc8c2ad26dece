#include "pipelines/structure/on_all_ranks.hpp"

#include <csignal>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"
#include "pipelines/system/exit_code.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

void take_part(std::span<const Part> parts, const std::string& work) {
  const std::size_t end = work.find('\n');
  const std::string_view name = std::string_view(work).substr(0, end);
  for (const Part& part : parts) {
    if (part.name == name) part.take(std::string_view(work).substr(end + 1));
  }
}

}  // namespace

std::optional<fem::Failure> failure_of(const std::function<void()>& work) {
  try {
    work();
    return std::nullopt;
  } catch (const std::exception& error) {
    return fem::Failure{static_cast<int>(exit_code_of(error)), message_of(error)};
  }
}

[[noreturn]] void throw_failure(const fem::Failure& failure) {
  const std::string& message = failure.message;
  switch (static_cast<ExitCode>(failure.code)) {
    case ExitCode::bad_input:
      throw SceneError(message);
    case ExitCode::refused:
      throw RefusedError(message);
    case ExitCode::incomplete:
      throw InterruptedError(message);
    case ExitCode::exhausted:
      throw ExhaustedError(message);
    default:
      throw std::runtime_error(message);
  }
}

void on_all_ranks(std::string_view name, const std::function<std::string()>& bytes,
                  const std::function<void()>& work) {
  if (fem::n_ranks() == 1) return work();
  fem::give_work(fmt::format("{}\n{}", name, bytes()));
  std::exception_ptr own;
  const auto failure = failure_of([&] {
    try {
      work();
    } catch (...) {
      own = std::current_exception();
      throw;
    }
  });
  const auto first = fem::agree(failure);
  if (own) std::rethrow_exception(own);
  if (first) throw_failure({first->code, "on another rank: " + first->message});
}

int serve_rank_zero(std::span<const Part> parts) {
  std::signal(SIGINT, SIG_IGN);  // rank 0 answers, and ends all
  std::signal(SIGTERM, SIG_IGN);
  std::signal(SIGHUP, SIG_IGN);
  fem::Order order;
  const auto failure = failure_of([&] {
    for (order = fem::await_order(); order.work; order = fem::await_order()) {
      static_cast<void>(fem::agree(failure_of([&] { take_part(parts, *order.work); })));
    }
  });
  if (failure) fem::end_all(*failure);
  return order.code;
}

}  // namespace microslip::pipelines
