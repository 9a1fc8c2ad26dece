#include "contact/numerics/delaunay.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace microslip::contact {
namespace {

__extension__ using Quad = __float128;

// Sixteen digits decide unless the determinant is this small (coordinates are of order 1).
constexpr double sure = 1e-12;
// What is left of a determinant in quadruple precision when it is 0 in truth.
constexpr double zero = 1e-30;

// The hull has a triangle outside each edge, with this as third corner.
constexpr int outside = -1;

using Triangle = std::array<int, 3>;
using Edge = std::array<int, 2>;

class Builder {
 public:
  explicit Builder(const Eigen::MatrixX2d& points) : x_(points) {
    const Eigen::RowVector2d low = points.colwise().minCoeff();
    const Eigen::RowVector2d high = points.colwise().maxCoeff();
    const double extent = (high - low).maxCoeff();
    // A power of two: scaling must not round, points on a line stay there.
    const double scale = extent > 0.0 ? std::exp2(-std::ceil(std::log2(extent))) : 1.0;
    x_ = (points.rowwise() - low) * scale;
  }

  [[nodiscard]] Triangulation build() {
    if (!start()) {
      return {};
    }
    for (int point = 0; point < static_cast<int>(x_.rows()); ++point) {
      if (std::ranges::find(first_, point) == first_.end()) {
        insert(point);
      }
    }
    Triangulation result;
    for (const Triangle& t : triangles_) {
      if (t[2] == outside) {
        result.hull.push_back({t[1], t[0]});
      } else {
        result.triangles.push_back(t);
      }
    }
    return result;
  }

 private:
  template <typename Real>
  [[nodiscard]] Real area(int a, int b, int c) const {
    const Real px = Real(x_(b, 0)) - Real(x_(a, 0));
    const Real py = Real(x_(b, 1)) - Real(x_(a, 1));
    const Real qx = Real(x_(c, 0)) - Real(x_(a, 0));
    const Real qy = Real(x_(c, 1)) - Real(x_(a, 1));
    return px * qy - py * qx;
  }

  // 1: c left of a → b, −1: right, 0: on the line.
  [[nodiscard]] int side(int a, int b, int c) const {
    return decided([&] { return area<double>(a, b, c); },
                   [&] { return static_cast<double>(area<Quad>(a, b, c)); });
  }

  template <typename Real>
  [[nodiscard]] Real in_circle(const Triangle& t, int point) const {
    std::array<Real, 3> x;
    std::array<Real, 3> y;
    std::array<Real, 3> square;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = Real(x_(t[i], 0)) - Real(x_(point, 0));
      y[i] = Real(x_(t[i], 1)) - Real(x_(point, 1));
      square[i] = x[i] * x[i] + y[i] * y[i];
    }
    return square[0] * (x[1] * y[2] - x[2] * y[1]) - square[1] * (x[0] * y[2] - x[2] * y[0]) +
           square[2] * (x[0] * y[1] - x[1] * y[0]);
  }

  template <typename Fast, typename Exact>
  static int decided(const Fast& fast, const Exact& exact) {
    double value = fast();
    if (std::abs(value) < sure) {
      value = exact();
    }
    return value > zero ? 1 : (value < -zero ? -1 : 0);
  }

  [[nodiscard]] bool is_between(int a, int b, int c) const {
    const Eigen::RowVector2d ab = x_.row(b) - x_.row(a);
    const double t = (x_.row(c) - x_.row(a)).dot(ab);
    return t > 0.0 && t < ab.squaredNorm();
  }

  // Whether the circle of the triangle, or the half plane of an outer one, holds the point.
  [[nodiscard]] bool is_hit(const Triangle& t, int point) const {
    if (t[2] == outside) {
      const int where = side(t[0], t[1], point);
      return where > 0 || (where == 0 && is_between(t[0], t[1], point));
    }
    return decided([&] { return in_circle<double>(t, point); },
                   [&] { return static_cast<double>(in_circle<Quad>(t, point)); }) > 0;
  }

  [[nodiscard]] bool start() {
    const int n = static_cast<int>(x_.rows());
    for (int c = 2; c < n; ++c) {
      const int where = side(0, 1, c);
      if (where != 0) {
        first_ = where > 0 ? Triangle{0, 1, c} : Triangle{1, 0, c};
        triangles_ = {first_};
        for (std::size_t i = 0; i < 3; ++i) {
          triangles_.push_back({first_[(i + 1) % 3], first_[i], outside});
        }
        return true;
      }
    }
    return false;
  }

  void insert(int point) {
    const auto keep = std::partition(triangles_.begin(), triangles_.end(),
                                     [&](const Triangle& t) { return !is_hit(t, point); });
    std::set<Edge> border;
    for (auto t = keep; t != triangles_.end(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge edge{(*t)[i], (*t)[(i + 1) % 3]};
        if (border.erase({edge[1], edge[0]}) == 0) {
          border.insert(edge);
        }
      }
    }
    triangles_.erase(keep, triangles_.end());
    for (const Edge& edge : border) {
      triangles_.push_back(edge[0] == outside   ? Triangle{edge[1], point, outside}
                           : edge[1] == outside ? Triangle{point, edge[0], outside}
                                                : Triangle{edge[0], edge[1], point});
    }
  }

  Eigen::MatrixX2d x_;
  Triangle first_{};
  std::vector<Triangle> triangles_;
};

}  // namespace

Triangulation delaunay(const Eigen::MatrixX2d& points) { return Builder(points).build(); }

}  // namespace microslip::contact
