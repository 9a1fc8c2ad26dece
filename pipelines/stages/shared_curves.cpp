#include "pipelines/stages/shared_curves.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/blas_threads.hpp"
#include "fem/rank_messages.hpp"
#include "fem/ranks.hpp"
#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/files/model_members.hpp"
#include "pipelines/files/result_members.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/on_all_ranks.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"
#include "pipelines/system/interrupt.hpp"

namespace microslip::fem {
auto members(pipelines::Is<Failure> auto& value) {
  auto& [code, message] = value;
  return std::tie(code, message);
}
}  // namespace microslip::fem

namespace microslip::pipelines {
namespace {

// What rank 0 says to another: a curve to solve, that it is to be given up, that there are no more.
enum class Order : std::uint8_t { solve, stop, end };
// What comes back: a point of the curve, then the curve, or how it has failed.
enum class Answer : std::uint8_t { point, curve, failure };

template <typename Kind, typename... Values>
std::string message(Kind kind, const Values&... values) {
  ByteWriter bytes;
  bytes(kind);
  (bytes(values), ...);
  return bytes.bytes();
}

template <typename Value>
Value next(ByteReader& bytes) {
  Value value{};
  bytes(value);
  return value;
}

/// What the curves of a scene follow from.
struct Family {
  SceneDescription scene;
  ReducedModel model;
};

using Settings = std::vector<std::array<std::string, 2>>;

/// The text of a scene says all but what a run itself has changed.
std::string bytes_of(const SceneDescription& scene, const ReducedModel& model) {
  Settings effects;
  for (const auto& [name, setting] : scene.effects) effects.push_back({name, setting});
  return message(seconds_left() + seconds_spent(), seconds_spent(), scene.complete_toml,
                 scene.file.string(), effects, left_out_by_choice(scene), scene.settings.harmonics,
                 scene.settings.second_direction, model);
}

/// Begins the time that the run has left as well.
Family family_of(ByteReader bytes) {
  const auto seconds = next<double>(bytes);
  begin_deadline(seconds, next<double>(bytes));
  const auto text = next<std::string>(bytes);
  const std::filesystem::path file = next<std::string>(bytes);
  Family family{parse_scene(text, file.string(), file.parent_path()), {}};
  SceneDescription& scene = family.scene;
  scene.file = file;
  scene.effects.clear();
  for (auto& [name, setting] : next<Settings>(bytes)) scene.effects.emplace_back(name, setting);
  leave_out_by_choice(scene, next<std::vector<std::string>>(bytes));
  bytes(scene.settings.harmonics);
  bytes(scene.settings.second_direction);
  bytes(family.model);
  return family;
}

// Rank 0 ---------------------------------------------------------------------------------------

/// A curve that another rank solves.
class AskedCurve {
 public:
  AskedCurve(int rank, const solver::PointObserver& observe) : rank_(rank), observe_(observe) {}

  CurveResult solved(const CurveRequest& request, const solver::ResponseCurve* near) {
    std::optional<solver::ResponseCurve> begin;
    if (near != nullptr) begin = *near;
    fem::send_message(rank_, message(Order::solve, request.name, begin));
    while (true) {
      const std::string text = fem::await_message(rank_, [this] {
        if (interrupt_requested()) stop();
      });
      ByteReader bytes(text);
      const auto kind = next<Answer>(bytes);
      if (kind == Answer::point) {
        hear(next<solver::ResponsePoint>(bytes));
        continue;
      }
      if (failure_) std::rethrow_exception(failure_);
      if (kind == Answer::failure) throw_failure(next<fem::Failure>(bytes));
      if (next<bool>(bytes)) leave_out();
      return next<CurveResult>(bytes);
    }
  }

 private:
  /// A point that cannot be kept ends the curve; what was sent before the rank knows is heard, too.
  void hear(const solver::ResponsePoint& point) {
    if (failure_) return;
    try {
      if (!observe_(point)) stop();
    } catch (...) {
      failure_ = std::current_exception();
      stop();
    }
  }

  void stop() {
    if (!stopped_) fem::send_message(rank_, message(Order::stop));
    stopped_ = true;
  }

  int rank_;
  const solver::PointObserver& observe_;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

/// Ranks wait for the next curve until they are told that there is none.
class Dismissal {
 public:
  Dismissal() = default;
  Dismissal(const Dismissal&) = delete;
  Dismissal& operator=(const Dismissal&) = delete;
  Dismissal(Dismissal&&) = delete;
  Dismissal& operator=(Dismissal&&) = delete;
  ~Dismissal() {
    for (int rank = 1; rank < fem::n_ranks(); ++rank) {
      fem::send_message(rank, message(Order::end));
    }
  }
};

// Another rank ---------------------------------------------------------------------------------

/// Nothing but a stop comes while a curve is solved.
void hear_stop() {
  if (fem::take_message(0)) request_interrupt();
}

CurveResult solve(const Family& family, ByteReader& bytes) {
  withdraw_interrupt();
  const auto name = next<std::string>(bytes);
  const auto near = next<std::optional<solver::ResponseCurve>>(bytes);
  const std::vector<CurveRequest> requests = curve_requests(family.scene);
  const auto request = std::ranges::find(requests, name, &CurveRequest::name);
  if (request == requests.end()) throw std::logic_error("the scene has no curve " + name);
  const auto observe = [](const solver::ResponsePoint& point) {
    fem::send_message(0, message(Answer::point, point));
    hear_stop();
    return !interrupt_requested() && !cut_short();
  };
  return trace_curve(family.model, family.scene, *request, observe, near ? &*near : nullptr);
}

}  // namespace

std::vector<int> share_curves(const ReducedModel& model, const SceneDescription& scene,
                              std::size_t n, int jobs, const CurveTask& task) {
  const auto most = static_cast<int>(std::min<std::size_t>(n, fem::n_ranks()));
  const int n_helpers = std::max(most - 1, 0);  // the last curve is left to all cores of rank 0
  const int n_threads = std::max(1, jobs - std::min(n_helpers, fem::n_ranks_here() - 1));
  std::vector<std::atomic<int>> solved(static_cast<std::size_t>(fem::n_ranks()));
  const auto on = [&](int rank) -> CurveSolver {
    return [&, rank](const CurveRequest& request, const solver::PointObserver& observe,
                     const solver::ResponseCurve* near) {
      ++solved[static_cast<std::size_t>(rank)];
      return rank == 0 ? trace_curve(model, scene, request, observe, near)
                       : AskedCurve(rank, observe).solved(request, near);
    };
  };
  on_all_ranks(
      curves_work, [&] { return bytes_of(scene, model); },
      [&] {
        const Dismissal dismissal;
        in_parallel(n, n_threads, n_helpers, [&](std::size_t i, int rank) { task(i, on(rank)); });
      });
  return {solved.begin(), solved.end()};
}

void take_part_in_curves(std::string_view bytes) {
  fem::use_one_blas_thread();
  std::optional<Family> family;
  while (true) {
    const std::string text = fem::await_message(0);
    ByteReader order(text);
    const auto kind = next<Order>(order);
    if (kind == Order::end) return;
    if (kind == Order::stop) continue;  // it came too late
    std::string answer;
    const auto failure = failure_of([&] {
      if (!family) family = family_of(ByteReader(bytes));
      const CurveResult curve = solve(*family, order);
      answer = message(Answer::curve, was_cut_short(), curve);
    });
    fem::send_message(0, failure ? message(Answer::failure, *failure) : std::move(answer));
  }
}

}  // namespace microslip::pipelines
