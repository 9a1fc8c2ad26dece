/// @file
/// Which effects of contact a run simulates, and the contact force that simulates them: the closed form
/// of one harmonic and one direction where that is all a scene, or a motion, calls for, laws of single
/// points else.
#pragma once

#include <memory>
#include <vector>

#include "contact/modal_force.hpp"
#include "contact/point/point_law.hpp"
#include "contact/surface/surface_law.hpp"
#include "contact/transient_force.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Decides what `auto` in [effects] leaves open.
/// @param model  with its contact arrays.
[[nodiscard]] ContactEffects contact_effects(const ReducedModel& model, const SceneDescription& scene);

/// Whether the forces of a whole patch are sampled in time, in lanes (contact/sampled), instead of located event by
/// event: where several harmonics meet many points.
[[nodiscard]] bool is_sampled(const ReducedModel& model);

/// The contact of a model under a preload. @param load  as of point_parameters().
[[nodiscard]] std::unique_ptr<contact::ModalForce> contact_force(const ReducedModel& model, double load);

/// The same contact for integration in time; nullptr: the scene has none.
[[nodiscard]] std::unique_ptr<contact::TransientForce> transient_force(const ReducedModel& model,
                                                                       double load);

/// Surfaces of a contact point (or vertex) with a preload of its own.
/// @param point  constants, bodies in series included; its preload is taken as it is.
/// @param row    of the point in the model.
[[nodiscard]] contact::SurfaceLaw surface_of_point(const ReducedModel& model,
                                                   const contact::PointParameters& point,
                                                   Eigen::Index row, bool on_vertices);

/// That of each contact point, or of each vertex of the cells, under a load.
[[nodiscard]] std::vector<contact::SurfaceLaw> point_surfaces(const ReducedModel& model, double load,
                                                              bool on_vertices);

/// The law of each contact point, or of each vertex of the cells.
[[nodiscard]] std::vector<std::shared_ptr<const contact::PointLaw>> point_laws(
    const ReducedModel& model, double load, bool on_vertices);

/// Mode shapes as the simulated effects need them: without motion along r where it is left out.
[[nodiscard]] contact::ModalShapes simulated_shapes(const ReducedModel& model, bool on_vertices);

}  // namespace microslip::pipelines
