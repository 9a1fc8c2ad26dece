// Response curves whose forces are sampled in lanes, with the 128 instants the program takes,
// against the same curves by located events (theory section 23): 40 random scenes (a tenth in every
// run), the chain of section 20.3 and patches that open, slip and nearly stick, with 3 and 5
// harmonics.
//
// Points that stick for less than the time between two instants are left to hard_cases.short_stick:
// the program locates their events.
//
// Asked of sampled forces is 1e-3 of the force; a curve gets 1e-4 of its largest amplitude.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/campaign.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::lanes_against_events {
namespace {

constexpr double Hz = 2.0 * std::numbers::pi;
constexpr double tolerance = 1e-4;
constexpr int instants = 128;

/// A contact of as many points as the program samples: each in parts that carry four fifths to six
/// fifths of its load.
void divide_points(solver::Scene& scene) {
  constexpr Eigen::Index least = 48;
  const auto& patch = dynamic_cast<const tests::ReadablePatch&>(*scene.contact);
  const Eigen::Index n_points = patch.patch().weights().size();
  const Eigen::Index parts = (least + n_points - 1) / n_points;
  const auto repeated = [&](const auto& rows) { return rows.replicate(parts, 1).eval(); };
  std::vector<contact::PointParameters> points;
  for (Eigen::Index part = 0; part < parts; ++part) {
    const double share =
        parts > 1 ? 0.8 + 0.4 * static_cast<double>(part) / static_cast<double>(parts - 1) : 1.0;
    for (contact::PointParameters point : patch.patch().points()) {
      point.rest_load *= share;
      points.push_back(point);
    }
  }
  scene.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(repeated(patch.patch().weights()) / static_cast<double>(parts), points),
      contact::ModalShapes{repeated(patch.shapes().u), repeated(patch.shapes().v), {}});
}

struct Answers {
  double largest = 0.0;
  double slip_share = 0.0;                      // of the period, where it is largest
  std::vector<std::vector<double>> amplitudes;  // of all solutions at fixed frequencies, sorted
};

Answers answers(const solver::Scene& scene, const solver::ContinuationOptions& options) {
  const solver::ResponseCurve curve = solver::trace_response(scene, options);
  EXPECT_TRUE(curve.complete) << curve.message;
  Answers result;
  for (const auto& point : curve.points) {
    result.largest = std::max(result.largest, point.amplitude);
    result.slip_share = std::max(result.slip_share, point.report.slip_share);
  }
  for (const double share : {0.13, 0.31, 0.47, 0.59, 0.83}) {
    std::vector<double> found;
    for (const auto& point : solver::points_at_frequency(
             scene, curve, std::lerp(options.frequency_begin, options.frequency_end, share),
             options)) {
      found.push_back(point.amplitude);
    }
    std::ranges::sort(found);
    result.amplitudes.push_back(std::move(found));
  }
  return result;
}

/// Largest of all answers, over the largest amplitude; none: left to hard_cases.short_stick.
/// @param make  the scene, anew.
template <typename Make>
std::optional<double> difference(const std::string& name, const Make& make, double begin,
                                 double end, int n_harmonics) {
  SCOPED_TRACE(name + ", harmonics " + std::to_string(n_harmonics));
  solver::ContinuationOptions options = tests::frequency_range(begin, end);
  options.n_harmonics = n_harmonics;
  options.judge_stability = false;
  solver::Scene scene = make();
  tests::use_event_cycles(scene);
  const Answers located = answers(scene, options);
  if (located.slip_share > 1.0 - 2.0 / instants) {
    std::printf("%s: slips all the time but %.1e of it: not compared\n", name.c_str(),
                1.0 - located.slip_share);
    return std::nullopt;
  }
  scene = make();
  tests::use_lanes(scene, instants);
  options.corrector = solver::ContinuationOptions::Corrector::few_jacobians;  // as the program does
  const Answers sampled = answers(scene, options);
  double largest = std::abs(sampled.largest / located.largest - 1.0);
  for (std::size_t i = 0; i < located.amplitudes.size(); ++i) {
    const std::vector<double>& expected = located.amplitudes[i];
    EXPECT_EQ(sampled.amplitudes[i].size(), expected.size()) << "frequency " << i;
    if (sampled.amplitudes[i].size() != expected.size()) continue;
    for (std::size_t j = 0; j < expected.size(); ++j) {
      largest =
          std::max(largest, std::abs(sampled.amplitudes[i][j] - expected[j]) / located.largest);
    }
  }
  EXPECT_LT(largest, tolerance);
  return largest;
}

TEST(LanesAgainstEvents, RandomScenesHaveTheSameCurves) {
  double largest = 0.0;
  int n_compared = 0;
  const int n_scenes = tests::campaign_size(40);
  for (int seed = 0; seed < n_scenes; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    const auto divided = [&] {
      solver::Scene scene = std::move(tests::random_scene(number).scene);
      divide_points(scene);
      return scene;
    };
    const solver::ContinuationOptions range = tests::random_scene(number).options;
    const auto found = difference("random " + std::to_string(seed), divided, range.frequency_begin,
                                  range.frequency_end, seed % 2 == 0 ? 3 : 5);
    if (!found) continue;
    ++n_compared;
    largest = std::max(largest, *found);
  }
  EXPECT_GE(10 * n_compared, 9 * n_scenes);
  std::printf("largest difference, over the largest amplitude: %.1e\n", largest);
}

TEST(LanesAgainstEvents, SoHaveAChainThatJumpsAndPatches) {
  const auto chain = [] { return tests::three_dof_scene(30.0); };
  EXPECT_TRUE(difference("chain", chain, 18.0 * Hz, 28.0 * Hz, 3));
  for (const double preload : {-50.0, 20.0, 200.0}) {
    const auto patch = [&] { return tests::patch_scene({4, 48}, preload); };
    EXPECT_TRUE(difference("patch " + std::to_string(preload), patch, 250.0 * Hz, 400.0 * Hz, 5));
  }
}

}  // namespace
}  // namespace microslip::lanes_against_events
