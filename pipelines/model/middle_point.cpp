#include "pipelines/model/middle_point.hpp"

namespace microslip::pipelines {

contact::Patch at_middle_point(contact::Patch patch) {
  contact::PatchSamples& cells = patch.cells;
  const double area = cells.weights.sum();
  const Eigen::RowVectorXd share = cells.weights.transpose() / area;
  const auto mean = [&](auto& values) {
    if (values.rows() > 0) values = (share * values).eval();
  };
  mean(cells.points);
  mean(cells.shapes.u);
  mean(cells.shapes.v);
  mean(cells.shapes.w);
  mean(cells.stiffness);
  mean(cells.friction);
  mean(cells.preload_field);
  mean(cells.compliance);
  cells.weights = Eigen::VectorXd::Constant(1, area);
  cells.slip_directions.resize(0, 3);
  cells.normals.resize(0, 3);
  patch.vertices = {};
  patch.connectivity.resize(0, 0);
  patch.tilted_areas.clear();
  return patch;
}

}  // namespace microslip::pipelines
