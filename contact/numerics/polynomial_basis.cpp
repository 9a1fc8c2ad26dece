#include "contact/numerics/polynomial_basis.hpp"

namespace microslip::contact {
namespace {

// Half the extent; 1 where there is none, so that every scaled coordinate is 0 there.
double half_extent(const Eigen::VectorXd& x) {
  const double half = 0.5 * (x.maxCoeff() - x.minCoeff());
  return half > 0.0 ? half : 1.0;
}

// n × (degree + 1), by the three-term recurrence.
Eigen::ArrayXXd legendre(const Eigen::ArrayXd& x, int degree) {
  Eigen::ArrayXXd P(x.size(), degree + 1);
  P.col(0).setOnes();
  if (degree > 0) {
    P.col(1) = x;
  }
  for (int k = 2; k <= degree; ++k) {
    P.col(k) = ((2.0 * k - 1.0) * x * P.col(k - 1) - (k - 1.0) * P.col(k - 2)) / k;
  }
  return P;
}

}  // namespace

PolynomialBasis::PolynomialBasis(const Eigen::VectorXd& p, const Eigen::VectorXd& r, int degree)
    : degree_(degree),
      p_mid_(0.5 * (p.maxCoeff() + p.minCoeff())),
      p_half_(half_extent(p)),
      r_mid_(0.5 * (r.maxCoeff() + r.minCoeff())),
      r_half_(half_extent(r)) {}

Eigen::MatrixXd PolynomialBasis::at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  const Eigen::ArrayXXd X = legendre((p.array() - p_mid_) / p_half_, degree_);
  const Eigen::ArrayXXd Y = legendre((r.array() - r_mid_) / r_half_, degree_);
  Eigen::MatrixXd V(p.size(), n_terms(degree_));
  Eigen::Index term = 0;
  for (int d = 0; d <= degree_; ++d) {
    for (int j = 0; j <= d; ++j) {
      V.col(term++) = X.col(d - j) * Y.col(j);
    }
  }
  return V;
}

}  // namespace microslip::contact
