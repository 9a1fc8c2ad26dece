#include "pipelines/scene/chain_system.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contact/dense.hpp"
#include "mesh/count_text.hpp"
#include "pipelines/sections/modes_section.hpp"

namespace microslip::pipelines {
namespace {

/// A list of rows, all as long as the first.
Eigen::MatrixXd read_rows(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  const toml::array* rows = node.as_array();
  const toml::array* first = rows == nullptr || rows->empty() ? nullptr : rows->get(0)->as_array();
  if (first == nullptr || first->empty()) s.fail(key, "expected rows [[a, b], [c, d]]", &node);
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows->size()),
                         static_cast<Eigen::Index>(first->size()));
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const toml::array* row = rows->get(i)->as_array();
    if (row == nullptr || row->size() != first->size()) {
      s.fail(key, fmt::format("row {}: expected {} numbers, as in the first", i + 1, first->size()),
             rows->get(i));
    }
    for (std::size_t j = 0; j < row->size(); ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          s.number_in(*row->get(j), key);
    }
  }
  return matrix;
}

ChainSystem checked_modes(const SectionReader& s, std::string_view key, const Eigen::MatrixXd& K,
                          const Eigen::MatrixXd& M) {
  try {
    return modes_of_matrices(K, M);
  } catch (const std::invalid_argument& error) {
    s.fail(key, error.what(), s.node(key));
  }
}

ChainSystem from_masses(const SectionReader& s) {
  const Eigen::VectorXd masses = read_numbers(s, "masses");
  const Eigen::VectorXd springs = read_numbers(s, "springs");
  const Eigen::Index n = masses.size();
  if (!(masses.minCoeff() > 0.0)) s.fail("masses", "every mass must be above 0", s.node("masses"));
  if (springs.minCoeff() < 0.0) {
    s.fail("springs", fmt::format("{:g} is negative", springs.minCoeff()), s.node("springs"));
  }
  if (springs.size() != n && springs.size() != n + 1) {
    s.fail("springs",
           fmt::format(
               "{} springs for {} masses; expected {} (ground–m1, m1–m2, …) or {} (mn–ground as "
               "well)",
               springs.size(), n, n, n + 1),
           s.node("springs"));
  }
  return checked_modes(s, "masses", chain_stiffness(n, springs), masses.asDiagonal());
}

ChainSystem from_matrices(const SectionReader& s) {
  const Eigen::MatrixXd K = read_symmetric(s, "stiffness_matrix");
  const Eigen::MatrixXd M = read_symmetric(s, "mass_matrix");
  if (K.rows() != M.rows()) {
    s.fail("mass_matrix",
           fmt::format("{}, and the stiffness has {}", mesh::counted(M.rows(), "row", "rows"),
                       K.rows()),
           s.node("mass_matrix"));
  }
  return checked_modes(s, "mass_matrix", K, M);
}

ChainSystem from_modes(const SectionReader& s) {
  ChainSystem system;
  const Eigen::VectorXd frequency_hz = read_numbers(s, "frequency");
  if (frequency_hz.minCoeff() < 0.0) {
    s.fail("frequency", fmt::format("{:g} is negative", frequency_hz.minCoeff()),
           s.node("frequency"));
  }
  system.frequency = 2.0 * std::numbers::pi * frequency_hz;
  const Eigen::MatrixXd rows = read_rows(s, "mode_shapes");
  if (rows.rows() != frequency_hz.size()) {
    s.fail("mode_shapes",
           fmt::format("{} for {}", mesh::counted(rows.rows(), "row", "rows"),
                       mesh::counted(frequency_hz.size(), "mode", "modes")),
           s.node("mode_shapes"));
  }
  system.shapes = rows.transpose();
  return system;
}

std::vector<std::string> coordinates_in(const SectionReader& s, Eigen::Index n) {
  std::vector<std::string> names;
  if (!s.given("coordinates")) {
    for (Eigen::Index i = 0; i < n; ++i) names.push_back(fmt::format("m{}", i + 1));
    return names;
  }
  const toml::node& node = *s.node("coordinates");
  const toml::array* list = node.as_array();
  if (list == nullptr || static_cast<Eigen::Index>(list->size()) != n) {
    s.fail("coordinates", fmt::format("expected a list of {} names", n), &node);
  }
  for (const toml::node& entry : *list) {
    const auto name = entry.is_string() ? entry.value<std::string>() : std::nullopt;
    if (!name || name->empty()) s.fail("coordinates", "expected names in quotes", &entry);
    if (std::find(names.begin(), names.end(), *name) != names.end()) {
      s.fail("coordinates", fmt::format("\"{}\" stands twice", *name), &entry);
    }
    names.push_back(*name);
  }
  return names;
}

}  // namespace

Eigen::MatrixXd read_symmetric(const SectionReader& s, std::string_view key) {
  const Eigen::MatrixXd matrix = read_rows(s, key);
  if (matrix.rows() != matrix.cols()) {
    s.fail(key, fmt::format("{} rows of {} numbers: not square", matrix.rows(), matrix.cols()),
           s.node(key));
  }
  // Printed numbers agree to their last digit, not to rounding.
  constexpr double printed = 1e-9;
  if (!matrix.isApprox(matrix.transpose(), printed)) s.fail(key, "is not symmetric", s.node(key));
  return 0.5 * (matrix + matrix.transpose());
}

void keep_lowest(ChainSystem& system, const SectionReader& modes) {
  if (!modes.given("count")) return;
  const int count = modes.integer("count");
  if (count > system.frequency.size()) {
    modes.fail("count",
               fmt::format("{} modes of a system that has {}", count, system.frequency.size()),
               modes.node("count"));
  }
  system.frequency.conservativeResize(count);
  system.shapes.conservativeResize(Eigen::NoChange, count);
}

Eigen::MatrixXd chain_stiffness(Eigen::Index n_masses, const Eigen::VectorXd& springs) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n_masses, n_masses);
  for (Eigen::Index i = 0; i < springs.size(); ++i) {  // spring i ties mass i to mass i − 1
    if (i < n_masses) K(i, i) += springs[i];
    if (i > 0) K(i - 1, i - 1) += springs[i];
    if (i > 0 && i < n_masses) K(i, i - 1) = K(i - 1, i) = -springs[i];
  }
  return K;
}

ChainSystem modes_of_matrices(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  if (!contact::is_positive_definite(M)) {
    throw std::invalid_argument("the mass matrix is not positive definite");
  }
  const auto pairs = contact::symmetric_pairs(K, M);
  if (!pairs) throw std::invalid_argument("the eigenvalues do not converge");
  Eigen::VectorXd values = pairs->values;
  const double rounding = 10.0 * static_cast<double>(K.rows()) *
                          std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
  if (values.minCoeff() < -rounding) {
    throw std::invalid_argument(
        fmt::format("the stiffness matrix has the negative eigenvalue {:g}", values.minCoeff()));
  }
  values = (values.array() > rounding).select(values, 0.0);
  ChainSystem system{{}, values.cwiseSqrt(), pairs->vectors};
  for (auto shape : system.shapes.colwise()) {
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    if (shape[largest] < 0.0) shape = -shape;
  }
  return system;
}

ChainSystem read_chain_system(const SectionReader& s) {
  constexpr std::array<std::array<std::string_view, 2>, 3> forms{
      {{"masses", "springs"}, {"mass_matrix", "stiffness_matrix"}, {"frequency", "mode_shapes"}}};
  std::vector<std::size_t> given;
  for (std::size_t form = 0; form < forms.size(); ++form) {
    const auto& [one, other] = forms[form];
    if (!s.given(one) && !s.given(other)) continue;
    if (s.given(one) != s.given(other)) {
      s.fail(s.given(one) ? other : one,
             fmt::format("is missing: {} and {} go together", one, other));
    }
    given.push_back(form);
  }
  if (given.size() != 1) {
    s.fail(
        given.empty() ? "masses" : forms[given[1]][0],
        "expected one of: masses with springs, mass_matrix with stiffness_matrix, frequency with "
        "mode_shapes");
  }
  ChainSystem system = given[0] == 0   ? from_masses(s)
                       : given[0] == 1 ? from_matrices(s)
                                       : from_modes(s);
  system.coordinates = coordinates_in(s, system.shapes.rows());
  return system;
}

}  // namespace microslip::pipelines
