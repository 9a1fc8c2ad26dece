#include "pipelines/model/reduced_model.hpp"
#include "pipelines/model/patch_fields.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "pipelines/model/contact_stage.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::pipelines {
namespace {

mesh::Mesh box(mesh::ElementType type, bool skewed) {
  test::BoxGrid grid;
  grid.size = {0.03, 0.02, 0.01};
  grid.cells = {3, 2, 1};
  if (skewed) {
    grid.map = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
      return {x[0] + 0.3 * x[1] + 5.0 * x[0] * x[1], x[1] - 4.0 * x[0] * x[1], x[2]};
    };
  }
  return test::straight_box_mesh(type, grid);
}

SceneDescription scene_on(const char* friction) {
  SceneDescription scene;
  scene.modes.damping = std::vector<double>{0.01};
  scene.contact.emplace();
  ContactDescription& contact = *scene.contact;
  contact.surface = "z1";
  contact.slip_direction = {1.0, 0.5, 0.0};
  contact.friction.value = FieldExpression{friction};
  contact.normal_stiffness = 2e11;
  contact.tangential_stiffness = 1e11;
  contact.fit = ContactDescription::Fit::degree;
  contact.fit_degree = 2;
  contact.n_points = 100;
  contact.quadrature = ContactDescription::Quadrature::fitted;
  return scene;
}

/// Two smooth motions of the nodes.
fem::ModalBasis basis_of(const mesh::Mesh& mesh) {
  fem::ModalBasis basis;
  basis.frequency = Eigen::Vector2d(100.0, 200.0);
  basis.shapes.resize(3 * mesh.n_nodes(), 2);
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    const Eigen::Vector3d x = 50.0 * mesh.nodes().row(i).transpose();
    basis.shapes.col(0).segment<3>(3 * i) << 1.0 + x[0], x[1] * x[0], 0.5 - x[1] * x[1];
    basis.shapes.col(1).segment<3>(3 * i) << x[1], 1.0, x[0];
  }
  return basis;
}

/// Another compliance at every node.
fem::ResidualFlexibility residual_on(const mesh::Mesh& mesh) {
  fem::ResidualFlexibility residual;
  const auto n = static_cast<Eigen::Index>(mesh.surface("z1").nodes.size());
  residual.row_sums.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double a = 1.0 + 0.8 * std::sin(3.0 * static_cast<double>(i));
    residual.row_sums.row(i) << 1e-12 * a, 2e-12 / a, 1e-12;
  }
  return residual;
}

ReducedModel model_of(const mesh::Mesh& mesh, const SceneDescription& scene, bool with_residual) {
  std::vector<std::string> warnings;
  const fem::ResidualFlexibility residual = residual_on(mesh);
  return reduce_to_contact(mesh, scene, basis_of(mesh), with_residual ? &residual : nullptr,
                           warnings);
}

struct PlanePoints {
  Eigen::VectorXd p, r;
};

PlanePoints points_of(const ReducedModel& model) {
  const Eigen::MatrixX3d local = model.points.rowwise() - patch_centroid(model).transpose();
  return {local * model.frame.row(0).transpose(), local * model.frame.row(2).transpose()};
}

struct Case {
  mesh::ElementType type;
  bool skewed;
};
class Fields : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Elements, Fields,
                         testing::Values(Case{mesh::ElementType::tet4, false},
                                         Case{mesh::ElementType::tet10, true},
                                         Case{mesh::ElementType::hex8, true},
                                         Case{mesh::ElementType::hex20, true}));

// The points of the cells are places like any other.
TEST_P(Fields, AreThoseOfTheCellsAtTheirPoints) {
  const mesh::Mesh mesh = box(GetParam().type, GetParam().skewed);
  const ReducedModel model = model_of(mesh, scene_on("0.3 + 5 * p - 100 * p * r"), true);
  ASSERT_TRUE(model.fields);
  const auto [p, r] = points_of(model);
  const auto expected = point_parameters(model, 80.0, false);
  const auto found = model.fields->parameters(p, r, 80.0);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-11 * std::abs(b)); };
    near(found[i].tangential_stiffness, expected[i].tangential_stiffness);
    near(found[i].normal_stiffness, expected[i].normal_stiffness);
    near(found[i].friction_coefficient, expected[i].friction_coefficient);
    near(found[i].preload, expected[i].preload);
  }
  const contact::ModalShapes shapes = model.fields->shapes(p, r);
  EXPECT_LT((shapes.u - model.shapes.u).norm(), 1e-11 * model.shapes.u.norm());
  EXPECT_LT((shapes.v - model.shapes.v).norm(), 1e-11 * model.shapes.v.norm());
}

TEST_P(Fields, CellsAreThePatchAndHoldTheLoad) {
  const mesh::Mesh mesh = box(GetParam().type, GetParam().skewed);
  const ReducedModel model = model_of(mesh, scene_on("0.3"), true);
  const double area = mesh.surface("z1").area;
  const contact::PatchRule rule = contact::gauss_rule(model.fields->cells(), 8);
  EXPECT_NEAR(rule.weights.sum(), area, 1e-12 * area);
  for (const double load : {80.0, -50.0}) {  // negative: the gap that the springs close under 50 N
    const auto points = model.fields->parameters(rule.p, rule.r, load);
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      total += rule.weights[static_cast<Eigen::Index>(i)] * points[i].preload;
    }
    EXPECT_NEAR(total, load, 1e-11 * std::abs(load));
  }
}

TEST(PatchFields, ARectangleOfOneStiffnessIsOneCell) {
  const mesh::Mesh mesh = box(mesh::ElementType::hex8, false);
  SceneDescription scene = scene_on("0.3");
  scene.contact->slip_direction = {1.0, 0.0, 0.0};
  EXPECT_EQ(model_of(mesh, scene, false).fields->cells().corners.rows(), 1);
  EXPECT_EQ(model_of(mesh, scene, true).fields->cells().corners.rows(), 6);
  scene.contact->slip_direction = {1.0, 0.5, 0.0};  // a rectangle, but not along p and r
  EXPECT_EQ(model_of(mesh, scene, false).fields->cells().corners.rows(), 6);
}

TEST(PatchFields, APreloadFieldKeepsItsShapeAndTotal) {
  const mesh::Mesh mesh = box(mesh::ElementType::tet10, true);
  SceneDescription scene = scene_on("0.3");
  scene.contact->preload_field.emplace();
  scene.contact->preload_field->value = FieldExpression{"2 + 80 * p + 3000 * p * r"};
  const ReducedModel model = model_of(mesh, scene, true);
  const contact::PatchRule rule = contact::gauss_rule(model.fields->cells(), 4);
  const auto points = model.fields->parameters(rule.p, rule.r, 10.0);
  double total = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double shape = 2.0 + 80.0 * rule.p[row] + 3000.0 * rule.p[row] * rule.r[row];
    total += rule.weights[row] * points[i].preload;
    if (i == 0) scale = points[i].preload / shape;
    EXPECT_NEAR(points[i].preload, scale * shape, 1e-10 * std::abs(scale));
  }
  EXPECT_NEAR(total, 10.0, 1e-10);
}

// A field that is partly a gap: the pressed part alone carries the load, on cells and where lines are followed.
TEST(PatchFields, APartlyOpenFieldCarriesTheTotal) {
  const mesh::Mesh mesh = box(mesh::ElementType::hex8, false);
  SceneDescription scene = scene_on("0.3");
  scene.contact->slip_direction = {1.0, 0.0, 0.0};
  const Eigen::Vector3d size = mesh.upper() - mesh.lower();
  scene.contact->preload_field.emplace();  // gap over the first quarter of the length
  scene.contact->preload_field->value = FieldExpression{fmt::format("p + {:.17g}", 0.25 * size.x())};
  const ReducedModel model = model_of(mesh, scene, false);
  double carried = 0.0;
  const auto cells = point_parameters(model, 100.0, false);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    carried += model.weights[static_cast<Eigen::Index>(i)] * std::max(cells[i].preload, 0.0);
  }
  EXPECT_NEAR(carried, 100.0, 1e-10);
  // ∫ max(s (p + L/4), 0) dA = s (3L/4)² / 2 · B
  const double s = 100.0 / (0.5 * std::pow(0.75 * size.x(), 2) * size.y());
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(5, -0.5 * size.x(), 0.5 * size.x());
  const auto fitted = model.fields->parameters(p, Eigen::VectorXd::Zero(5), 100.0);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const double expected = s * (p[static_cast<Eigen::Index>(i)] + 0.25 * size.x());
    EXPECT_NEAR(fitted[i].preload, expected, 1e-9 * s * size.x());  // the rule finds the line to 1e-10
  }
}

TEST(PatchFields, AFieldThatIsMostlyAGapIsRefused) {
  const mesh::Mesh mesh = box(mesh::ElementType::hex8, false);
  SceneDescription scene = scene_on("0.3");
  scene.contact->preload_field.emplace();
  scene.contact->preload_field->place = "a.toml:7: contact.preload_field";
  for (const char* field : {"-0.5 + 1e-3 * p", "p"}) {
    scene.contact->preload_field->value = FieldExpression{field};
    try {
      static_cast<void>(model_of(mesh, scene, false));
      FAIL() << field;
    } catch (const SceneError& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.rfind("a.toml:7: contact.preload_field: ", 0), 0U) << said;
      EXPECT_NE(said.find("above 0"), std::string::npos) << said;
    }
  }
}

TEST(PatchFields, AreThereForTheFittedQuadratureAlone) {
  const mesh::Mesh mesh = box(mesh::ElementType::tet4, false);
  SceneDescription scene = scene_on("0.3");
  scene.contact->quadrature = ContactDescription::Quadrature::cells;
  EXPECT_FALSE(model_of(mesh, scene, true).fields);
}

}  // namespace
}  // namespace microslip::pipelines
