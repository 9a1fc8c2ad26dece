// A small meshed cantilever that rubs with its tip face, from modes with attachment shapes to the
// peak of a curve: the axes of the contact must not matter, nor who gives the modes, nor in which
// unit a gap is said.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "fem/surface_load.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/model/nodal_load.hpp"
#include "pipelines/model/patch_shapes.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/campaign.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_attached_model {
namespace {

constexpr const char* scene_text = R"([model]
kind = "blade"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["x0"]
[modes]
count = 4
damping_ratio = 0.01
[contact]
surface = "x1"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = "1e12 N/m^3"
tangential_stiffness = "1e12 N/m^3"
points = 4
[excitation]
forces = [ { at = "corner", direction = [1, 3, 2], amplitude = "20 N" } ]
[response]
output = { at = "corner", direction = [0, 1, 0] }
frequency = ["1000 Hz", "2200 Hz"]
preload = [ 20 ]
[effects]
normal_motion = "off"
)";

mesh::Mesh cantilever() {
  return test::box_mesh(mesh::ElementType::hex20,
                        {.size = {0.1, 0.02, 0.015}, .cells = {4, 2, 2}, .map = {}});
}

SceneDescription scene_with(const std::vector<std::string>& overrides) {
  return parse_scene(scene_text, "cantilever.toml", ".", overrides);
}

ReducedModel model_with(const mesh::Mesh& mesh, const SceneDescription& scene) {
  const SolvedStructure structure{mesh, solve_structure(mesh, scene)};
  std::vector<std::string> warnings;
  return model_of(scene, &structure, warnings);
}

solver::ResponsePoint peak_of(const ReducedModel& model, const SceneDescription& scene) {
  const CurveResult result =
      trace_curve(model, scene, curve_requests(scene).front(), [](const auto&) { return true; });
  EXPECT_TRUE(result.curve.complete) << result.curve.message;
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  EXPECT_NE(peak, nullptr);
  EXPECT_EQ(peak->mark, solver::PointMark::peak);
  return *peak;
}

std::vector<std::string> turned(double degrees, const std::string& residual) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {
      fmt::format("contact.slip_direction=[0, {:.17g}, {:.17g}]", std::cos(angle), std::sin(angle)),
      "modes.residual=" + residual, "effects.second_direction=on"};
}

// Row 20. Hard: mode shapes that polynomials follow poorly at the edge of a contact.
// Met in: meshed cantilevers that rub with a tip.
// Right: `fit-poor`, and elements are interpolated unless the fit is asked for.
//
// Row 20: no polynomial follows a shape that jumps from node to node.
TEST(PatchShapes, APoorFitIsTakenOnlyWhereItIsAsked) {
  const mesh::Mesh mesh = cantilever();
  const ContactDescription contact = scene_with({}).contacts[0];
  const mesh::Surface& surface = mesh.surface(contact.surface);
  const mesh::SurfaceSampling sampling = mesh::sample_surface(mesh.nodes(), surface, 20);
  const mesh::FaceFrame frame = face_frame(mesh, contact);
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 1);
  for (Eigen::Index i = 0; i < shapes.rows(); ++i) shapes(i, 0) = i % 5 < 2 ? 1.0 : -1.0;
  const auto patch_with = [&](PatchSettings::Fit fit, int degree = 0) {
    contact::Patch patch;
    set_shapes(patch, {mesh, surface, sampling, frame}, {.fit = fit, .fit_degree = degree}, shapes);
    return patch;
  };
  const contact::Patch automatic = patch_with(PatchSettings::Fit::automatic);
  EXPECT_TRUE(is_fit_poor(automatic));
  EXPECT_EQ(automatic.fit_degree, -1);
  EXPECT_EQ(automatic.cells.shapes.u, patch_with(PatchSettings::Fit::none).cells.shapes.u);
  const contact::Patch asked = patch_with(PatchSettings::Fit::degree, 1);
  EXPECT_EQ(asked.fit_degree, 1);
  EXPECT_GT((asked.cells.shapes.u - automatic.cells.shapes.u).norm(),
            0.1 * automatic.cells.shapes.u.norm());
}

// The cone of friction is round and the springs are the same all around: nothing tells p from r.
// The row sum does: it keeps of a full 2 × 2 flexibility the diagonal alone, which is another
// matrix in turned axes.
TEST(AttachedModel, AmplitudesDoNotDependOnTheAxesOfTheContact) {
  const mesh::Mesh mesh = cantilever();
  const auto amplitude = [&](double degrees, const std::string& residual) {
    // Beside the peak, where points stick, slip and turn: a peak is a curve of such solutions.
    std::vector<std::string> overrides = turned(degrees, residual);
    overrides.emplace_back("response.frequency=1662");
    const SceneDescription scene = scene_with(overrides);
    const CurveResult result =
        trace_curve(model_with(mesh, scene), scene, curve_requests(scene).front(),
                    [](const auto&) { return true; });
    EXPECT_TRUE(result.curve.complete) << result.curve.message;
    const solver::ResponsePoint& point = result.curve.points.front();
    EXPECT_GT(point.report.slip_share, 0.1);
    std::printf("%-10s %3.0f degrees: %.9g m\n", residual.c_str(), degrees, point.amplitude);
    return point.amplitude;
  };
  const double straight = amplitude(0.0, "attachment");
  // Directions of slip come from a search to 1e-11 of the force, times what a resonance amplifies.
  for (const double degrees : tests::campaign_values({20.0, 45.0, 90.0}, {20.0, 90.0})) {
    EXPECT_NEAR(amplitude(degrees, "attachment"), straight, 1e-7 * straight) << degrees;
  }
}

std::string list_of(const Eigen::VectorXd& values) {
  return fmt::format("[{:.17g}]", fmt::join(values.begin(), values.end(), ", "));
}

/// The model as a modal scene: what model.h5 holds, as numbers.
/// @param local  stiffness without residual.
std::string modal_scene(const ReducedModel& model, double load, const std::filesystem::path& folder,
                        double local) {
  std::string table = "weight,tangential_stiffness,normal_stiffness,friction_coefficient,preload";
  const Eigen::Index n_modes = model.frequency.size();
  const contact::PatchSamples& cells = model.patches.front().cells;
  const bool in_series = cells.compliance.rows() > 0;
  if (in_series) table += ",residual_p,residual_q,residual_r";
  for (const char axis : {'u', 'v', 'w'}) {
    for (Eigen::Index mode = 1; mode <= n_modes; ++mode)
      table += fmt::format(",phi_{}_{}", axis, mode);
  }
  for (Eigen::Index i = 0; i < cells.size(); ++i) {
    table += fmt::format("\n{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}", cells.weights[i], local,
                         local, cells.friction[i], load * cells.preload_field[i]);
    for (Eigen::Index axis = 0; axis < (in_series ? 3 : 0); ++axis) {
      table += fmt::format(",{:.17g}", cells.compliance(i, axis));
    }
    for (const Eigen::MatrixXd* shapes : {&cells.shapes.u, &cells.shapes.v, &cells.shapes.w}) {
      for (Eigen::Index mode = 0; mode < n_modes; ++mode)
        table += fmt::format(",{:.17g}", (*shapes)(i, mode));
    }
  }
  write_whole(folder / "points.csv", table + "\n");
  return "[model]\nkind = \"modal\"\n[modal]\nangular_frequency = " + list_of(model.frequency) +
         "\ndamping_ratio = " + list_of(model.damping_ratio) +
         "\nforce_sine = " + list_of(model.force_sine) + "\noutput = " + list_of(model.output) +
         fmt::format("\nattachment = {}", model.n_attachment) +
         "\npoints = \"points.csv\"\n[response]\nfrequency = [1000, 2200]\nlimits = false\n"
         "[effects]\nsecond_direction = \"off\"\nnormal_motion = \"off\"\n";
}

TEST(AttachedModel, TheSameModesGivenAsNumbersHaveTheSamePeak) {
  const mesh::Mesh mesh = cantilever();
  for (const char* residual : {"attachment", "stiffness"}) {
    const SceneDescription scene =
        scene_with({std::string("modes.residual=") + residual, "effects.second_direction=off"});
    const ReducedModel model = model_with(mesh, scene);
    const test::TemporaryFolder folder;
    const SceneDescription given =
        parse_scene(modal_scene(model, 20.0, folder.path(), 1e12), "modal.toml", folder.path(), {});
    std::vector<std::string> warnings;
    const ReducedModel numbers = model_of(given, nullptr, warnings);
    EXPECT_EQ(numbers.n_attachment, model.n_attachment);
    EXPECT_EQ(model.n_attachment > 0, std::string(residual) == "attachment");
    const solver::ResponsePoint meshed = peak_of(model, scene);
    const solver::ResponsePoint modal = peak_of(numbers, given);
    EXPECT_NEAR(modal.amplitude, meshed.amplitude, 1e-9 * meshed.amplitude) << residual;
    EXPECT_NEAR(modal.frequency, meshed.frequency, 1e-9 * meshed.frequency) << residual;
  }
}

// Row 77. Hard: a gap given as a force is another length with every residual stiffness.
// Met in: the blade with more and fewer modes.
// Right: given as a length it is that length in every basis.
TEST(AttachedModel, AGapGivenAsALengthIsThatLengthInEveryBasis) {
  const mesh::Mesh mesh = cantilever();
  for (const char* residual : {"attachment", "stiffness", "none"}) {
    const SceneDescription scene = scene_with(
        {std::string("modes.residual=") + residual, "response.preload=[{ gap = \"3 um\" }, -150]",
         "effects.second_direction=off", "effects.normal_motion=on"});
    const ReducedModel model = model_with(mesh, scene);
    const std::vector<CurveRequest> requests = curve_requests(scene);
    EXPECT_EQ(requests[0].name, "gap_3um");
    const double load = std::get<double>(load_of(requests[0], model));
    EXPECT_NEAR(load, -3e-6 * total_normal_stiffness(model), 1e-12 * std::abs(load));
    const contact::ContactForce force = contact_of(model, load);
    for (const contact::PointParameters& point : force.points(0)) {
      EXPECT_NEAR(-point.rest_load / point.normal_stiffness, 3e-6, 1e-18);
    }
    EXPECT_NEAR(gap_of(load_of(requests[0], model), model).value(), 3e-6, 1e-17);
    EXPECT_NEAR(gap_of(load_of(requests[1], model), model).value(),
                150.0 / total_normal_stiffness(model), 1e-17);
    EXPECT_FALSE(gap_of(150.0, model).has_value());
    EXPECT_FALSE(gap_of(LimitName::free, model).has_value());
    ReducedModel uneven = model;  // of a load that presses
    for (contact::Patch& patch : uneven.patches) patch.cells.preload_field[0] *= 3.0;
    EXPECT_NEAR(gap_of(load, uneven).value(), 3e-6, 1e-17);
    uneven.patches[0].tilted_areas.emplace_back();
    EXPECT_FALSE(gap_of(load, uneven).has_value()) << "bodies that tilt";
    ReducedModel smooth = model;
    for (contact::Patch& patch : smooth.patches) patch.cells.stiffness.col(1).setZero();
    try {
      static_cast<void>(load_of(requests[0], smooth));
      FAIL() << "a gap without stiffness has no load";
    } catch (const RefusedError& error) {
      EXPECT_EQ(
          std::string(error.what()),
          "--set response.preload=[{ gap = \"3 um\" }, -150]: response.preload: a gap needs a "
          "normal contact stiffness, and it is zero");
    }
  }
}

TEST(AttachedModel, ForcesAndOutputsOnASurfaceFollowItsArea) {
  const mesh::Mesh mesh = cantilever();
  const mesh::Surface& tip = mesh.surface("x1");
  const Eigen::Vector3d direction(0.0, 0.6, 0.8);
  const Eigen::VectorXd load = unit_load(mesh, "x1", direction);
  const Eigen::MatrixX3d tractions = fem::uniform_tractions(mesh.nodes(), tip, mesh::FaceFrame{});
  EXPECT_LT((load - tractions * direction / tip.area).norm(), 1e-14);
  // The mean of a field quadratic over the face, y² along the direction: b²/3; equal shares miss
  // it.
  Eigen::VectorXd field(load.size());
  double of_nodes = 0.0;
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i)
    field.segment<3>(3 * i) = std::pow(mesh.nodes()(i, 1), 2) * direction;
  for (const Eigen::Index i : tip.nodes)
    of_nodes += std::pow(mesh.nodes()(i, 1), 2) / static_cast<double>(tip.nodes.size());
  EXPECT_NEAR(load.dot(field), 0.02 * 0.02 / 3.0, 1e-14);
  EXPECT_GT(std::abs(of_nodes - 0.02 * 0.02 / 3.0), 1e-6);
  const Eigen::VectorXd point = unit_load(mesh, "corner", direction);
  EXPECT_EQ((point.array() != 0.0).count(), 2);
}

// The face is small beside the beam: half the shapes move it otherwise than the rest by less than
// is seen.
TEST(AttachedModel, APeakIsTheSameWithAllModesAndWithTheMotionsThatThePatchHas) {
  const mesh::Mesh mesh = cantilever();
  const SceneDescription scene = scene_with(
      {"contact.points=60", "response.harmonics=3", "effects.normal_motion=auto", "modes.count=8",
       "contact.normal_stiffness='1e11 N/m^3'", "contact.tangential_stiffness='1e11 N/m^3'"});
  ReducedModel model = model_with(mesh, scene);
  const Eigen::Index n = model.frequency.size();
  ASSERT_FALSE(model.coordinates.all_modes());
  EXPECT_LT(model.coordinates.of_modes.rows(), n);
  EXPECT_TRUE((model.coordinates.of_modes * model.coordinates.motion).isIdentity(1e-10));
  const solver::ResponsePoint few = peak_of(model, scene);
  EXPECT_GT(few.report.slip_share, 0.1);
  const Eigen::Index r = model.coordinates.of_modes.rows();
  model.coordinates = {};
  const solver::ResponsePoint all = peak_of(model, scene);
  std::printf("%d of %d coordinates: %.3g of the peak\n", static_cast<int>(r), static_cast<int>(n),
              few.amplitude / all.amplitude - 1.0);
  EXPECT_NEAR(few.amplitude, all.amplitude, 2e-6 * all.amplitude);
  EXPECT_NEAR(few.frequency, all.frequency, 2e-6 * all.frequency);
}

// Modes solved anew on the same mesh, cells and harmonics: as a scene file that says so.
TEST(AttachedModel, WithOtherSettingsIsThatOfASceneThatHasThem) {
  const mesh::Mesh mesh = cantilever();
  const SceneDescription lean = scene_with({"modes.count=4"});
  const SolvedStructure structure{mesh, solve_structure(mesh, lean)};
  Discretisation settings = lean.settings;
  settings.basis.n_modes = 6;
  settings.basis.attachment_degree = 1;
  settings.patches.front().n_points = 9;
  settings.harmonics = {.highest = 3, .orders = {1, 3}};
  std::vector<std::string> warnings;
  const ReducedModel richer =
      microslip::pipelines::model_with(settings, lean, &structure, warnings);
  const ReducedModel said =
      model_with(mesh, scene_with({"modes.count=6", "modes.attachment_degree=1", "contact.points=9",
                                   "response.harmonics=[1, 3]"}));
  EXPECT_EQ(richer.effects.n_harmonics, 3);
  ASSERT_EQ(richer.frequency.size(), said.frequency.size());
  EXPECT_LT((richer.frequency - said.frequency).norm(), 1e-9 * said.frequency.norm());
  EXPECT_EQ(richer.patches.front().cells.points, said.patches.front().cells.points);
  EXPECT_GE(richer.patches.front().cells.size(), 9);
  EXPECT_THROW(static_cast<void>(
                   microslip::pipelines::model_with(Discretisation{}, lean, &structure, warnings)),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::pipelines::test_attached_model
