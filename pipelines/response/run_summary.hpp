/// @file
/// A run in a few numbers, as summary.json and the report tell them (interfaces.md section 3.1).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "pipelines/effects/beside_bar.hpp"
#include "pipelines/effects/effect_record.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/system/machine.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

struct MeshSummary {
  Eigen::Index nodes = 0;
  Eigen::Index elements = 0;
  Eigen::Index degrees_of_freedom = 0;  ///< without the clamped ones
  double volume = 0.0;                  ///< [m³]
  double mass = 0.0;                    ///< [kg]
};

struct ModeSummary {
  double frequency = 0.0;  ///< ω [rad/s]
  double damping_ratio = 0.0;
  std::optional<double> residual;   ///< none for modes that were given, and attachment shapes
  std::optional<double> fit_error;  ///< none without a fit
  bool is_attachment = false;       ///< a static shape that stands for omitted modes
};

struct PeakSummary {
  double frequency = 0.0;          ///< ω [rad/s]
  double amplitude = 0.0;          ///< [m]
  double dissipated_energy = 0.0;  ///< by friction in a period [J]
  bool at_range_end = false;
};

/// A ResponseCurve in a few numbers.
struct CurveSummary {
  std::string name;
  std::variant<double, LimitName> preload;  ///< total [N], or a limit
  std::optional<double> gap;                ///< width of the uniform gap that the preload is [m]
  std::optional<double> preload_scale;  ///< modal scenes: factor on the rest loads that are given
  /// ∬ max(n₀', 0) dA and ∬ n₀' dA over the contact points [N]; none for a limit.
  std::optional<double> preload_carried, preload_integral;
  bool complete = false;
  solver::Diagnosis diagnosis = solver::Diagnosis::none;
  std::string message;
  /// The highest of `peaks`; of a complete curve without peaks its highest end. None: neither.
  std::optional<PeakSummary> peak;
  std::vector<PeakSummary> peaks;
  std::vector<double> folds;  ///< ω [rad/s], in branch order
  std::size_t points = 0;
  long iterations = 0;
  long contact_evaluations = 0;
  long state_readings = 0;
  long state_cuts = 0;
  long stable_unproved = 0;  ///< points called stable by Hill's exponents alone
  double seconds = 0.0;
  double largest_residual = 0.0;
  double largest_energy_imbalance = 0.0;
  double largest_dissipation_mismatch = 0.0;
  double largest_three_states_share = 0.0;
  std::set<int> harmonic_orders;   ///< that were unknowns at some point, beside the mean
  std::size_t most_harmonics = 0;  ///< at one point
  /// Of the amplitude, by harmonics left out: estimated where they are chosen,
  /// solved for where they are given.
  double largest_left_out = 0.0;
  std::optional<solver::RicherPeak> richer;  ///< the peak with more harmonics than were given
  std::vector<std::string> maps;             ///< stems in maps/
  std::string certificate;                   ///< what was proved instead of solved; empty: solved
  std::vector<solver::SolverEvent> remedies;
  std::size_t detached_branches = 0;
  std::vector<std::string> not_in_bar;  ///< sources of error that could not be told
  BesideBar left_out;                   ///< effects
  int search_starts = 0;
};

struct OptimumSummary {
  OptimumRequest request;
  solver::Optimum optimum;
  OptimumBracket bracket;
  double newtons_per_load = 1.0;  ///< where loads are scales: the force carried at scale 1 [N]
  std::vector<ErrorRow> error_budget{};       ///< of value, amplitude and frequency
  std::vector<std::string> not_in_bar{};      ///< sources of error that could not be told
  BesideBar left_out{};                       ///< effects, by what they change peaks of the curves
  std::optional<double> dissipated_energy{};  ///< by friction in a period [J]; empty: not told
};

/// The accuracy that was asked for.
struct AccuracySummary {
  double asked = 0.0;                  ///< relative; 0: settings as written
  double reached = 0.0;                ///< the largest bar of all curves; infinite: not known
  std::vector<std::string> not_known;  ///< sources that a bar leaves out
  BesideBar left_out;                  ///< effects
  std::vector<std::string> refined;    ///< what was refined, round by round
  bool out_of_time = false;  ///< what was asked for is not there, with more time it would be
  std::string message;       ///< in words; empty: reached
};

struct RunSummary {
  std::string version;
  std::string scene;  ///< file name of the scene, without its folder
  std::string title;
  ExitCode exit_code = ExitCode::complete;
  std::string message;  ///< of the error that ended the run; empty when there was none
  Machine machine;
  std::vector<std::pair<std::string, std::string>> libraries;
  std::vector<StageRecord> stages;
  std::optional<MeshSummary> mesh;
  std::vector<ModeSummary> modes;
  std::vector<CurveSummary> curves;
  std::optional<OptimumSummary> optimum;
  std::vector<EffectRecord> effects;
  std::vector<std::string> warnings;
  std::vector<ErrorRow> error_budget;
  std::optional<AccuracySummary> accuracy;
};

[[nodiscard]] CurveSummary summarise(const CurveResult& result);

/// Of the fitted mode shapes, per mode the largest over the patches; empty where nothing is fitted.
[[nodiscard]] Eigen::VectorXd worst_fit_error(const ReducedModel& model);

/// @param residual, fit_error  N, or shorter: the last have none.
/// @param n_attachment  so many of them, the last, are attachment shapes.
[[nodiscard]] std::vector<ModeSummary> summarise_modes(const Eigen::VectorXd& frequency,
                                                       const Eigen::VectorXd& damping_ratio,
                                                       const Eigen::VectorXd& residual,
                                                       const Eigen::VectorXd& fit_error,
                                                       Eigen::Index n_attachment = 0);

}  // namespace microslip::pipelines
