#include "contact/patch/preload_field.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

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

}  // namespace

Eigen::VectorXd uniform_rest_load(const Eigen::VectorXd& weights, double force) {
  return Eigen::VectorXd::Constant(weights.size(), force / area_of(weights));
}

double carried_force(const Eigen::VectorXd& pressure, const Eigen::VectorXd& weights) {
  require_size("the field", pressure, weights);
  return weights.dot(pressure.cwiseMax(0.0));
}

Eigen::VectorXd scaled_rest_load(const Eigen::VectorXd& shape, const Eigen::VectorXd& weights,
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

}  // namespace microslip::contact
