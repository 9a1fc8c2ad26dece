/// @file
/// Modes of a chain scene's [model]: from masses and springs, from matrices, or as given.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

struct ChainSystem {
  std::vector<std::string> coordinates;  ///< names, n
  Eigen::VectorXd frequency;             ///< ω [rad/s], n_modes, ascending where they are computed
  Eigen::MatrixXd shapes;                ///< n × n_modes [1/√kg]
};

/// Modes of K x = ω² M x, mass-normalised, the largest entry of each positive. Frequencies that are
/// zero to rounding are zero.
/// @param K  symmetric, positive semidefinite.  @param M  symmetric, positive definite.
/// @throws std::invalid_argument  M is not positive definite, or K has a negative eigenvalue.
[[nodiscard]] ChainSystem modes_of_matrices(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

/// K of a chain. @param springs  ground–m1, m1–m2, …, m(n−1)–mn and, optionally, mn–ground [N/m].
[[nodiscard]] Eigen::MatrixXd chain_stiffness(Eigen::Index n_masses,
                                              const Eigen::VectorXd& springs);

/// A symmetric matrix, written as a list of rows. @throws SceneError  not square, not symmetric.
[[nodiscard]] Eigen::MatrixXd read_symmetric(const SectionReader& section, std::string_view key);

/// The lowest modes, as many as `modes.count` asks for; all without it.
/// @throws SceneError  too many.
void keep_lowest(ChainSystem& system, const SectionReader& modes);

/// @param model  the section [model] of a chain.
/// @throws SceneError  as read_chain().
[[nodiscard]] ChainSystem read_chain_system(const SectionReader& model);

}  // namespace microslip::pipelines
