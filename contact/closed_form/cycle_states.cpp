#include "contact/closed_form/cycle_states.hpp"

#include <cmath>

#include "contact/closed_form/cycle_phases.hpp"
#include "contact/closed_form/slip_functions.hpp"

namespace microslip::contact {

CycleStates cycle_states(const PointParameters& point, const PointMotion& motion) {
  const SlipFunctions w = slip_functions(point, motion);
  const CycleRegime regime = cycle_regime(w);
  if (regime == CycleRegime::separated) return {};
  CycleStates result{regime, PeriodStates(ContactState::stick)};
  const CyclePhases phases = cycle_phases(w, regime);
  if (phases.n_phases == 0) return result;
  double begin = std::atan2(phases.phase[0].begin.sin, phases.phase[0].begin.cos);
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    result.period.set(state_of(phase.kind), begin, phase.length);
    begin += phase.length;
  }
  const bool has_friction = point.friction_coefficient > 0.0 && point.tangential_stiffness > 0.0;
  return has_friction ? result : result.without_slip();
}

}  // namespace microslip::contact
