#include "pipelines/files/write_map.hpp"
#include "pipelines/model/reduced_model.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include "tests/pipelines/hdf5_reading.hpp"
#include "tests/pipelines/synthetic_run.hpp"
#include "tests/pipelines/vtk_reading.hpp"

namespace microslip::pipelines::test_write_map {
namespace {

void expect_instant(vtkDataSetAttributes& data, const contact::ContactMap& map, Eigen::Index j) {
  EXPECT_EQ(values(data, "state").col(0).cast<int>(), map.state.col(j).cast<int>());
  EXPECT_EQ(values(data, "normal_traction_Pa"), map.normal_traction.col(j));
  EXPECT_EQ(values(data, "friction_traction_Pa"), map.friction_traction.col(j));
  EXPECT_EQ(values(data, "relative_displacement_m"), map.relative_displacement.col(j));
  EXPECT_EQ(values(data, "approach_m"), map.approach.col(j));
  EXPECT_EQ(values(data, "slip_m"), map.slip.col(j));
  EXPECT_EQ(values(data, "dissipated_energy_J_per_m2"), map.dissipated_energy);
  EXPECT_EQ(values(data, "slip_distance_m"), map.slip_distance);
  EXPECT_EQ(values(data, "wear_depth_m"), map.wear_depth);
  const char* starts[] = {"stick_start_deg", "positive_slip_start_deg", "negative_slip_start_deg",
                          "separation_start_deg", "slip_start_deg"};
  for (Eigen::Index state = 0; state < 5; ++state) {
    EXPECT_TRUE(
        values(data, starts[state]).isApprox(map.state_start.col(state) * (180.0 / M_PI), 1e-15));
  }
  EXPECT_EQ(values(data, "slip_duration"), map.slip_duration);
  EXPECT_EQ(values(data, "separation_share"), map.state_share.col(3));
  EXPECT_EQ(values(data, "stick_starts"), Eigen::VectorXd::Ones(map.state_share.rows()));
  EXPECT_EQ(values(data, "slip_guard_Pa"), map.slip_guard);
  EXPECT_EQ(values(data, "smallest_load_Pa"), map.smallest_load);
  EXPECT_EQ(values(data, "largest_load_Pa"), map.largest_load);
  EXPECT_EQ(values(data, "separation_duration"), map.separation_duration);
}

TEST(WriteMap, SeriesGoesOnceAroundThePeriodInDegrees) {
  const synthetic::Folder folder("map_series");
  const ReducedModel model = synthetic::model();
  write_map(folder.path() / "maps", model.patches[0],
            synthetic::named_map(model, "preload_7_peak"));
  const auto steps = pvd_steps(folder.path() / "maps" / "preload_7_peak.pvd");
  ASSERT_EQ(steps.size(), 9U);  // 8 phases and the first again at 360°
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].first, 45.0 * static_cast<double>(i));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "maps" / steps[i].second));
  }
  EXPECT_EQ(steps.back().second, steps.front().second);
}

TEST(WriteMap, EveryPhaseCarriesAllArraysOnCellsAndPoints) {
  const synthetic::Folder folder("map_arrays");
  const ReducedModel model = synthetic::model();
  const NamedMap map = synthetic::named_map(model, "m");
  write_map(folder.path(), model.patches[0], map);
  const auto patch = read_vtp(folder.path() / "m_003.vtp");
  ASSERT_EQ(patch->GetNumberOfCells(), model.patches[0].connectivity.rows());
  ASSERT_EQ(patch->GetNumberOfPoints(), model.patches[0].vertices.points.rows());
  expect_instant(*patch->GetCellData(), map.points, 3);
  expect_instant(*patch->GetPointData(), map.vertices, 3);
  ASSERT_NE(patch->GetCellData()->GetScalars(), nullptr);
  EXPECT_STREQ(patch->GetCellData()->GetScalars()->GetName(), "state");
  EXPECT_EQ(patch->GetPointData()->GetScalars(), nullptr)
      << "ParaView would colour by the points and blend the states";
  EXPECT_EQ(values(*patch->GetFieldData(), "frequency_Hz")(0, 0), 301.25);
  EXPECT_EQ(values(*patch->GetFieldData(), "phase_deg")(0, 0), 135.0);
  const auto* names =
      vtkStringArray::SafeDownCast(patch->GetFieldData()->GetAbstractArray("state_names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetNumberOfValues(), 5);
}

TEST(WriteMap, CellsStandInWorldCoordinatesOverTheirContactPoints) {
  const synthetic::Folder folder("map_cells");
  const ReducedModel model = synthetic::model();
  write_map(folder.path(), model.patches[0], synthetic::named_map(model, "m", 1));
  const auto patch = read_vtp(folder.path() / "m_000.vtp");
  for (vtkIdType cell = 0; cell < patch->GetNumberOfCells(); ++cell) {
    std::array<double, 6> box{};
    patch->GetCellBounds(cell, box.data());
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(2 * axis);
      EXPECT_NEAR((box[k] + box[k + 1]) / 2, model.patches[0].cells.points(cell, axis),
                  1e-15);  // rounding of 0.05
    }
  }
}

TEST(WriteMap, ModelWithoutCellsGivesOneVertexPerPoint) {
  const synthetic::Folder folder("map_points");
  ReducedModel model = synthetic::model();
  model.patches[0].connectivity.resize(0, 0);
  model.patches[0].vertices.points.resize(0, 3);
  const NamedMap map = synthetic::named_map(model, "m");
  write_map(folder.path(), model.patches[0], map);
  const auto patch = read_vtp(folder.path() / "m_005.vtp");
  ASSERT_EQ(patch->GetNumberOfVerts(), model.patches[0].cells.points.rows());
  ASSERT_EQ(patch->GetNumberOfPoints(), model.patches[0].cells.points.rows());
  expect_instant(*patch->GetCellData(), map.points, 5);
  expect_instant(*patch->GetPointData(), map.points, 5);
  EXPECT_EQ(patch->GetPoint(7)[2], model.patches[0].cells.points(7, 2));
}

TEST(WriteMap, PointsWithoutPositionsStandInARow) {
  const synthetic::Folder folder("map_row");
  ReducedModel model = synthetic::model(1, 3);
  const NamedMap map = synthetic::named_map(model, "m");
  model.patches[0].connectivity.resize(0, 0);
  model.patches[0].cells.points.resize(0, 3);
  write_map(folder.path(), model.patches[0], map);
  const auto patch = read_vtp(folder.path() / "m_000.vtp");
  ASSERT_EQ(patch->GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < 3; ++i) {
    const Eigen::RowVector3d expected =
        1e-3 * static_cast<double>(i) * model.patches[0].frame.row(0);
    EXPECT_EQ(Eigen::RowVector3d(patch->GetPoint(i)), expected);
  }
}

TEST(WriteMap, DataFileHoldsAllPhasesInThePlaneOfThePatch) {
  const synthetic::Folder folder("map_data");
  const ReducedModel model = synthetic::model();
  const NamedMap map = synthetic::named_map(model, "m");
  write_map(folder.path(), model.patches[0], map);
  const std::filesystem::path file = folder.path() / "m.h5";
  EXPECT_EQ(dataset_of(file, "/state").cast<std::uint8_t>(), map.points.state);
  EXPECT_EQ(dataset_of(file, "/normal_traction_Pa"), map.points.normal_traction);
  const Eigen::MatrixXd points = dataset_of(file, "/points");
  EXPECT_LT((model.patches[0].cells.weights.transpose() * points).norm(),
            1e-15 * model.patches[0].cells.weights.sum())
      << "p and r count from the centroid";
  EXPECT_NEAR(points(8, 0) - points(0, 0), 2e-3, 1e-15);  // one cell further along p = z
  EXPECT_NEAR(points(1, 1) - points(0, 1), 1e-3, 1e-15);  // one cell further along r = −x
}

TEST(WriteMap, MapOfAnotherPatchIsRefused) {
  const synthetic::Folder folder("map_other");
  const ReducedModel model = synthetic::model();
  const NamedMap other = synthetic::named_map(synthetic::model(2, 2), "m");
  EXPECT_THROW(write_map(folder.path() / "maps", model.patches[0], other), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "maps"));
}

}  // namespace
}  // namespace microslip::pipelines::test_write_map
