#include "contact/closed_form/cycle_states.hpp"

#include <cmath>

namespace microslip::contact {

CycleStates cycle_states(CycleRegime regime, const CyclePhases& phases) {
  if (regime == CycleRegime::separated) return {};
  CycleStates result{regime, PeriodStates(ContactState::stick)};
  if (phases.n_phases == 0) return result;
  double begin = std::atan2(phases.phase[0].begin.sin, phases.phase[0].begin.cos);
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    result.period.set(state_of(phase.kind), begin, phase.length);
    begin += phase.length;
  }
  return result;
}

}  // namespace microslip::contact
