// Contact on a curved face: a sector of a tube, held at one end, whose inner face is a contact.
//
// Direct: K + local springs at the points of the face, along
//   q = −e_r(φ)   (out of the body),   p = s less its part along q, normalised,   r = p × q
// of the cylinder itself, φ the angle of the point: neither the elements nor a plane tell these
// axes. Reduced: modes without contact and attachment shapes, the stuck limit of the patch.
// Compared: the first stuck frequencies. They err upward, by what the basis leaves out; faces of
// order 2 follow the cylinder so closely (an angle of 0.15 rad each) that their normals are off by
// 1e-4 at most, which turns a spring and changes a frequency by its square.
//
// Static preload: the same face pressed by an interference against the direct solution (K + S) u =
// S u_g with normal springs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fem/modal_analysis.hpp"
#include "fem/surface_load.hpp"
#include "pipelines/accuracy/left_out.hpp"
#include "pipelines/accuracy/models_left_out.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/effects/effects.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/contact_frame.hpp"
#include "pipelines/model/linear_limits.hpp"
#include "pipelines/response/curve_requirements.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/scene/scene_file.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/surface_springs.hpp"

namespace microslip::pipelines::curved_contact {
namespace {

constexpr double inner = 0.03;  // [m]
constexpr double thickness = 0.006;
constexpr double length = 0.02;
constexpr double middle_angle = 0.4;  // [rad]
constexpr double stiffness_p = 2e11;  // along p and r [N/m³]
constexpr double stiffness_q = 6e11;

constexpr const char* text = R"([model]
kind = "mesh"
file = "sector.msh"
[material]
youngs_modulus = 2.1e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["y0"]
[modes]
count = 16
attachment_degree = 3
[contact]
surface = "x0"
slip_direction = [{}, {}, 0.5]
friction_coefficient = 0.3
normal_stiffness = 6e11
tangential_stiffness = 2e11
points = 300
[excitation]
forces = [ {{ at = "y1", direction = [1, 0, 0], amplitude = 1 }} ]
[response]
output = {{ at = "corner", direction = [1, 0, 0] }}
frequency = [1000, 2000]
preload = [100]
)";

SceneDescription scene_of(const std::vector<std::string>& overrides = {}) {
  return parse_scene(
      fmt::format(fmt::runtime(text), -std::sin(middle_angle), std::cos(middle_angle)),
      "sector.toml", "/", overrides);
}

/// A sector whose inner face has this arc, and the same length whatever its angle.
test::BoxGrid sector(double angle, std::array<int, 3> cells = {2, 8, 3}) {
  const double radius = inner * 1.2 / angle;
  return {{1.0, 1.0, 1.0}, cells, [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            const double r = radius + thickness * x[0];
            const double phi = middle_angle + angle * (x[1] - 0.5);
            return {r * std::cos(phi), r * std::sin(phi), length * x[2]};
          }};
}

ReducedModel model_on(const mesh::Mesh& mesh, const SceneDescription& scene) {
  check_names(mesh, scene);
  const SolvedStructure solved{mesh, solve_structure(mesh, scene)};
  std::vector<std::string> warnings;
  return model_of(scene, &solved, warnings);
}

Eigen::VectorXd stuck_frequencies(const ReducedModel& model, Eigen::Index n) {
  return resonances(model, stuck_stiffness(model)).head(n);
}

/// Axes of the cylinder at places of its inner face.
std::vector<Eigen::Matrix3d> axes_of_the_cylinder(const Eigen::MatrixX3d& places,
                                                  const Eigen::Vector3d& slip) {
  std::vector<Eigen::Matrix3d> axes;
  for (const auto& x : places.rowwise()) {
    const Eigen::Vector3d q = -Eigen::Vector3d(x[0], x[1], 0.0).normalized();
    const Eigen::Vector3d p = q.cross(slip).cross(q).normalized();
    axes.emplace_back().col(0) = p;
    axes.back().col(1) = q;
    axes.back().col(2) = p.cross(q);
    axes.back().transposeInPlace();
  }
  return axes;
}

test::SprungStructure sprung(const mesh::Mesh& mesh, const SceneDescription& scene,
                             const mesh::SurfaceSampling& sampling,
                             const Eigen::RowVector3d& stiffness) {
  return {mesh,
          scene.material,
          scene.clamped,
          {mesh.surface("x0"), sampling.to_centres, sampling.weights, Eigen::Matrix3d::Zero(),
           stiffness.replicate(sampling.weights.size(), 1),
           axes_of_the_cylinder(sampling.centres, scene.contacts[0].slip_direction)}};
}

mesh::SurfaceSampling sampling_of(const mesh::Mesh& mesh, const SceneDescription& scene) {
  return mesh::sample_surface(mesh.nodes(), mesh.surface("x0"), contact_points(scene.settings, 0));
}

TEST(CurvedContact, TheStuckLimitIsThatOfSpringsAlongTheAxesOfTheCylinder) {
  for (const auto type : {mesh::ElementType::hex20, mesh::ElementType::tet10}) {
    const mesh::Mesh mesh = test::box_mesh(type, sector(1.2));
    const SceneDescription scene = scene_of();
    const Eigen::VectorXd reduced = stuck_frequencies(model_on(mesh, scene), 4);
    const Eigen::VectorXd plane =
        stuck_frequencies(model_on(mesh, scene_of({"effects.local_frames=off"})), 4);
    const auto direct =
        sprung(mesh, scene, sampling_of(mesh, scene), {stiffness_p, stiffness_q, stiffness_p})
            .modes(4);
    for (Eigen::Index n = 0; n < 4; ++n) {
      const double error = reduced[n] / direct.frequency[n] - 1.0;
      const double of_plane = plane[n] / direct.frequency[n] - 1.0;
      std::printf("%s mode %td: direct %9.2f rad/s, local frames %+.1e, one frame %+.1e\n",
                  mesh::name(type), n + 1, direct.frequency[n], error, of_plane);
      EXPECT_LT(std::abs(error), 5e-5) << n;  // what 16 modes and shapes of degree 3 leave out
    }
    EXPECT_GT((plane - direct.frequency).cwiseQuotient(direct.frequency).cwiseAbs().maxCoeff(),
              1e-2)
        << "else the case tells nothing";
  }
}

/// The part of the inner face up to so many faces along the arc, as a surface of its own.
mesh::Mesh with_part(const mesh::Mesh& mesh, double up_to_angle) {
  std::map<std::string, std::vector<mesh::FaceBlock>> surfaces;
  for (const std::string& name : mesh.surface_names()) surfaces[name] = mesh.surface(name).faces;
  for (const mesh::FaceBlock& block : mesh.surface("x0").faces) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index face = 0; face < block.connectivity.rows(); ++face) {
      Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
      for (const Eigen::Index node : block.connectivity.row(face)) middle += mesh.nodes().row(node);
      if (std::atan2(middle[1], middle[0]) < up_to_angle) kept.push_back(face);
    }
    surfaces["part"].push_back({block.type, block.connectivity(kept, Eigen::all)});
  }
  return {mesh.nodes(), mesh.elements(), surfaces, mesh.node_sets()};
}

TEST(CurvedContact, APlaceHasTheSameAxesWhateverFaceItIsAPartOf) {
  const mesh::Mesh mesh =
      with_part(test::box_mesh(mesh::ElementType::hex20, sector(1.2)), middle_angle);
  const ReducedModel whole =
      model_on(mesh, scene_of({"modes.residual=none", "modes.attachment_degree="}));
  const ReducedModel part = model_on(
      mesh, scene_of({"modes.residual=none", "modes.attachment_degree=", "contact.surface=part",
                      "contact.points=150"}));
  EXPECT_GT((whole.patches[0].frame - part.patches[0].frame).norm(), 0.1) << "mean planes differ";
  const contact::PatchSamples& all = whole.patches[0].cells;
  const contact::PatchSamples& some = part.patches[0].cells;
  Eigen::Index n_found = 0;
  for (Eigen::Index i = 0; i < some.size(); ++i) {
    Eigen::Index same = 0;
    const double off = (all.points.rowwise() - some.points.row(i)).rowwise().norm().minCoeff(&same);
    if (off > 1e-12) continue;
    ++n_found;
    EXPECT_EQ(some.normals.row(i), all.normals.row(same));
    EXPECT_EQ(some.slip_directions.row(i), all.slip_directions.row(same));
    EXPECT_LT((some.shapes.u.row(i) - all.shapes.u.row(same)).norm(),
              1e-9 * all.shapes.u.row(same).norm());
    EXPECT_LT((some.shapes.v.row(i) - all.shapes.v.row(same)).norm(),
              1e-9 * all.shapes.v.row(same).norm());
  }
  EXPECT_EQ(n_found, some.size());
}

TEST(CurvedContact, AFaceThatIsHardlyCurvedTendsToAPlaneOne) {
  std::vector<double> differences;
  for (const double angle : {0.05, 0.025, 0.0125}) {
    const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(angle));
    const Eigen::VectorXd local =
        stuck_frequencies(model_on(mesh, scene_of({"effects.local_frames=on"})), 3);
    const Eigen::VectorXd plane = stuck_frequencies(
        model_on(mesh, scene_of({"effects.local_frames=off", "contact.fit=none"})), 3);
    differences.push_back((local - plane).cwiseQuotient(plane).cwiseAbs().maxCoeff());
    std::printf("arc of %.4f rad: stuck frequencies differ by %.1e\n", angle, differences.back());
  }
  EXPECT_LT(differences[0], 2e-3);
  EXPECT_GT(differences[0] / differences[1], 1.8) << "with the angle at least";
  EXPECT_GT(differences[1] / differences[2], 1.8);
}

TEST(CurvedContact, OnAPlaneFaceLocalFramesAreTheOneFrameToTheLastBit) {
  const mesh::Mesh mesh =
      test::box_mesh(mesh::ElementType::hex20, {{thickness, inner, length}, {2, 5, 3}, {}});
  const ReducedModel as_is = model_on(mesh, scene_of());
  const ReducedModel on = model_on(mesh, scene_of({"effects.local_frames=on"}));
  EXPECT_EQ(as_is.frequency, on.frequency);
  EXPECT_EQ(as_is.patches[0].cells.shapes.u, on.patches[0].cells.shapes.u);
  EXPECT_EQ(as_is.patches[0].cells.shapes.v, on.patches[0].cells.shapes.v);
  EXPECT_EQ(as_is.patches[0].cells.shapes.w, on.patches[0].cells.shapes.w);
}

TEST(CurvedContact, ResidualFlexibilityWorksAlongTheAxesOfEveryPlace) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(1.2));
  const SceneDescription scene = scene_of({"modes.residual=stiffness", "modes.attachment_degree="});
  const ReducedModel model = model_on(mesh, scene);
  // Work of a uniform traction along p, q, r of every place on what the modes leave out: ∬ c dA.
  const Eigen::MatrixX3d loads =
      fem::uniform_tractions(mesh.nodes(), mesh.surface("x0"), face_frame(mesh, scene.contacts[0]));
  fem::Structure structure(mesh, scene.material, scene.clamped);
  const fem::ModalBasis basis = structure.solve_modes({.n_modes = 16});
  const Eigen::MatrixXd modal = basis.shapes.transpose() * loads;
  const Eigen::Matrix3d work =
      loads.transpose() * structure.solve_static(loads) -
      modal.transpose() * basis.frequency.cwiseAbs2().cwiseInverse().asDiagonal() * modal;
  const contact::PatchSamples& cells = model.patches[0].cells;
  for (const Eigen::Index axis : {0, 1, 2}) {
    const double sum = cells.compliance.col(axis).dot(cells.weights);
    EXPECT_NEAR(sum, work(axis, axis), 0.01 * work(axis, axis)) << axis;  // centres of cells
  }
}

TEST(CurvedContact, ChoiceAndSettingAreTold) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(1.2, {1, 6, 2}));
  const auto told = [&](const std::string& setting) {
    const SceneDescription scene = scene_of(
        {"modes.residual=none", "modes.attachment_degree=", "effects.local_frames=" + setting});
    const ReducedModel model = model_on(mesh, scene);
    const EffectRecord before = effect_in(effects_of(scene, nullptr, &mesh), "local_frames");
    const EffectRecord after = effect_in(effects_of(scene, &model), "local_frames");
    EXPECT_EQ(before.simulated, after.simulated);
    EXPECT_EQ(before.indicator, after.indicator);
    return after;
  };
  EXPECT_EQ(told("auto").simulated, Simulated::yes);
  EXPECT_GT(*told("auto").indicator, 0.05);
  EXPECT_EQ(told("on").simulated, Simulated::yes);
  EXPECT_EQ(told("off").simulated, Simulated::no);
  EXPECT_FALSE(told("off").objection.empty()) << "an off that is wrong is objected to";
}

struct Study {
  SceneDescription scene;
  SolvedStructure structure;
  ReducedModel model;
  CurveResult curve;
};

Study studied(const mesh::Mesh& mesh, const SceneDescription& scene) {
  check_names(mesh, scene);
  Study study{scene, {mesh, solve_structure(mesh, scene)}, {}, {}};
  std::vector<std::string> warnings;
  study.model = model_of(scene, &study.structure, warnings);
  study.curve = trace_curve(study.model, scene, curve_requests(scene).at(0),
                            [](const auto&) { return true; });
  return study;
}

struct Change {
  double amplitude = 0.0;
  double frequency = 0.0;
};

/// What the axes of every place change of the highest peak: told beside the curve without them, and
/// by a study with them.
std::array<Change, 2> told_and_true(const Study& without, const Study& with) {
  const RicherModels others = models_left_out(without.model, without.scene, &without.structure);
  EXPECT_EQ(others.models.size(), 1U) << others.note;
  if (others.models.size() != 1) return {};
  EXPECT_EQ(others.models[0].source, "local_frames");
  const auto rows = rows_left_out(without.model, without.scene, others.models, without.curve);
  EXPECT_EQ(rows.size(), 2U);
  if (rows.size() != 2) return {};
  const solver::ResponsePoint& own = *highest_peak(without.curve.curve);
  const solver::ResponsePoint& other = *highest_peak(with.curve.curve);
  const std::array changes{
      Change{rows[0].effect, rows[1].effect},
      Change{other.amplitude / own.amplitude - 1.0, other.frequency / own.frequency - 1.0}};
  std::printf("local frames left out: amplitude %+.6f, told %+.6f; frequency %+.7f, told %+.7f\n",
              changes[1].amplitude, changes[0].amplitude, changes[1].frequency,
              changes[0].frequency);
  return changes;
}

/// About the second mode with the contact stuck.
SceneDescription about_second_mode(const mesh::Mesh& mesh, const char* setting) {
  const auto scene_with = [&](double middle) {
    return scene_of({"contact.points=60", "response.harmonics=1", "response.preload=[\"stuck\"]",
                     "effects.second_direction=on",
                     fmt::format("response.frequency=[{}, {}]", 0.95 * middle, 1.05 * middle),
                     fmt::format("effects.local_frames={}", setting)});
  };
  const ReducedModel model = model_on(mesh, scene_with(1000.0));
  return scene_with(stuck_frequencies(model, 2)[1] / (2.0 * std::numbers::pi));
}

// The mean plane of a face in its place, and what that changes of the stuck peak.
TEST(CurvedContact, LeavingTheAxesOutHasABound) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(1.2, {1, 6, 2}));
  const Study without = studied(mesh, about_second_mode(mesh, "off"));
  SceneDescription scene = without.scene;
  scene.contacts[0].local_frames.reset();
  const auto [told, change] = told_and_true(without, studied(mesh, scene));
  EXPECT_GT(std::abs(change.amplitude) + std::abs(change.frequency), 0.01);
  EXPECT_NEAR(told.amplitude, change.amplitude, 1e-4);
  EXPECT_NEAR(told.frequency, change.frequency, 1e-6);
}

// Below the limit they are left out by the program, which tells what that changes without solving
// modes again.
TEST(CurvedContact, AxesLeftOutOfAFaceThatIsAllButPlaneHaveABound) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(0.06, {1, 6, 2}));
  const Study without = studied(mesh, about_second_mode(mesh, "auto"));
  ASSERT_EQ(effect_in(effects_of(without.scene, &without.model), "local_frames").simulated,
            Simulated::no);
  ASSERT_GT(without.model.patches[0].off_plane, 1e-3);
  EXPECT_FALSE(leaving_out_changes_modes("local_frames", without.scene));
  SceneDescription scene = without.scene;
  scene.contacts[0].local_frames = true;
  const auto [told, change] = told_and_true(without, studied(mesh, scene));
  EXPECT_GT(std::abs(change.amplitude), 1e-3);
  EXPECT_NEAR(told.amplitude, change.amplitude, 1e-5);
  EXPECT_NEAR(told.frequency, change.frequency, 1e-6);
}

// What is kept along the axes of the face is solved for again.
TEST(CurvedContact, AxesLeftOutAreHadWithResidualFlexibilityAndStaticPreload) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(0.06, {1, 6, 2}));
  const std::vector<std::vector<std::string>> settings{
      {"modes.residual=stiffness", "modes.attachment_degree="},
      {"contact.preload=static", "contact.gap=-1e-5", "contact.normal_stiffness=2e9"}};
  for (std::vector<std::string> overrides : settings) {
    overrides.emplace_back("contact.points=60");
    const Study study = studied(mesh, scene_of(overrides));
    EXPECT_TRUE(leaving_out_changes_modes("local_frames", study.scene));
    const RicherModels others = models_left_out(study.model, study.scene, &study.structure);
    const auto frames = std::ranges::find(others.models, "local_frames", &RicherModel::source);
    ASSERT_NE(frames, others.models.end()) << others.note;
    EXPECT_GT(frames->model.patches[0].cells.normals.rows(), 0);
  }
}

TEST(CurvedContact, StaticPreloadPressesAlongTheNormalsOfEveryPlace) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex20, sector(1.2));
  constexpr double interference = 1e-5;
  constexpr double layer = 2e9;  // soft beside the body, so that no place lifts off
  const SceneDescription scene =
      scene_of({"contact.preload=static", "contact.gap=-1e-5", "contact.normal_stiffness=2e9",
                "static.forces=[{ at = \"y1\", direction = [0, 0, 1], "
                "amplitude = 1e-6 }]"});
  const ReducedModel model = model_on(mesh, scene);
  const mesh::SurfaceSampling sampling = sampling_of(mesh, scene);
  const auto axes = axes_of_the_cylinder(sampling.centres, scene.contacts[0].slip_direction);
  // Springs −k (v + interference) along q: what they push with at rest is a load.
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 1);
  const Eigen::SparseMatrix<double>& to = sampling.to_centres;
  for (Eigen::Index j = 0; j < to.outerSize(); ++j) {
    const Eigen::Index node = mesh.surface("x0").nodes[static_cast<std::size_t>(j)];
    for (Eigen::SparseMatrix<double>::InnerIterator it(to, j); it; ++it) {
      const Eigen::Vector3d q = axes[static_cast<std::size_t>(it.row())].row(1);
      load.block<3, 1>(3 * node, 0) -=
          layer * interference * sampling.weights[it.row()] * it.value() * q;
    }
  }
  const Eigen::MatrixXd u = sprung(mesh, scene, sampling, {0.0, layer, 0.0}).response(0.0, load);
  Eigen::MatrixX3d nodal(to.cols(), 3);
  for (Eigen::Index j = 0; j < to.cols(); ++j) {
    nodal.row(j) =
        u.block<3, 1>(3 * mesh.surface("x0").nodes[static_cast<std::size_t>(j)], 0).transpose();
  }
  const Eigen::MatrixX3d moved = to * nodal;
  Eigen::VectorXd pressure(moved.rows());
  for (Eigen::Index i = 0; i < pressure.size(); ++i) {
    pressure[i] =
        layer * (interference + moved.row(i).dot(axes[static_cast<std::size_t>(i)].row(1)));
  }
  ASSERT_GT(pressure.minCoeff(), 0.0) << "closed everywhere, else the direct solution is none";
  const Eigen::VectorXd found = *model.static_preload * model.patches[0].cells.preload_field;
  const double off = (found - pressure).cwiseAbs().maxCoeff() / pressure.maxCoeff();
  std::printf("static preload %.4f N, pressure %.3g to %.3g Pa, off by %.1e\n",
              *model.static_preload, pressure.minCoeff(), pressure.maxCoeff(), off);
  EXPECT_LT(off, 1e-5);  // normals of the elements against those of the cylinder
}

}  // namespace
}  // namespace microslip::pipelines::curved_contact
