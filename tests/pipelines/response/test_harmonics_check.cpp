// Peaks of given harmonics are solved with more, whatever the number of modes: contact sees those
// through few coordinates.
#include "pipelines/response/harmonics_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"

namespace microslip::pipelines::test_harmonics_check {
namespace {

std::string list(int n, const auto& entry) {
  std::string text = "[";
  for (int i = 0; i < n; ++i) text += (i == 0 ? "" : ", ") + std::to_string(entry(i));
  return text + "]";
}

/// A point that slips; modes from 20 Hz on.
std::string scene_with(int n_modes, int harmonics) {
  const auto falling = [](int i) { return 1.0 / (1 + i); };
  std::string text = "[model]\nkind = \"modal\"\n[modal]\ndamping_ratio = 0.01\n";
  text += "frequency = " + list(n_modes, [](int i) { return 20.0 + 26.0 * i; }) + "\n";
  text += "force_sine = " + list(n_modes, [&](int i) { return 7.0 * falling(i); }) + "\n";
  text += "output = " + list(n_modes, falling) + "\n[[modal.points]]\nweight = 1\n";
  text += "tangential_stiffness = 4e4\nnormal_stiffness = 4e4\nfriction_coefficient = 0.5\n";
  text += "preload = 30\n";
  for (int i = 0; i < n_modes; ++i) {
    text += "phi_u_" + std::to_string(i + 1) + " = " + std::to_string(0.5 * falling(i)) + "\n";
  }
  text += "phi_v_1 = 0.2\n[response]\nfrequency = [21, 24]\nharmonics = ";
  return text + std::to_string(harmonics) + "\n";
}

CurveResult traced(const std::string& text) {
  const SceneDescription scene = parse_scene(text, "scene.toml", "/nowhere", {});
  std::vector<std::string> warnings;
  return trace_curve(model_of(scene, nullptr, warnings), scene, curve_requests(scene).at(0),
                     [](const auto&) { return true; });
}

TEST(HarmonicsCheck, TellsWhatMoreDoWhateverTheNumberOfModes) {
  for (const int n_modes : {4, 70}) {
    const CurveResult three = traced(scene_with(n_modes, 3));
    const CurveResult eleven = traced(scene_with(n_modes, 11));
    ASSERT_TRUE(three.richer && three.richer->change) << n_modes << " modes";
    EXPECT_GT(std::abs(*three.richer->change), 1e-4) << n_modes << " modes";
    const double own = highest_peak(eleven.curve)->amplitude;
    EXPECT_NEAR(three.richer->amplitude, own, 1e-6 * own) << n_modes << " modes";
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_harmonics_check
