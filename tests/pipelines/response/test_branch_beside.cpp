// The branch of a resonance outside the range that leads into it: the curve is proved linear and
// has no fold to tell of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_branch_beside {
namespace {

constexpr double hertz = 2.0 * std::numbers::pi;

/// Two modes, free at 20 Hz, and a point that closes a gap, or is pressed and opens.
CurveResult traced(const std::string& excitation, const std::string& point,
                   const std::string& range) {
  const std::string text = "[model]\nkind = \"modal\"\n[modal]\n" + excitation +
                           "output = [0.75, 0.5]\n[[modal.points]]\nweight = 1\n"
                           "tangential_stiffness = 4e4\nnormal_stiffness = 4e4\n"
                           "friction_coefficient = 0.3\nphi_u_2 = -0.1\n" +
                           point + "[response]\nfrequency = " + range + "\n";
  const SceneDescription scene = parse_scene(text, "scene.toml", "/nowhere", {});
  std::vector<std::string> warnings;
  return trace_curve(model_of(scene, nullptr, warnings), scene, curve_requests(scene).at(0),
                     [](const auto&) { return true; });
}

void expect_branch(const CurveResult& result, const CurveResult& whole, double low, double high) {
  EXPECT_FALSE(result.curve.certificate.empty());
  ASSERT_FALSE(result.curve.detached.empty());
  double found = 0.0;
  for (const auto& branch : result.curve.detached) {
    for (const auto& point : branch.points) found = std::max(found, point.amplitude);
  }
  double most = 0.0;
  for (const auto& point : whole.curve.points) {
    const double frequency = point.frequency / hertz;
    if (frequency > low && frequency < high) most = std::max(most, point.amplitude);
  }
  EXPECT_NEAR(found, most, 0.05 * most);
  EXPECT_GT(found, 5.0 * highest_peak(result.curve)->amplitude);
}

// Row 95. Hard: the curve is proved linear, and a branch 14 times as high leads into its range.
// Met in: ranges beside a resonance.
// Right: found by the curve of that resonance, followed into the range.
TEST(BranchBeside, IsFoundWhereAResonanceBelowTheRangeClosesAGap) {
  const char* modes =
      "frequency = [20, 52]\ndamping_ratio = [0.005, 0.01]\nforce_sine = [7, 0.5]\n";
  const char* gap = "preload = -60\nphi_u_1 = 0.1\nphi_v_1 = 0.5\n";
  expect_branch(traced(modes, gap, "[21.5, 23]"), traced(modes, gap, "[18, 24]"), 21.5, 23.0);
}

TEST(BranchBeside, IsFoundWhereAResonanceAboveTheRangeOpensTheContact) {
  const char* modes =
      "frequency = [20, 60]\ndamping_ratio = [0.003, 0.01]\nforce_sine = [20, 0.5]\n";
  const char* pressed = "preload = 200\nphi_u_1 = 0.02\nphi_v_1 = 0.6\n";
  expect_branch(traced(modes, pressed, "[24, 26]"), traced(modes, pressed, "[18, 32]"), 24.0, 26.0);
}

}  // namespace
}  // namespace microslip::pipelines::test_branch_beside
