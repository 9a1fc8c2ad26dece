#include "contact/contact_force.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "contact/force/fewer_coordinates.hpp"
#include "contact/force/motion_of_points.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/force/vibration_alone.hpp"
#include "contact/line/line_events.hpp"
#include "contact/line/surface_line_events.hpp"
#include "contact/patch/patch_load.hpp"
#include "contact/patch/patch_surfaces.hpp"
#include "contact/patch/preload_field.hpp"
#include "contact/plane/planar_cycle.hpp"
#include "contact/sampled/patch_force.hpp"
#include "contact/transient/patch_transient.hpp"
#include "contact/transient/planar_transient.hpp"

namespace microslip::contact {
namespace {

// As far as the residual of the balance is driven down: coarser, its noise turns branches back.
constexpr double planar_tolerance = 1e-11;
// Fewer points are solved event by event as fast as that matters, and to rounding: plain ones in
// microseconds, others in 0.1 to 1 ms, of which sampling takes a tenth. Where rough points slide in
// a plane it also blurs tips of branches, 1e-7 of a frequency wide, that walks come back from.
constexpr Eigen::Index least_plain_points_in_lanes = 48;
constexpr Eigen::Index least_points_in_lanes = 9;
// Of a period, for a force right to 1e-3.
constexpr int instants_of_plain_lines = 128;
constexpr int instants_of_others = 256;

using PointMethods = std::vector<std::shared_ptr<const PointMethod>>;

/// One direction, constant friction, smooth surfaces.
bool is_plain(const Patch& patch, const ContactEffects& effects) {
  return !effects.second_direction && patch.rules.plain();
}

Eigen::Index n_points(std::span<const Patch> patches) {
  Eigen::Index n = 0;
  for (const Patch& patch : patches) n += patch.cells.size();
  return n;
}

Method method_for(std::span<const Patch> patches, const ContactEffects& effects) {
  if (effects.sampled) return Method::lanes;
  const Method method =
      contact::method_for(n_points(patches), are_plain(patches, effects), effects.n_harmonics);
  return method == Method::lanes && effects.located ? Method::point_methods : method;
}

SurfaceLaw surface_of(const Patch& patch, const PatchSamples& samples,
                      const ContactEffects& effects, std::size_t i, const PointParameters& point) {
  if (is_plain(patch, effects)) return {point, 0.0};
  return surface_at(patch.rules, samples, static_cast<Eigen::Index>(i), point);
}

std::vector<SurfaceLaw> surfaces_of(const Patch& patch, const PatchSamples& samples,
                                    const ContactEffects& effects,
                                    const std::vector<PointParameters>& points) {
  std::vector<SurfaceLaw> surfaces;
  surfaces.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    surfaces.push_back(surface_of(patch, samples, effects, i, points[i]));
  }
  return surfaces;
}

PointMethods methods_of(const Patch& patch, const PatchSamples& samples,
                        const ContactEffects& effects, const std::vector<PointParameters>& points) {
  PointMethods methods;
  methods.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_plain(patch, effects)) {
      methods.push_back(std::make_shared<LineEvents>(points[i]));
      continue;
    }
    const SurfaceLaw surface = surface_of(patch, samples, effects, i, points[i]);
    if (effects.second_direction) {
      methods.push_back(std::make_shared<PlaneEvents>(surface, planar_tolerance));
    } else {
      methods.push_back(std::make_shared<SurfaceLineEvents>(surface));
    }
  }
  return methods;
}

/// Mode shapes as the simulated effects need them: without motion along r where it is left out.
ModalShapes simulated_shapes(ModalShapes shapes, const ContactEffects& effects) {
  if (!effects.second_direction) shapes.w.resize(0, 0);
  return shapes;
}

/// The contact points of several patches, one patch after the other.
struct Stack {
  Eigen::VectorXd weights;
  ModalShapes shapes;
};

Stack stacked(std::span<const Patch> patches, const ContactEffects& effects) {
  const Eigen::Index n = n_points(patches);
  const auto width = [&](Eigen::MatrixXd ModalShapes::*shape) {
    return (patches.front().cells.shapes.*shape).cols();
  };
  Stack all{
      Eigen::VectorXd(n),
      {Eigen::MatrixXd(n, width(&ModalShapes::u)), Eigen::MatrixXd(n, width(&ModalShapes::v)), {}}};
  const bool along_r = effects.second_direction && patches.front().cells.shapes.w.size() > 0;
  if (along_r) all.shapes.w.resize(n, width(&ModalShapes::w));
  Eigen::Index begin = 0;
  for (const Patch& patch : patches) {
    const PatchSamples& cells = patch.cells;
    all.weights.segment(begin, cells.size()) = cells.weights;
    all.shapes.u.middleRows(begin, cells.size()) = cells.shapes.u;
    all.shapes.v.middleRows(begin, cells.size()) = cells.shapes.v;
    if (along_r) all.shapes.w.middleRows(begin, cells.size()) = cells.shapes.w;
    begin += cells.size();
  }
  return all;
}

void require_fitting(const MotionCoordinates& coordinates, Eigen::Index n_modes) {
  const bool fits = coordinates.of_modes.cols() == n_modes &&
                    coordinates.motion.rows() == n_modes &&
                    coordinates.motion.cols() == coordinates.of_modes.rows();
  if (!fits) throw std::invalid_argument("ContactForce: coordinates of another number of modes");
}

void see_through(ModalShapes& shapes, const Eigen::MatrixXd& motion) {
  for (Eigen::MatrixXd* shape : {&shapes.u, &shapes.v, &shapes.w}) {
    if (shape->size() > 0) *shape *= motion;
  }
}

/// A force that is made of the stack, seen through the coordinates given.
template <typename Make>
std::unique_ptr<ModalForce> seen_through(const MotionCoordinates& coordinates, Stack stack,
                                         const Make& make) {
  if (coordinates.all_modes()) return make(std::move(stack));
  require_fitting(coordinates, stack.shapes.u.cols());
  see_through(stack.shapes, coordinates.motion);
  return std::make_unique<FewerCoordinates>(coordinates.of_modes, make(std::move(stack)));
}

template <typename Item>
std::vector<Item> joined(std::span<const std::vector<Item>> lists) {
  std::vector<Item> all;
  for (const std::vector<Item>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace

Method method_for(Eigen::Index n_points, bool plain, int n_harmonics) {
  if (n_harmonics == 1 && plain) return Method::closed_form;
  const Eigen::Index least = plain ? least_plain_points_in_lanes : least_points_in_lanes;
  return n_points >= least ? Method::lanes : Method::point_methods;
}

bool are_plain(std::span<const Patch> patches, const ContactEffects& effects) {
  return std::ranges::all_of(patches, [&](const Patch& patch) { return is_plain(patch, effects); });
}

bool is_sampled(std::span<const Patch> patches, const ContactEffects& effects) {
  return method_for(patches, effects) == Method::lanes;
}

int instants_of(std::span<const Patch> patches, const ContactEffects& effects) {
  const bool plain = are_plain(patches, effects);
  const double order = plain ? 3.0 : 2.0;
  const double closer = std::log2(1e-3 / std::clamp(effects.force_tolerance, 1e-6, 1e-3)) / order;
  int asked = plain ? instants_of_plain_lines : instants_of_others;
  constexpr double rounding = 1e-6;  // of a logarithm that is a whole number
  asked = std::min(asked << static_cast<int>(std::ceil(closer - rounding)), most_instants);
  const int doublings = effects.doublings;
  return doublings < 0 ? asked >> -doublings : std::min(asked << doublings, most_instants);
}

ContactForce::ContactForce(const std::vector<Patch>& patches, const ContactEffects& effects,
                           double load, MotionCoordinates coordinates)
    : patches_(patches), effects_(effects), load_(load), coordinates_(std::move(coordinates)) {
  const std::vector<PatchLoad> loads = shared_load(patches_, load_);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    points_.push_back(point_parameters(patches_[i], patches_[i].cells, effects_, loads[i]));
  }
}

std::unique_ptr<ModalForce> ContactForce::modal_force() const {
  return as_coupled(force_of(0, patches_.size()));
}

std::unique_ptr<ModalForce> ContactForce::modal_force(std::size_t patch) const {
  return as_coupled(force_of(patch, patch + 1));
}

std::unique_ptr<ModalForce> ContactForce::as_coupled(std::unique_ptr<ModalForce> force) const {
  if (effects_.mean_coupling) return force;
  return std::make_unique<VibrationAlone>(std::move(force));
}

std::unique_ptr<ModalForce> ContactForce::force_of(std::size_t begin, std::size_t end) const {
  const std::span patches(patches_.data() + begin, end - begin);
  const std::span points(points_.data() + begin, end - begin);
  Stack stack = stacked(patches, effects_);
  switch (method_for(patches_, effects_)) {  // of all: parts add up to the whole
    case Method::closed_form: {
      const auto make = [&](Stack all) -> std::unique_ptr<ModalForce> {
        return std::make_unique<PatchForce>(ContactPatch(all.weights, joined(points)),
                                            std::move(all.shapes));
      };
      const MotionCoordinates few = motion_of_points(stack.shapes);
      return seen_through(few, std::move(stack), make);
    }
    case Method::lanes: {
      const auto make = [&](Stack all) -> std::unique_ptr<ModalForce> {
        return std::make_unique<sampled::PatchForce>(std::move(all.weights), surfaces(begin, end),
                                                     std::move(all.shapes),
                                                     instants_of(patches_, effects_));
      };
      return seen_through(coordinates_, std::move(stack), make);
    }
    case Method::point_methods:
      break;
  }
  PointMethods methods;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    PointMethods own = methods_of(patches[i], patches[i].cells, effects_, points[i]);
    methods.insert(methods.end(), own.begin(), own.end());
  }
  const auto make = [&](Stack all) -> std::unique_ptr<ModalForce> {
    return std::make_unique<PointMethodForce>(std::move(all.weights), std::move(methods),
                                              std::move(all.shapes));
  };
  const MotionCoordinates few = motion_of_points(stack.shapes);
  return seen_through(few, std::move(stack), make);
}

std::vector<SurfaceLaw> ContactForce::surfaces(std::size_t begin, std::size_t end) const {
  std::vector<SurfaceLaw> all;
  for (std::size_t i = begin; i < end; ++i) {
    const auto own = surfaces_of(patches_[i], patches_[i].cells, effects_, points_[i]);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

std::unique_ptr<TransientForce> ContactForce::transient_force() const {
  Stack stack = stacked(patches_, effects_);
  if (!are_plain(patches_, effects_)) {
    return std::make_unique<PlanarTransient>(std::move(stack.weights), surfaces(0, patches_.size()),
                                             std::move(stack.shapes));
  }
  return std::make_unique<PatchTransient>(
      ContactPatch(stack.weights, joined(std::span(points_.data(), points_.size()))),
      std::move(stack.shapes));
}

ContactMap ContactForce::map(std::size_t index, Places places, const Harmonics& motion,
                             double frequency, int n_phases) const {
  const Harmonics q = effects_.mean_coupling ? motion : without_mean(motion);
  const Patch& patch = patches_[index];
  const PatchSamples& samples = places == Places::cells ? patch.cells : patch.vertices;
  const std::vector<PointParameters> points =
      places == Places::cells
          ? points_[index]
          : point_parameters(patch, samples, effects_, shared_load(patches_, load_)[index]);
  const ModalShapes shapes = simulated_shapes(samples.shapes, effects_);
  ContactMap map;
  if (method_for({&patch, 1}, effects_) == Method::closed_form) {
    map = contact_map(points, shapes, q, n_phases, patch.wear_coefficient);
  } else {
    map = contact_map(methods_of(patch, samples, effects_, points), shapes, q, frequency, n_phases,
                      patch.wear_coefficient);
    add_guards(map, surfaces_of(patch, samples, effects_, points), shapes, q, frequency);
  }
  map.friction_coefficient = samples.friction;
  return map;
}

RestingLoad ContactForce::at_rest() const {
  RestingLoad rest;
  bool presses = false;
  bool gapes = false;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    Eigen::VectorXd pressure(patches_[i].cells.size());
    for (Eigen::Index k = 0; k < pressure.size(); ++k) {
      pressure[k] = points_[i][static_cast<std::size_t>(k)].rest_load;
    }
    rest.carried += carried_force(pressure, patches_[i].cells.weights);
    rest.integral += patches_[i].cells.weights.dot(pressure);
    presses = presses || pressure.maxCoeff() > 0.0;
    gapes = gapes || pressure.minCoeff() < 0.0;
  }
  rest.partly_open = presses && gapes;
  return rest;
}

}  // namespace microslip::contact
