#include "contact/transient/area_shares.hpp"

#include <cstddef>

namespace microslip::contact {

StateShares area_shares(const std::vector<ContactState>& states, const Eigen::VectorXd& weights) {
  const double total = weights.sum();
  if (total == 0.0) return {};
  StateShares area;
  for (std::size_t i = 0; i < states.size(); ++i) {
    double& part = states[i] == ContactState::stick       ? area.stick
                   : states[i] == ContactState::separated ? area.separated
                                                          : area.slip;
    part += weights[static_cast<Eigen::Index>(i)] / total;
  }
  return area;
}

}  // namespace microslip::contact
