// Prints what scenes answer at fixed frequencies, by three methods of the contact, for
// share/scripts/compilers.sh, which compares what several compilers and optimisations make of the
// same sources.
//
//   SCENE METHOD FREQUENCY LARGEST AMPLITUDE …      a line per frequency: the largest amplitude of
//   the curve
//                                                   and every solution's there, sorted [m], 17
//                                                   digits

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::tests {
namespace {

struct Case {
  std::string name;
  solver::Scene scene;
  double begin, end;  // [rad/s]
};

struct Way {
  const char* name;
  int n_harmonics;
  int n_random;  // scenes
  std::function<void(solver::Scene&)> use;
};

std::vector<Case> cases(int n_random) {
  constexpr double Hz = 2.0 * M_PI;
  std::vector<Case> list;
  list.push_back({"three_dof", three_dof_scene(30.0), 18.0 * Hz, 28.0 * Hz});
  list.push_back({"chain", chain_scene(30.0), 15.0 * Hz, 60.0 * Hz});
  for (const double preload : {-50.0, 20.0, 200.0}) {
    list.push_back({"patch_" + std::to_string(static_cast<int>(preload)),
                    patch_scene({4, 12}, preload), 250.0 * Hz, 400.0 * Hz});
  }
  for (int seed = 1; seed <= n_random; ++seed) {
    RandomScene random = random_scene(static_cast<std::uint64_t>(seed));
    list.push_back({"random_" + std::to_string(seed), std::move(random.scene),
                    random.options.frequency_begin, random.options.frequency_end});
  }
  return list;
}

void print(const Case& at, const Way& way) {
  solver::ContinuationOptions options = frequency_range(at.begin, at.end);
  options.n_harmonics = way.n_harmonics;
  options.judge_stability = false;
  const solver::ResponseCurve curve = solver::trace_response(at.scene, options);
  double largest = 0.0;
  for (const auto& point : curve.points) largest = std::max(largest, point.amplitude);
  for (const double share : {0.13, 0.31, 0.47, 0.59, 0.83}) {
    const double frequency = at.begin + share * (at.end - at.begin);
    std::vector<double> amplitudes;
    for (const auto& point : solver::points_at_frequency(at.scene, curve, frequency, options)) {
      amplitudes.push_back(point.amplitude);
    }
    std::ranges::sort(amplitudes);
    std::printf("%s %s %.17g %.17g", at.name.c_str(), way.name, frequency, largest);
    for (const double amplitude : amplitudes) std::printf(" %.17g", amplitude);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace microslip::tests

int main() {
  using namespace microslip;
  const std::vector<tests::Way> ways = {
      {"closed_form", 1, 30, [](solver::Scene&) {}},
      {"events", 3, 8, tests::use_event_cycles},
      {"lanes", 3, 8, [](solver::Scene& scene) { tests::use_lanes(scene, 256); }}};
  for (const tests::Way& way : ways) {
    for (tests::Case& at : tests::cases(way.n_random)) {
      way.use(at.scene);
      tests::print(at, way);
    }
  }
}
