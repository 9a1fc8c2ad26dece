#include "contact/modal_force.hpp"

#include <stdexcept>
#include <utility>

namespace microslip::contact {

Eigen::MatrixXd FewerDerivatives::expanded() const {
  const Eigen::Index r = of_modes.rows();
  const Eigen::Index n = of_modes.cols();
  const Eigen::Index rows = jacobian.rows() / r;
  Eigen::MatrixXd wide(jacobian.rows(), rows * n);
  for (Eigen::Index l = 0; l < rows; ++l) {
    wide.middleCols(l * n, n).noalias() = jacobian.middleCols(l * r, r) * of_modes;
  }
  Eigen::MatrixXd result(rows * n, rows * n);
  for (Eigen::Index k = 0; k < rows; ++k) {
    result.middleRows(k * n, n).noalias() = of_modes.transpose() * wide.middleRows(k * r, r);
  }
  return result;
}

ForceAndJacobian ModalForce::evaluate(const Harmonics& q, double frequency, const Asked& asked,
                                      Workspace& work) const {
  if (asked.n_harmonics > q.n_harmonics() && !asked.rows.empty()) {
    throw std::invalid_argument(
        "contact force: derivatives with more harmonics than the motion has");
  }
  return evaluated(q, frequency, asked, work);
}

ForceAndJacobian restricted(ForceAndJacobian all, const std::vector<Eigen::Index>& rows) {
  const Eigen::Index n = all.force.n_signals();
  const auto n_rows = static_cast<Eigen::Index>(rows.size());
  if (n_rows == all.force.rows().rows()) return all;
  ForceAndJacobian some{std::move(all.force), Eigen::MatrixXd(n_rows * n, n_rows * n),
                        Eigen::VectorXd(n_rows * n), all.defect};
  for (Eigen::Index i = 0; i < n_rows; ++i) {
    const Eigen::Index row = rows[static_cast<std::size_t>(i)] * n;
    some.frequency_derivative.segment(i * n, n) = all.frequency_derivative.segment(row, n);
    for (Eigen::Index j = 0; j < n_rows; ++j) {
      const Eigen::Index column = rows[static_cast<std::size_t>(j)] * n;
      some.jacobian.block(i * n, j * n, n, n) = all.jacobian.block(row, column, n, n);
    }
  }
  return some;
}

}  // namespace microslip::contact
