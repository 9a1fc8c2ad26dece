#include "contact/patch/preload_field.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include <Eigen/LU>
#include <Eigen/QR>

namespace microslip::contact {
namespace {

void require_size(const char* name, const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
  if (values.size() != weights.size()) {
    throw std::invalid_argument("preload: " + std::to_string(values.size()) + " values of " + name +
                                " for " + std::to_string(weights.size()) + " points");
  }
  if (!values.allFinite()) {
    throw std::invalid_argument("preload: " + std::string(name) +
                                " has a value that is not finite");
  }
}

double area_of(const Eigen::VectorXd& weights) {
  const double area = weights.sum();
  if (!(area > 0.0 && std::isfinite(area))) {
    std::ostringstream message;
    message << "preload: the area is " << area << " m^2, must be above 0";
    throw std::invalid_argument(message.str());
  }
  return area;
}

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream message;
  message.precision(12);
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

// Basis of the linear fields: 1 and the coordinates from the centroid, scaled to radii of gyration.
struct LinearBasis {
  LinearBasis(const Eigen::VectorXd& p, const Eigen::VectorXd& r, const Eigen::VectorXd& w)
      : area(area_of(w)), centroid(w.dot(p) / area, w.dot(r) / area), functions(p.size(), 3) {
    functions.col(0).setOnes();
    functions.col(1) = p.array() - centroid[0];
    functions.col(2) = r.array() - centroid[1];
    const Eigen::Array2d squares(w.dot(functions.col(1).cwiseAbs2()),
                                 w.dot(functions.col(2).cwiseAbs2()));
    size = std::sqrt(squares.sum() / area);
    if (size > 0.0) {
      functions.rightCols(2) /= size;
    }
  }

  double area;
  Eigen::Vector2d centroid;
  double size = 0.0;
  Eigen::MatrixX3d functions;
};

}  // namespace

Eigen::VectorXd uniform_preload(const Eigen::VectorXd& weights, double force) {
  return Eigen::VectorXd::Constant(weights.size(), force / area_of(weights));
}

Eigen::VectorXd linear_preload(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                               const Eigen::VectorXd& weights, const PreloadResultants& requested) {
  require_size("p", p, weights);
  require_size("r", r, weights);
  const LinearBasis basis(p, r, weights);
  // Moments about the centroid: what the force at the centroid does not already give.
  const Eigen::Vector2d moment(requested.moment_about_r - basis.centroid[0] * requested.force,
                               -requested.moment_about_p - basis.centroid[1] * requested.force);
  const Eigen::Vector2d scaled = basis.size > 0.0 ? Eigen::Vector2d(moment / basis.size) : moment;
  const Eigen::MatrixX2d shape = basis.functions.rightCols(2);
  const Eigen::Matrix2d inertia = shape.transpose() * weights.asDiagonal() * shape;
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix2d> solver;
  solver.setThreshold(1e-12);  // the square of a width of 1e-6 of the length
  solver.compute(inertia);
  Eigen::Vector2d slope = solver.solve(scaled);
  slope += solver.solve(scaled - inertia * slope);
  const double missing = (scaled - inertia * slope).norm();
  const double scale = std::abs(requested.force) + scaled.norm();
  // A moment of 1e-10 of the load's own size is rounding of the request.
  if (missing > 1e-10 * scale) {
    refuse("preload moments about p and r = ", requested.moment_about_p, " and ",
           requested.moment_about_r, " N m: the ", p.size(),
           " contact points lie on a line and cannot carry the part of them about this line");
  }
  Eigen::VectorXd pressure = shape * slope;
  pressure.array() += requested.force / basis.area;
  return pressure;
}

PreloadResultants resultants(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                             const Eigen::VectorXd& weights, const Eigen::VectorXd& pressure) {
  require_size("p", p, weights);
  require_size("r", r, weights);
  require_size("the field", pressure, weights);
  const Eigen::VectorXd force = weights.cwiseProduct(pressure);
  return {force.sum(), -r.dot(force), p.dot(force)};
}

double carried_force(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights) {
  require_size("the field", pressure, weights);
  return weights.dot(pressure.cwiseMax(0.0));
}

Eigen::VectorXd scaled_preload(const Eigen::VectorXd& shape, const Eigen::VectorXd& weights,
                               double force) {
  const double carried = carried_force(shape, weights);
  const double integral = weights.dot(shape);
  const double size = weights.dot(shape.cwiseAbs());
  const double rounding = 1e-14 * std::sqrt(static_cast<double>(shape.size())) * size;
  if (!(force >= 0.0))
    refuse("preload field: a field is scaled to a force of at least 0, not ", force, " N");
  if (!(integral > rounding)) {
    refuse("preload field integrates to ", integral, " over the patch (its size to ", size,
           "): expected a field whose integral is above 0, positive where the contact presses and "
           "negative where "
           "there is a gap; scaling this one would turn gaps into pressure");
  }
  return shape * (force / carried);
}

void require_total(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights, double force,
                   double relative_tolerance) {
  const double carried = carried_force(pressure, weights);
  if (!(std::abs(carried - force) <= relative_tolerance * std::max(carried, std::abs(force)))) {
    refuse("preload field carries ", carried, " N over the patch, but ", force, " N are requested");
  }
}

Eigen::VectorXd preload_of_gap(const Eigen::VectorXd& gap,
                               const Eigen::VectorXd& normal_stiffness) {
  require_size("the gap", gap, normal_stiffness);
  return -gap.cwiseProduct(normal_stiffness);
}

}  // namespace microslip::contact
