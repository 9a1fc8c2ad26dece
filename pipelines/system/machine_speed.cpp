#include "pipelines/system/machine_speed.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <Eigen/Core>

namespace microslip::pipelines {
namespace {

/// Of this thread.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Eigen::MatrixXd matrix_of(Eigen::Index n) {
  const auto entry = [](Eigen::Index i, Eigen::Index j) {
    return 1.0 / static_cast<double>(1 + std::abs(i - j));
  };
  return Eigen::MatrixXd::NullaryExpr(n, n, entry);
}

/// A slider under a motion of two harmonics: stick or slip, instant by instant.
double slide(int n_instants) {
  constexpr double limit = 0.4;
  double slider = 0.0;
  double work = 0.0;
  for (int i = 0; i < n_instants; ++i) {
    const double theta = 0.01 * i;
    const double u = std::sin(theta) + 0.3 * std::cos(3.0 * theta);
    const double force = u - slider;
    if (std::abs(force) <= limit) continue;
    const double slipped = force - std::copysign(limit, force);
    work += limit * std::abs(slipped);
    slider += slipped;
  }
  return work;
}

double seconds_of_work() {
  constexpr int repeats = 8;
  constexpr int n_instants = 20'000;
  const Eigen::MatrixXd A = matrix_of(150);
  Eigen::MatrixXd product(A.rows(), A.cols());
  volatile double kept = 0.0;  // so that the work is done
  double begin = 0.0;
  for (int i = -1; i < repeats; ++i) {
    if (i == 0) begin = processor_seconds();  // the first one warms the caches
    product.noalias() = A * A;                // not by BLAS, whose threads would be measured
    kept = kept + product(0, 0) + slide(n_instants);
  }
  return (processor_seconds() - begin) / repeats;
}

}  // namespace

double machine_slowness() {
  constexpr double where_fitted = 0.85e-3;  // [s]
  static const double slowness = std::max(seconds_of_work() / where_fitted, 0.1);
  return slowness;
}

}  // namespace microslip::pipelines
