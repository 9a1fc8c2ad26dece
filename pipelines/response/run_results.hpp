/// @file
/// What a run has found, as the writers see it: plain values, no solver objects behind them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "contact/contact_map.hpp"
#include "contact/modal_force.hpp"
#include "pipelines/description/scene_description.hpp"
#include "solver/optimum.hpp"
#include "solver/response_curve.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {

/// One patch at one solution.
struct NamedMap {
  std::string name;  ///< e.g. "preload_1000_peak": stem of the files
  double frequency_hz = 0.0;
  double amplitude = 0.0;  ///< of the output, half peak-to-peak [m]
  solver::Stability stability = solver::Stability::not_assessed;
  std::size_t patch = 0;         ///< of the model
  contact::ContactMap points;    ///< at the contact points (cells)
  contact::ContactMap vertices;  ///< at the vertices of the cells; empty without cells
};

/// What one patch did at every point of a curve.
struct PatchShares {
  std::string patch;                          ///< its name
  std::vector<contact::CycleReport> reports;  ///< as many as the curve has points
};

/// Between which amplitudes a curve lies at the frequency of each of its points [m].
struct AmplitudeBand {
  std::vector<double> low;
  std::vector<double> high;
};

struct CurveResult {
  std::string name;                      ///< stem of the CSV
  std::variant<double, LimitName> load;  ///< preload [N] (modal scenes: the factor), or a limit
  solver::ResponseCurve curve;
  std::vector<NamedMap> maps;
  std::vector<PatchShares> patch_shares{};  ///< where there are several patches, else empty
  std::optional<double> gap{};              ///< width of the uniform gap that the load is [m]
  bool integrated = false;  ///< in time: to the tolerance of integration, not to rounding
  std::optional<solver::RicherPeak> richer{};  ///< the peak with more harmonics than were given
  bool lacks_time = false;  ///< solved with fewer harmonics than were to be had with more time
  std::optional<AmplitudeBand> band{};  ///< none: its error is not told
};

/// The best value when one uncertain number of the contact is multiplied.
struct OptimumOfFactor {
  std::string parameter;  ///< friction_coefficient | contact_stiffness
  double factor = 1.0;
  solver::Optimum optimum;
  std::array<double, 2> range{};  ///< searched, in SI
  bool widened = false;           ///< beyond what the scene asks for
  int n_harmonics = 0;            ///< it is searched with; 0: those of the best value as given
};

struct OptimumBracket {
  std::vector<OptimumOfFactor> entries;
  std::vector<std::string> left_out;  ///< what is not varied and why
};

struct StageRecord {
  std::string name;
  double seconds = 0.0;
  double peak_memory_mb = 0.0;
};

}  // namespace microslip::pipelines
