/// @file
/// Which fraction of a contact area is in which state.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/contact_state.hpp"
#include "contact/transient_force.hpp"

namespace microslip::contact {

/// @param weights  area of each point [m²], n; without area: all shares are 0.
[[nodiscard]] StateShares area_shares(const std::vector<ContactState>& states,
                                      const Eigen::VectorXd& weights);

}  // namespace microslip::contact
