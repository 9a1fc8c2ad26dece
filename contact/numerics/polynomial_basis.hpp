/// @file
/// Polynomials of bounded total degree over a patch: products of Legendre polynomials of the patch
/// coordinates, each scaled to [−1, 1] over the samples, ordered by total degree,
///
///   P_i(x) P_j(y),  i + j ≤ degree,     x = (p − p_mid)/p_half,  y = (r − r_mid)/r_half
///
/// so that the first (d+1)(d+2)/2 terms span all polynomials of degree d.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

class PolynomialBasis {
 public:
  PolynomialBasis() = default;
  /// @param p, r  samples that set the scales [m], n ≥ 1; a direction without extent is allowed.
  PolynomialBasis(const Eigen::VectorXd& p, const Eigen::VectorXd& r, int degree);

  [[nodiscard]] static Eigen::Index n_terms(int degree) {
    return static_cast<Eigen::Index>(degree + 1) * (degree + 2) / 2;
  }
  /// n × n_terms(degree).
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;

 private:
  int degree_ = 0;
  double p_mid_ = 0.0;
  double p_half_ = 1.0;
  double r_mid_ = 0.0;
  double r_half_ = 1.0;
};

}  // namespace microslip::contact
