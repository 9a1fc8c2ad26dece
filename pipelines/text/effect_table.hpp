/// @file
/// The effects a scene may be simulated with, one row each: key, indicator, threshold, what is lost
/// without it. Keys of [effects] (scene_keys.cpp), contradictions (sections/effects_section),
/// choice and reasons (effects/effects), checks after a run (accuracy/effect_bounds) and every
/// threshold come from here.
///
/// An indicator is dimensionless and told before a run, from the linear limits of the structure:
/// every contact point free, every one stuck (theory section 13.2).
/// Above its threshold the effect is called for.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

namespace microslip::pipelines {

struct EffectRow {
  std::string_view name;      ///< also its key in [effects]
  std::string_view meaning;   ///< as `init` prints it beside the key
  std::string_view quantity;  ///< what the indicator is, or why there is none
  double threshold;           ///< of the indicator
  std::string_view lost;      ///< without the effect
  /// Of contact under a load: the linear limits have nothing of it.
  bool of_loads = false;
};

inline constexpr double no_threshold = std::numeric_limits<double>::infinity();

inline constexpr std::array effect_table{
    EffectRow{"nonlinearity", "contact that slips, opens and closes, and is no spring",
              "force of the stuck limit over what friction holds, or approach over gap", 1.0,
              "contact answers like springs, or not at all", true},
    EffectRow{"normal_motion", "load variation by normal motion",
              "change of load over load, or share of the normal springs in the strain energy", 1e-4,
              "the load stays that of rest, nothing opens, and the normal springs are missing"},
    EffectRow{"separation", "one-sided contact", "change of load over load", 1.0,
              "contact never opens, whatever the motion", true},
    EffectRow{"mean_coupling", "mean motion changes the load",
              "mean change of load over load, at most", 0.01,
              "the load varies about that of rest whatever the mean motion", true},
    EffectRow{"second_direction", "friction along r as well", "motion along r over that along p",
              0.03, "friction along r neither holds nor takes energy"},
    EffectRow{"higher_harmonics", "harmonics above the first",
              "motion of the patch by a force at k times the frequency over that by the same force "
              "at the "
              "frequency, divided by k^2",
              5e-3,
              "what contact drives at multiples of the frequency is missing, seen to change peaks "
              "by a third",
              true},
    EffectRow{"roughness", "rough surfaces", "height of the roughness over the compression at rest",
              0.1, "surfaces are as stiff under a small load as in full contact", true},
    EffectRow{"rate_dependence", "friction coefficient by slip speed",
              "change of the coefficient up to the highest speed of the linear limits", 3e-4,
              "the coefficient is the same at every speed of slip", true},
    EffectRow{"moments", "areas of contact, which carry moments",
              "moment over load times half the size, or unevenness of the pressure at rest or of "
              "the motion along the face",
              1.0 / 3.0,
              "a contact point carries forces alone: turning neither loads nor opens it"},
    EffectRow{"residual", "residual flexibility of omitted modes",
              "change of the stuck frequency nearest to the range, or share in the flexibility of "
              "contact",
              1e-3, "the modes kept alone are too stiff where contact acts"},
    EffectRow{"local_frames", "a frame for every place of a curved face",
              "nodes off the mean plane over the size of the face", 0.01,
              "the face is plane, with one normal and one slip direction"},
    EffectRow{"static_preload", "pressure at rest from static loads",
              "root mean square of the pressure's variation over its mean", 0.1,
              "pressure at rest has the shape the scene gives it"},
    EffectRow{"centrifugal", "stiffness and equilibrium of a rotating body",
              "square of the speed over the lowest natural frequency", 1e-3,
              "modes are those at rest"},
    EffectRow{"stability", "stability of each point",
              "none: it moves no point of a curve, it says which of them a machine can show",
              no_threshold, "which solutions a machine shows is not known"},
    EffectRow{"wear", "wear depth in the maps",
              "none: a depth is asked for or not, and acts back on nothing", no_threshold,
              "no map shows where material goes"},
    EffectRow{"maps", "contact maps",
              "none: pictures of solutions that are there, which change nothing", no_threshold,
              "nothing shows where the face sticks, slips and opens"},
    EffectRow{"coexistence", "search for other solutions beside those found",
              "approach over gap, change of load over load, or force over friction that falls with "
              "speed, at resonances near by, of a curve at those outside its range",
              1.0, "a solution that no sweep meets is not seen", true},
};

/// Motion of given modes along r is meant: their threshold of `second_direction`. Below it friction
/// there does 5e-9 of the work, at four times the seconds of a curve.
inline constexpr double least_given_motion = 1e-4;

/// Change of a highest peak by an effect left out from which a run warns of it.
inline constexpr double worth_a_warning = 0.02;

/// @param name  of the table: anything else does not compile where it is a constant.
[[nodiscard]] constexpr const EffectRow& effect_row(std::string_view name) {
  return *std::ranges::find(effect_table, name, &EffectRow::name);
}

}  // namespace microslip::pipelines
