#include "contact/patch/contact_patch.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace microslip::contact {
namespace {

[[noreturn]] void refuse(const char* quantity, std::size_t point, double value,
                         const char* allowed) {
  std::ostringstream message;
  message.precision(17);
  message << "contact point " << point + 1 << ": " << quantity << " = " << value << ", must be "
          << allowed;
  throw std::invalid_argument(message.str());
}

void require_not_negative(const char* quantity, std::size_t point, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) {
    refuse(quantity, point, value, "finite and at least 0");
  }
}

void require_valid(const PointParameters& p, double weight, std::size_t i) {
  require_not_negative("weight", i, weight);
  require_not_negative("tangential_stiffness", i, p.tangential_stiffness);
  require_not_negative("normal_stiffness", i, p.normal_stiffness);
  require_not_negative("friction_coefficient", i, p.friction_coefficient);
  if (!std::isfinite(p.rest_load)) {
    refuse("preload", i, p.rest_load, "finite");
  }
}

}  // namespace

ContactPatch::ContactPatch(Eigen::VectorXd weights, std::vector<PointParameters> points)
    : weights_(std::move(weights)), points_(std::move(points)) {
  if (weights_.size() < 1 || weights_.size() != static_cast<Eigen::Index>(points_.size())) {
    throw std::invalid_argument("ContactPatch: " + std::to_string(weights_.size()) +
                                " weights and " + std::to_string(points_.size()) +
                                " points; as many of both, at least 1");
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    require_valid(points_[i], weights_[static_cast<Eigen::Index>(i)], i);
  }
}

}  // namespace microslip::contact
