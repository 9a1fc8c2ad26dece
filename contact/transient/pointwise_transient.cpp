#include "contact/transient/pointwise_transient.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace microslip::contact {

PointwiseTransient::PointwiseTransient(Eigen::VectorXd weights, ModalShapes shapes, int directions)
    : weights_(std::move(weights)), shapes_(std::move(shapes)), directions_(directions) {}

TransientMemory PointwiseTransient::virgin_memory() const {
  TransientMemory memory{std::vector<ContactState>(static_cast<std::size_t>(n_points())),
                         Eigen::VectorXd::Zero(directions_ * n_points()),
                         Eigen::VectorXd::Zero(n_internal())};
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n_modes());
  commit({rest, rest}, memory);
  return memory;
}

StateShares PointwiseTransient::shares(const TransientMemory& memory) const {
  const double total = weights_.sum();
  if (total == 0.0) return {};
  StateShares area;
  for (std::size_t i = 0; i < memory.state.size(); ++i) {
    const ContactState state = memory.state[i];
    double& part = state == ContactState::stick       ? area.stick
                   : state == ContactState::separated ? area.separated
                                                      : area.slip;
    part += weights_[static_cast<Eigen::Index>(i)] / total;
  }
  return area;
}

}  // namespace microslip::contact
