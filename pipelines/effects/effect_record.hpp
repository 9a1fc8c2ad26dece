/// @file
/// One row of the table of effects as a scene has it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace microslip::pipelines {

enum class Simulated : std::uint8_t { no, yes, undecided };

/// An indicator of the nonlinear motion, where it is largest of all solution points.
struct IndicatorAlong {
  double indicator = 0.0;
  std::string curve;
  double frequency_hz = 0.0;
};

struct EffectRecord {
  std::string name;
  std::string setting;  ///< auto | on | off
  Simulated simulated = Simulated::no;
  std::string reason;  ///< why; of what is left out also what is lost
  std::optional<double>
      indicator{};  ///< dimensionless (effect_table.hpp); none: not told, or not yet
  std::optional<double> threshold{};  ///< of the indicator; above it the effect is called for
  std::optional<double>
      seconds{};  ///< that a run takes longer with it, forecast; none: no longer, or not told apart
  std::optional<double>
      bound{};  ///< of what is left out: relative change of a highest peak by having it
  std::optional<double>
      bound_along{};  ///< of what is left out: change of any amplitude of a curve over its highest
  std::optional<double> bound_together{};  ///< of all that are left out, put back together
  /// Of what `auto` had left out and the run has put back: what leaving it out changes a highest
  /// peak by. Infinite: the peak with it was not found from that without. None:
  /// not switched on by a run.
  std::optional<double> switched_on{};
  std::optional<IndicatorAlong> along{};  ///< of what is left out; none: not looked at
  std::string objection{};                ///< why the setting is wrong; empty: nothing says so
  std::string refusal{};                  ///< why the setting cannot be obeyed; empty: it is
};

}  // namespace microslip::pipelines
