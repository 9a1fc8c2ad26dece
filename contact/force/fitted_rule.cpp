#include "contact/force/fitted_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/numerics/chebyshev_surface.hpp"
#include "contact/numerics/gauss_legendre.hpp"
#include "contact/force/height_rule.hpp"

namespace microslip::contact {
namespace {

constexpr std::array degrees = {4, 8, 16, 32};

// A part of a cell: [ξ] × [η] = centre ± half.
struct Box {
  std::size_t cell = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double half = 1.0;
  int depth = 0;
};

// A box with its guards as far as they are known.
struct Sampled {
  Box box;
  std::vector<ChebyshevSurface> surfaces;
  std::vector<int> crossing;
  bool is_resolved = false;
};

void require_valid(const FittedRuleOptions& options) {
  if (options.order < 1) {
    throw std::invalid_argument("fitted_rule: order " + std::to_string(options.order) +
                                ", must be at least 1");
  }
  if (!(options.line_tolerance > 0.0)) {
    throw std::invalid_argument("fitted_rule: line_tolerance " +
                                std::to_string(options.line_tolerance) + ", must be above 0");
  }
  if (options.max_depth < 0) {
    throw std::invalid_argument("fitted_rule: max_depth " + std::to_string(options.max_depth) +
                                ", must be at least 0");
  }
}

class FittedRule {
 public:
  FittedRule(const PatchCells& cells, const Guards& guards, const FittedRuleOptions& options)
      : cells_(patch_cells(cells)),
        guards_(guards),
        options_(options),
        line_rule_(gauss_legendre(options.order)) {}

  [[nodiscard]] PatchRule rule() {
    std::vector<Box> boxes(cells_.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].cell = i;
    }
    while (!boxes.empty()) {
      boxes = add_or_split(std::move(boxes));
    }
    const auto n = static_cast<Eigen::Index>(weights_.size());
    return {Eigen::Map<const Eigen::VectorXd>(p_.data(), n),
            Eigen::Map<const Eigen::VectorXd>(r_.data(), n),
            Eigen::Map<const Eigen::VectorXd>(weights_.data(), n), 0};
  }

 private:
  // One generation: boxes climb the ladder of degrees together, so that guards are called rarely
  // and with many points. Returns the quarters of those that stayed unresolved.
  std::vector<Box> add_or_split(std::vector<Box> boxes) {
    std::vector<Box> quarters;
    for (const int degree : degrees) {
      std::vector<Box> unresolved;
      for (Sampled& sampled : sample(boxes, degree)) {
        const bool is_last = degree == degrees.back();
        if (sampled.is_resolved || (is_last && sampled.box.depth >= options_.max_depth)) {
          add(sampled);
        } else if (is_last) {
          split(sampled.box, quarters);
        } else {
          unresolved.push_back(sampled.box);
        }
      }
      boxes = std::move(unresolved);
    }
    return quarters;
  }

  static void split(const Box& box, std::vector<Box>& quarters) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        quarters.push_back({box.cell, box.centre + box.half * Eigen::Vector2d(x, y), 0.5 * box.half,
                            box.depth + 1});
      }
    }
  }

  [[nodiscard]] std::vector<Sampled> sample(const std::vector<Box>& boxes, int degree) const {
    const Eigen::VectorXd& nodes = chebyshev_points(degree);
    const Eigen::Index n = nodes.size();
    Eigen::VectorXd p(n * n * static_cast<Eigen::Index>(boxes.size()));
    Eigen::VectorXd r(p.size());
    Eigen::Index point = 0;
    for (const Box& box : boxes) {
      for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < n; ++i, ++point) {
          const Eigen::Vector2d at = box.centre + box.half * Eigen::Vector2d(nodes[i], nodes[j]);
          const Eigen::Vector2d x = cells_[box.cell].at(at[0], at[1]);
          p[point] = x[0];
          r[point] = x[1];
        }
      }
    }
    const Eigen::MatrixXd values = guard_values(p, r);
    std::vector<Sampled> result;
    result.reserve(boxes.size());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      result.push_back(
          classified(boxes[k], values.middleRows(static_cast<Eigen::Index>(k) * n * n, n * n)));
    }
    return result;
  }

  [[nodiscard]] Eigen::MatrixXd guard_values(const Eigen::VectorXd& p,
                                             const Eigen::VectorXd& r) const {
    const auto n_guards = static_cast<Eigen::Index>(guards_.lines.size());
    if (p.size() == 0 || n_guards == 0) {
      return {p.size(), n_guards};
    }
    Eigen::MatrixXd values = guards_.values(p, r);
    if (values.rows() != p.size() || values.cols() != n_guards) {
      throw std::invalid_argument("fitted_rule: guards gave " + std::to_string(values.rows()) +
                                  " x " + std::to_string(values.cols()) + " values, expected " +
                                  std::to_string(p.size()) + " x " + std::to_string(n_guards));
    }
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      if (!values.row(i).allFinite()) {
        std::ostringstream message;
        message << "fitted_rule: a guard is not finite at p = " << p[i] << " m, r = " << r[i]
                << " m";
        throw std::invalid_argument(message.str());
      }
    }
    return values;
  }

  // Which guards may vanish in the box, and whether those are resolved. With the tail as an
  // estimate of all that a surface leaves out, four times it is a margin for guards that decay
  // slowly.
  [[nodiscard]] Sampled classified(const Box& box, const Eigen::MatrixXd& values) const {
    const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(values.rows())));
    Sampled result{box, {}, {}, true};
    for (Eigen::Index guard = 0; guard < values.cols(); ++guard) {
      const Eigen::VectorXd column = values.col(guard);
      result.surfaces.push_back(
          ChebyshevSurface::through(Eigen::Map<const Eigen::MatrixXd>(column.data(), n, n)));
    }
    for (int guard = 0; guard < static_cast<int>(values.cols()); ++guard) {
      const ChebyshevSurface& surface = result.surfaces[static_cast<std::size_t>(guard)];
      const double tail = surface.tail();
      if (!may_vanish(surface, 4.0 * tail) || !is_wanted(guard, result.surfaces)) {
        continue;
      }
      result.crossing.push_back(guard);
      // A hundredth of what the lines themselves may be off, so that lines that meet in one point
      // do so within their tolerance; below 1e-13 samples are rounding.
      const double allowed =
          std::max(1e-2 * options_.line_tolerance, 1e-13) * values.col(guard).cwiseAbs().maxCoeff();
      result.is_resolved = result.is_resolved && tail <= allowed;
    }
    // Terms that do not count together only make the search for lines slower.
    for (ChebyshevSurface& surface : result.surfaces) {
      const auto n_terms = static_cast<double>(surface.coefficients().size());
      const double size = surface.variation() + std::abs(surface.coefficients()(0, 0));
      surface = surface.trimmed(std::max(1e-3 * options_.line_tolerance, 1e-15) * size / n_terms);
    }
    return result;
  }

  static bool may_vanish(const ChebyshevSurface& surface, double margin) {
    const double mean = std::abs(surface.coefficients()(0, 0));
    return mean > 0.0 ? mean <= surface.variation() + margin : surface.variation() > 0.0;
  }

  // Not if the guard's domain is surely elsewhere.
  [[nodiscard]] bool is_wanted(int guard, const std::vector<ChebyshevSurface>& surfaces) const {
    const GuardLine& line = guards_.lines[static_cast<std::size_t>(guard)];
    if (line.domain < 0) {
      return true;
    }
    const ChebyshevSurface& domain = surfaces[static_cast<std::size_t>(line.domain)];
    return may_vanish(domain, 4.0 * domain.tail()) ||
           domain.coefficients()(0, 0) * line.domain_sign > 0.0;
  }

  void add(const Sampled& sampled) {
    if (sampled.crossing.empty()) {
      for (Eigen::Index i = 0; i < line_rule_.nodes.size(); ++i) {
        for (Eigen::Index j = 0; j < line_rule_.nodes.size(); ++j) {
          add_point(sampled.box, 2.0 * line_rule_.nodes[i] - 1.0, 2.0 * line_rule_.nodes[j] - 1.0,
                    4.0 * line_rule_.weights[i] * line_rule_.weights[j]);
        }
      }
      return;
    }
    const SquareRule rule =
        height_rule(sampled.surfaces, sampled.crossing, guards_.lines, options_);
    for (std::size_t i = 0; i < rule.weights.size(); ++i) {
      add_point(sampled.box, rule.xi[i], rule.eta[i], rule.weights[i]);
    }
  }

  void add_point(const Box& box, double xi, double eta, double weight) {
    const Eigen::Vector2d at = box.centre + box.half * Eigen::Vector2d(xi, eta);
    const PatchCell& cell = cells_[box.cell];
    const Eigen::Vector2d x = cell.at(at[0], at[1]);
    p_.push_back(x[0]);
    r_.push_back(x[1]);
    weights_.push_back(weight * box.half * box.half * cell.density(at[0], at[1]));
  }

  std::vector<PatchCell> cells_;
  const Guards& guards_;
  const FittedRuleOptions& options_;
  LineRule line_rule_;
  std::vector<double> p_, r_, weights_;
};

}  // namespace

PatchRule fitted_rule(const PatchCells& cells, const Guards& guards,
                      const FittedRuleOptions& options) {
  require_valid(options);
  FittedRule fitted(cells, guards, options);
  PatchRule rule = fitted.rule();
  const auto n_cells = static_cast<Eigen::Index>(patch_cells(cells).size());
  rule.n_dropped_cells = cells.corners.rows() - n_cells;
  return rule;
}

}  // namespace microslip::contact
