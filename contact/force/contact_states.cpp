#include "contact/contact_states.hpp"

#include <algorithm>

namespace microslip::contact {

StateChange state_change(const ContactStates& before, const ContactStates& after) {
  StateChange change;
  if (before.size() != after.size()) return change;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double changed = before[i].cycle.period.changed(after[i].cycle.period);
    change.share += before[i].share * changed;
    change.largest = std::max(change.largest, changed);
    change.n_regimes += before[i].cycle.regime != after[i].cycle.regime ? 1 : 0;
  }
  return change;
}

}  // namespace microslip::contact
