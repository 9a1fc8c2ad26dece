/// @file
/// A method that does not say where it is linear: its point is always evaluated.
#pragma once

#include <memory>
#include <utility>

#include "contact/point/point_method.hpp"

namespace microslip::tests {

class SleeplessMethod final : public contact::PointMethod {
 public:
  explicit SleeplessMethod(std::shared_ptr<const PointMethod> method)
      : method_(std::move(method)) {}

  void traction(const contact::Harmonics& motion, double frequency,
                contact::PointTraction& result) const override {
    method_->traction(motion, frequency, result);
  }
  [[nodiscard]] contact::PointHistory history(const contact::Harmonics& motion, double frequency,
                                              const Eigen::VectorXd& phases, int n) const override {
    return method_->history(motion, frequency, phases, n);
  }
  [[nodiscard]] Eigen::Vector3d stuck_stiffness() const override {
    return method_->stuck_stiffness();
  }
  [[nodiscard]] double reference_load() const override { return method_->reference_load(); }

 private:
  std::shared_ptr<const PointMethod> method_;
};

}  // namespace microslip::tests
