#include "contact/patch/modal_contact_field.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace microslip::contact {
namespace {

using Eigen::Index;

void require(bool condition, const std::string& message) {
  if (!condition) {
    throw std::invalid_argument("ModalContactField: " + message);
  }
}

void require_shape(const Eigen::MatrixXd& shape, Index rows, Index columns, const char* name) {
  require(shape.rows() == rows && shape.cols() == columns,
          std::string("mode shapes ") + name + " are " + std::to_string(shape.rows()) + " x " +
              std::to_string(shape.cols()) + ", expected " + std::to_string(rows) + " x " +
              std::to_string(columns));
  require(shape.allFinite(), std::string("mode shapes ") + name + " are not all finite");
}

void require_samples(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                     const Eigen::VectorXd& weights, const ModalShapes& shapes,
                     std::optional<int> degree) {
  const Index n = p.size();
  require(n >= 1, "no samples");
  require(r.size() == n && weights.size() == n,
          std::to_string(n) + " p, " + std::to_string(r.size()) + " r and " +
              std::to_string(weights.size()) + " weights; as many of each");
  require(p.allFinite() && r.allFinite() && weights.allFinite(), "samples are not all finite");
  require(weights.minCoeff() >= 0.0 && weights.maxCoeff() > 0.0,
          "weights must be at least 0 and not all 0, smallest is " +
              std::to_string(weights.minCoeff()));
  require_shape(shapes.u, n, shapes.u.cols(), "u");
  require_shape(shapes.v, n, shapes.u.cols(), "v");
  if (shapes.w.size() > 0) {
    require_shape(shapes.w, n, shapes.u.cols(), "w");
  }
  require(!degree || (*degree >= 0 && *degree <= ModalContactField::max_degree),
          "degree = " + std::to_string(degree.value_or(0)) + ", must be 0 to " +
              std::to_string(ModalContactField::max_degree));
}

Eigen::MatrixXd side_by_side(const ModalShapes& shapes) {
  Eigen::MatrixXd all(shapes.u.rows(), shapes.u.cols() + shapes.v.cols() + shapes.w.cols());
  all.leftCols(shapes.u.cols()) = shapes.u;
  all.middleCols(shapes.u.cols(), shapes.v.cols()) = shapes.v;
  if (shapes.w.size() > 0) {
    all.rightCols(shapes.w.cols()) = shapes.w;
  }
  return all;
}

// Orthonormal columns one after the other, so that each degree extends the one before it.
struct Orthogonal {
  Eigen::MatrixXd Q;        // samples × rank
  Eigen::MatrixXd R;        // rank × rank, upper triangular, of the terms kept
  std::vector<Index> term;  // which term each column is
};

// Polynomials orthonormal over the samples reach three times their mean size in corners of a patch
// (degree 4 in a square), and less in the mean over it.
constexpr double most_growth = 3.0;

// Gram–Schmidt, twice for orthogonality to rounding. A term whose new part is below 1e-8 of itself
// is one the samples cannot tell from the terms before it: half the digits, between the 1e-16 of a
// true dependence and the 1e-5 that remains of degree 12 on a poor set of samples. So is one that
// is small at the samples and large between them: nodes of a strip of one element, which a slip
// direction crosses askew, make of rounding a term that passes for a new one.
//   V             samples × terms, each sample times the root of its weight
//   between       places between the samples × terms, not weighted
//   total_weight  of the samples
Orthogonal orthogonalise(const Eigen::MatrixXd& V, const Eigen::MatrixXd& between,
                         double total_weight) {
  const Index most = std::min(V.rows(), V.cols());
  Orthogonal result{Eigen::MatrixXd(V.rows(), most), Eigen::MatrixXd::Zero(most, most), {}};
  Eigen::MatrixXd elsewhere(between.rows(), most);
  const double usual = std::sqrt(static_cast<double>(between.rows()) / total_weight);
  for (Index term = 0; term < V.cols(); ++term) {
    const auto rank = static_cast<Index>(result.term.size());
    if (rank == most) {
      break;
    }
    Eigen::VectorXd column = V.col(term);
    Eigen::VectorXd along = Eigen::VectorXd::Zero(rank);
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd part = result.Q.leftCols(rank).transpose() * column;
      column -= result.Q.leftCols(rank) * part;
      along += part;
    }
    const double rest = column.norm();
    if (rest <= 1e-8 * V.col(term).norm()) {
      continue;
    }
    elsewhere.col(rank) = (between.col(term) - elsewhere.leftCols(rank) * along) / rest;
    if (elsewhere.col(rank).norm() > most_growth * usual) {
      continue;
    }
    result.Q.col(rank) = column / rest;
    result.R.col(rank).head(rank) = along;
    result.R(rank, rank) = rest;
    result.term.push_back(term);
  }
  return result;
}

// Columns whose terms have at most this degree.
Index rank_of_degree(const Orthogonal& fit, int degree) {
  return std::lower_bound(fit.term.begin(), fit.term.end(), PolynomialBasis::n_terms(degree)) -
         fit.term.begin();
}

// Squared leave-one-out errors, weighted, summed over the samples: one number per column of values.
struct LeaveOneOut {
  Eigen::RowVectorXd squares;
  bool every_sample_spare = true;  // no sample is needed to determine the fit
};

LeaveOneOut leave_one_out(const Orthogonal& fit, Index rank, const Eigen::MatrixXd& values) {
  const auto Q = fit.Q.leftCols(rank);
  Eigen::MatrixXd errors = values - Q * (Q.transpose() * values);
  LeaveOneOut result;
  for (Index i = 0; i < errors.rows(); ++i) {
    const double spare = 1.0 - Q.row(i).squaredNorm();
    if (spare > 1e-8) {  // rounding of a sum of squares that is 1, with a margin
      errors.row(i) /= spare;
    } else {
      result.every_sample_spare = false;
    }
  }
  result.squares = errors.colwise().squaredNorm();
  return result;
}

// Smallest degree within 5 % of the least error; below 1e-13 of the values all errors are rounding.
int best_degree(const Orthogonal& fit, const Eigen::MatrixXd& values, int highest) {
  std::vector<double> error;
  for (int degree = 0; degree <= highest; ++degree) {
    const LeaveOneOut trial = leave_one_out(fit, rank_of_degree(fit, degree), values);
    if (!trial.every_sample_spare) {
      break;
    }
    error.push_back(std::sqrt(trial.squares.sum()));
  }
  if (error.empty()) {
    return 0;
  }
  const double enough =
      1.05 * *std::min_element(error.begin(), error.end()) + 1e-13 * values.norm();
  return static_cast<int>(
      std::find_if(error.begin(), error.end(), [&](double e) { return e <= enough; }) -
      error.begin());
}

// Largest degree up to `asked` that still adds a term.
int carried_degree(const Orthogonal& fit, int asked) {
  int degree = asked;
  while (degree > 0 && rank_of_degree(fit, degree) == rank_of_degree(fit, degree - 1)) {
    --degree;
  }
  return degree;
}

Eigen::VectorXd relative_error(const Eigen::RowVectorXd& squares, const Eigen::MatrixXd& values,
                               Index n_modes) {
  Eigen::VectorXd error = Eigen::VectorXd::Zero(n_modes);
  Eigen::VectorXd size = Eigen::VectorXd::Zero(n_modes);
  for (Index column = 0; column < values.cols(); ++column) {
    error[column % n_modes] += squares[column];
    size[column % n_modes] += values.col(column).squaredNorm();
  }
  return (size.array() > 0.0).select((error.array() / size.array()).sqrt(), 0.0);
}

}  // namespace

ModalContactField::ModalContactField(const Eigen::VectorXd& p, const Eigen::VectorXd& r,
                                     const Eigen::VectorXd& weights, const ModalShapes& shapes,
                                     std::optional<int> degree, const Eigen::MatrixX2d& between)
    : has_w_(shapes.w.size() > 0) {
  require_samples(p, r, weights, shapes, degree);
  const Index n_modes = shapes.u.cols();
  const int highest = degree.value_or(max_degree);
  const Eigen::VectorXd root = (weights / weights.maxCoeff()).cwiseSqrt();
  const Eigen::MatrixXd values = root.asDiagonal() * side_by_side(shapes);
  const PolynomialBasis trial(p, r, highest);
  const Orthogonal fit =
      orthogonalise(root.asDiagonal() * trial.at(p, r), trial.at(between.col(0), between.col(1)),
                    root.squaredNorm());

  degree_ = carried_degree(fit, degree ? highest : best_degree(fit, values, highest));
  const Index rank = rank_of_degree(fit, degree_);
  fit_error_ = relative_error(leave_one_out(fit, rank, values).squares, values, n_modes);
  basis_ = PolynomialBasis(p, r, degree_);
  const Eigen::MatrixXd kept = fit.R.topLeftCorner(rank, rank)
                                   .triangularView<Eigen::Upper>()
                                   .solve(fit.Q.leftCols(rank).transpose() * values);
  coefficients_ = Eigen::MatrixXd::Zero(PolynomialBasis::n_terms(degree_), values.cols());
  for (Index k = 0; k < rank; ++k) {
    coefficients_.row(fit.term[static_cast<std::size_t>(k)]) = kept.row(k);
  }
}

ModalShapes ModalContactField::at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  require(p.size() == r.size(),
          std::to_string(p.size()) + " p and " + std::to_string(r.size()) + " r; as many of both");
  const Eigen::MatrixXd values = basis_.at(p, r) * coefficients_;
  const Index n = fit_error_.size();
  ModalShapes shapes{values.leftCols(n), values.middleCols(n, n), {}};
  if (has_w_) {
    shapes.w = values.rightCols(n);
  }
  return shapes;
}

}  // namespace microslip::contact
