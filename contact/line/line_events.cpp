#include "contact/line/line_events.hpp"

#include <algorithm>

#include "contact/line/event_cycle.hpp"
#include "contact/line/event_force.hpp"
#include "contact/line/event_guards.hpp"
#include "contact/line/event_phases.hpp"

namespace microslip::contact {
namespace {

// Storage of one thread, so that an evaluation allocates nothing once it has grown.
struct Workshop {
  EventGuards guards;
  EventSearch search;
  EventForce force;
};

Workshop& workshop() {
  thread_local Workshop shop;
  return shop;
}

}  // namespace

void LineEvents::traction(const Harmonics& motion, double /*frequency*/,
                          PointTraction& result) const {
  Workshop& shop = workshop();
  set_event_guards(point_, motion, shop.guards);
  shop.force.traction(point_, shop.guards, shop.search.find(shop.guards), result);
}

void LineEvents::states(const Harmonics& motion, double /*frequency*/,
                        PointTraction& result) const {
  Workshop& shop = workshop();
  set_event_guards(point_, motion, shop.guards);
  set_states(shop.search.find(shop.guards), result);
}

Harmonics LineEvents::force_up_to(const Harmonics& motion, double /*frequency*/,
                                  int n_harmonics) const {
  Workshop& shop = workshop();
  set_event_guards(point_, motion, shop.guards);
  return shop.force.force(point_, shop.guards, shop.search.find(shop.guards), n_harmonics);
}

PointHistory LineEvents::history(const Harmonics& motion, double /*frequency*/,
                                 const Eigen::VectorXd& phases, int n_harmonics) const {
  Workshop& shop = workshop();
  set_event_guards(point_, motion, shop.guards);
  const EventPhases& found = shop.search.find(shop.guards);
  const EventWork work = event_work(point_, shop.guards, found);
  PointHistory history;
  history.regime = found.regime;
  history.segments = event_segments(point_, found);
  history.force = shop.force.force(point_, shop.guards, found, n_harmonics);
  history.normal_slip = work.normal_slip;
  history.slip_distance = work.slip_distance;
  history.dissipated_energy = point_.friction_coefficient * work.normal_slip;
  history.instants.reserve(static_cast<std::size_t>(phases.size()));
  for (const double phase : phases) {
    history.instants.push_back(
        event_instant(point_, motion, segment_at(history.segments, phase), phase));
  }
  return history;
}

Eigen::Vector3d LineEvents::stuck_stiffness() const {
  return {point_.has_friction() ? point_.tangential_stiffness : 0.0, point_.normal_stiffness, 0.0};
}

std::optional<LinearRange> LineEvents::linear_range() const {
  return LinearRange{stuck_stiffness(), point_.rest_load,
                     FrictionLaw::constant(point_.friction_coefficient)};
}

double LineEvents::reference_load() const { return std::max(point_.rest_load, 0.0); }

}  // namespace microslip::contact
