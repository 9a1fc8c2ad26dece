/// @file
/// Models of one scene that differ from the one at hand in one choice of the discretisation each,
/// to tell what that choice does to a peak.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "solver/continuation_options.hpp"

namespace microslip::pipelines {

struct RicherModel {
  std::string source;  ///< of error, as in ErrorRow
  ReducedModel model;
  /// Its modal coordinates from those of the model at hand; empty: the same modes.
  Eigen::MatrixXd embedding{};
  /// Error of the model at hand over (value of this model − value at hand): 1 where this one is as
  /// good as exact, 4/3 where errors fall fourfold from one to the other,
  /// negative for a coarser one.
  double share = 1.0;
};

struct RicherModels {
  std::vector<RicherModel> models;
  std::vector<std::string> unknown;  ///< sources that cannot be told for this scene
  std::string note;                  ///< why, where something failed; for the log
  std::vector<NoBound> no_bound{};   ///< effects that cannot be put back (models_left_out.hpp)
  /// What the eigensolver has left of its equations, mode by mode (fem::ModalBasis::residual);
  /// empty: modes are given.
  Eigen::VectorXd eigen_residual{};
};

/// Instants (events located in place of sampled forces), cells (four times as many), fit (the
/// finite elements' own shapes), basis (tractions of one degree more), second_direction (friction
/// along r) and mesh (coarser_mesh.hpp, given_mesh.hpp): those the scene has. Of a bar cells are
/// its contact points and the basis its modes, several times as many of each, or a part of many.
/// @param structure  of the scene; nullptr: a kind that gives its modes itself.
/// @param sources    the only ones asked for; empty: all.
[[nodiscard]] RicherModels richer_models(const ReducedModel& model, const SceneDescription& scene,
                                         const SolvedStructure* structure,
                                         const std::vector<std::string>& sources = {});

/// How a peak is carried from a model to a richer one: as exact as the forces of both allow, with
/// all harmonics that either may move in, and without a search for other branches.
[[nodiscard]] solver::ContinuationOptions options_of_both(const SceneDescription& scene,
                                                          const ReducedModel& model,
                                                          const ReducedModel& richer);

/// Of the natural frequency nearest to a peak, the other model's over that of the model at hand.
/// @param peak       [rad/s].
/// @param embedding  as of a RicherModel: the mode that moves most with this one is the same.
[[nodiscard]] double frequency_factor(const ReducedModel& model, const ReducedModel& other,
                                      double peak, const Eigen::MatrixXd& embedding);

}  // namespace microslip::pipelines
