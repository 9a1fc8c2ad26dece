#include "contact/numerics/chebyshev_surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

namespace microslip::contact {
namespace {

// T_0 … T_degree at x.
Eigen::RowVectorXd basis(int degree, double x) {
  Eigen::RowVectorXd T(degree + 1);
  T[0] = 1.0;
  if (degree > 0) {
    T[1] = x;
  }
  for (int k = 2; k <= degree; ++k) {
    T[k] = 2.0 * x * T[k - 1] - T[k - 2];
  }
  return T;
}

// Tables of one degree, made once.
struct Tables {
  explicit Tables(int degree) : points(degree + 1), transform(degree + 1, degree + 1) {
    assert(degree > 0);
    const double step = std::numbers::pi / degree;
    for (int k = 0; k <= degree; ++k) {
      points[k] = std::sin(0.5 * step * (degree - 2 * k));  // cos(πk/N), odd in exact arithmetic
    }
    for (int i = 0; i <= degree; ++i) {
      for (int k = 0; k <= degree; ++k) {
        const double ends =
            (k == 0 || k == degree ? 0.5 : 1.0) * (i == 0 || i == degree ? 0.5 : 1.0);
        transform(i, k) = 2.0 / degree * ends * std::cos(step * ((i * k) % (2 * degree)));
      }
    }
    for (int half = 0; half < 2; ++half) {
      Eigen::MatrixXd values(degree + 1, degree + 1);
      for (int k = 0; k <= degree; ++k) {
        values.row(k) = basis(degree, 0.5 * (points[k] + (half == 0 ? -1.0 : 1.0)));
      }
      halves[static_cast<std::size_t>(half)] = transform * values;
    }
  }

  Eigen::VectorXd points;
  Eigen::MatrixXd transform;
  std::array<Eigen::MatrixXd, 2> halves;  // coefficients on [−1, 0] and [0, 1]
};

const Tables& tables(int degree) {
  static std::mutex mutex;
  static std::map<int, Tables> known;  // references into a map stay valid
  const std::lock_guard lock(mutex);
  return known.try_emplace(degree, degree).first->second;
}

Eigen::VectorXd trimmed(const Eigen::VectorXd& c, double noise) {
  const double size = c.cwiseAbs().sum();
  Eigen::Index n = c.size();
  while (n > 1 && std::abs(c[n - 1]) <= noise * size) {
    --n;
  }
  return c.head(n);
}

// The zero in [a, b] of a function that is monotone there and changes sign: Newton, kept inside by
// bisection.
double bracketed(const Eigen::VectorXd& c, const Eigen::VectorXd& slope, double a, double b,
                 double at_a) {
  double x = 0.5 * (a + b);
  for (int step = 0; step < 100 && b - a > 4e-16; ++step) {
    const double value = chebyshev_value(c, x);
    if (value == 0.0) {
      return x;
    }
    ((value > 0.0) == (at_a > 0.0) ? a : b) = x;
    const double newton = x - value / chebyshev_value(slope, x);
    const bool inside = newton > a && newton < b;
    const double next = inside ? newton : 0.5 * (a + b);
    if (inside && std::abs(next - x) <= 2e-16) {
      return next;
    }
    x = next;
  }
  return x;
}

// c without trailing zeros.
std::vector<double> roots_of(const Eigen::VectorXd& c) {
  std::vector<double> roots;
  if (c.size() < 2 || std::abs(c[0]) > c.tail(c.size() - 1).cwiseAbs().sum()) {
    return roots;
  }
  const Eigen::VectorXd slope = chebyshev_derivative(c);
  std::vector<double> stops = roots_of(slope);
  stops.push_back(1.0);
  double a = -1.0;
  double at_a = chebyshev_value(c, a);
  if (at_a == 0.0) {
    roots.push_back(a);
  }
  for (const double b : stops) {
    const double at_b = chebyshev_value(c, b);
    if (at_b == 0.0) {
      roots.push_back(b);
    } else if (at_a != 0.0 && (at_a > 0.0) != (at_b > 0.0)) {
      roots.push_back(bracketed(c, slope, a, b, at_a));
    }
    a = b;
    at_a = at_b;
  }
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

}  // namespace

const Eigen::VectorXd& chebyshev_points(int degree) { return tables(degree).points; }
const Eigen::MatrixXd& chebyshev_transform(int degree) { return tables(degree).transform; }

Eigen::VectorXd chebyshev_derivative(const Eigen::VectorXd& c) {
  const Eigen::Index n = c.size() - 1;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(std::max<Eigen::Index>(n, 1));
  for (Eigen::Index k = n; k >= 1; --k) {
    d[k - 1] = 2.0 * static_cast<double>(k) * c[k] + (k + 1 < n ? d[k + 1] : 0.0);
  }
  d[0] *= 0.5;
  return d;
}

double chebyshev_value(const Eigen::VectorXd& c, double x) {
  double later = 0.0;
  double last = 0.0;
  for (Eigen::Index k = c.size() - 1; k >= 1; --k) {
    const double next = c[k] + 2.0 * x * last - later;
    later = last;
    last = next;
  }
  return c[0] + x * last - later;
}

std::vector<double> chebyshev_roots(const Eigen::VectorXd& coefficients, double noise) {
  return roots_of(trimmed(coefficients, noise));
}

ChebyshevSurface ChebyshevSurface::through(const Eigen::MatrixXd& values) {
  const Eigen::MatrixXd& D = chebyshev_transform(static_cast<int>(values.rows()) - 1);
  return ChebyshevSurface(D * values * D.transpose());
}

double ChebyshevSurface::value(double x, double y) const {
  return basis(degree(), x) * c_ * basis(degree(), y).transpose();
}

Eigen::VectorXd ChebyshevSurface::column(double x) const {
  return (basis(degree(), x) * c_).transpose();
}

ChebyshevSurface ChebyshevSurface::derivative_x() const {
  return transposed().derivative_y().transposed();
}

ChebyshevSurface ChebyshevSurface::derivative_y() const {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(c_.rows(), c_.cols());
  for (Eigen::Index i = 0; i < c_.rows(); ++i) {
    d.row(i).head(std::max<Eigen::Index>(c_.cols() - 1, 1)) =
        chebyshev_derivative(c_.row(i).transpose()).transpose();
  }
  return ChebyshevSurface(std::move(d));
}

std::array<ChebyshevSurface, 4> ChebyshevSurface::quarters() const {
  const auto& half = tables(degree()).halves;
  const Eigen::MatrixXd low = half[0] * c_;
  const Eigen::MatrixXd high = half[1] * c_;
  return {ChebyshevSurface(low * half[0].transpose()), ChebyshevSurface(high * half[0].transpose()),
          ChebyshevSurface(low * half[1].transpose()),
          ChebyshevSurface(high * half[1].transpose())};
}

ChebyshevSurface ChebyshevSurface::trimmed(double noise) const {
  Eigen::Index n = c_.rows();
  while (n > 3 && c_.row(n - 1).head(n).cwiseAbs().maxCoeff() <= noise &&
         c_.col(n - 1).head(n).cwiseAbs().maxCoeff() <= noise) {
    --n;
  }
  return ChebyshevSurface(c_.topLeftCorner(n, n));
}

ChebyshevSurface ChebyshevSurface::raised_to(int degree) const {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  c.topLeftCorner(c_.rows(), c_.cols()) = c_;
  return ChebyshevSurface(std::move(c));
}

double ChebyshevSurface::variation() const { return c_.cwiseAbs().sum() - std::abs(c_(0, 0)); }

double ChebyshevSurface::tail() const {
  const Eigen::Index n = std::max<Eigen::Index>(c_.rows() - 2, 1);
  return c_.cwiseAbs().sum() - c_.topLeftCorner(n, n).cwiseAbs().sum();
}

}  // namespace microslip::contact
