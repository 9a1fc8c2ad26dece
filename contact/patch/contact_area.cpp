#include "contact/patch/contact_area.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace microslip::contact {
namespace {

[[noreturn]] void refuse(const std::string& quantity, double value, const char* allowed) {
  std::ostringstream message;
  message.precision(17);
  message << "contact area: " << quantity << " = " << value << ", must be " << allowed;
  throw std::invalid_argument(message.str());
}

void require_positive(const char* quantity, double value) {
  if (!(std::isfinite(value) && value > 0.0)) refuse(quantity, value, "finite and above 0");
}

// −½ + (j + ½)/n without rounding the middle of an odd number away from 0.
double centre(int j, int n, double length) { return length * (2 * j + 1 - n) / (2.0 * n); }

}  // namespace

PlanarCells rectangle_cells(double height, double breadth, int n_along_y, int n_along_z) {
  require_positive("height", height);
  require_positive("breadth", breadth);
  require_positive("number of cells along y", n_along_y);
  require_positive("number of cells along z", n_along_z);
  const Eigen::Index n = static_cast<Eigen::Index>(n_along_y) * n_along_z;
  const double area = (height / n_along_y) * (breadth / n_along_z);
  PlanarCells cells{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd::Constant(n, area)};
  Eigen::Index i = 0;
  for (int j = 0; j < n_along_y; ++j) {
    for (int k = 0; k < n_along_z; ++k, ++i) {
      cells.y[i] = centre(j, n_along_y, height);
      cells.z[i] = centre(k, n_along_z, breadth);
    }
  }
  return cells;
}

CellMatrix cell_matrix(double y, double z) {
  CellMatrix G;
  G << 1.0, 0.0, 0.0, 0.0, z, -y,   //
      0.0, 1.0, 0.0, -z, 0.0, 0.0,  //
      0.0, 0.0, 1.0, y, 0.0, 0.0;
  return G;
}

ContactArea::ContactArea(PlanarCells cells) : cells_(std::move(cells)) {
  const Eigen::Index n = cells_.weights.size();
  if (cells_.y.size() != n || cells_.z.size() != n) {
    throw std::invalid_argument("contact area: " + std::to_string(cells_.y.size()) + " y, " +
                                std::to_string(cells_.z.size()) + " z and " + std::to_string(n) +
                                " weights; as many of each");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::string cell = " of cell " + std::to_string(i + 1);
    if (!std::isfinite(cells_.y[i])) refuse("y" + cell, cells_.y[i], "finite");
    if (!std::isfinite(cells_.z[i])) refuse("z" + cell, cells_.z[i], "finite");
    if (!(std::isfinite(cells_.weights[i]) && cells_.weights[i] >= 0.0)) {
      refuse("weight" + cell, cells_.weights[i], "finite and at least 0");
    }
  }
  require_positive("sum of weights", cells_.weights.sum());
}

ModalShapes ContactArea::modal_shapes(const Eigen::Ref<const Eigen::MatrixXd>& modes) const {
  if (modes.rows() != 6) {
    throw std::invalid_argument("contact area: modes with " + std::to_string(modes.rows()) +
                                " rows, must be 6");
  }
  ModalShapes shapes{Eigen::MatrixXd(n_cells(), modes.cols()),
                     Eigen::MatrixXd(n_cells(), modes.cols()),
                     Eigen::MatrixXd(n_cells(), modes.cols())};
  for (Eigen::Index i = 0; i < n_cells(); ++i) {
    const CellMatrix G = cell_matrix(cells_.y[i], cells_.z[i]);
    shapes.v.row(i) = G.row(0) * modes;  // x is q
    shapes.w.row(i) = G.row(1) * modes;  // y is r
    shapes.u.row(i) = G.row(2) * modes;  // z is p
  }
  return shapes;
}

}  // namespace microslip::contact
