/// @file
/// What the archive of bytes (system/byte_archive.hpp) is told of reduced models, and of the
/// settings that their curves follow.
#pragma once

#include <tuple>

#include "pipelines/description/discretisation.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/system/byte_archive.hpp"

// Structured bindings name every member: one that is added and not kept does not compile.
namespace microslip {
using pipelines::Is;

namespace contact {
auto members(Is<ContactEffects> auto& value) {
  auto& [n_harmonics, normal_motion, mean_coupling, second_direction, located, sampled,
         force_tolerance, doublings, motion_ratio] = value;
  return std::tie(n_harmonics, normal_motion, mean_coupling, second_direction, located, sampled,
                  force_tolerance, doublings, motion_ratio);
}
auto members(Is<MotionCoordinates> auto& value) {
  auto& [of_modes, motion] = value;
  return std::tie(of_modes, motion);
}
auto members(Is<ModalShapes> auto& value) {
  auto& [u, v, w] = value;
  return std::tie(u, v, w);
}
auto members(Is<PatchSamples> auto& value) {
  auto& [points, weights, shapes, stiffness, friction, preload_field, compliance, slip_directions,
         normals] = value;
  return std::tie(points, weights, shapes, stiffness, friction, preload_field, compliance,
                  slip_directions, normals);
}
auto members(Is<TiltedArea> auto& value) {
  auto& [key, begin, p, r, share, moment] = value;
  return std::tie(key, begin, p, r, share, moment);
}
auto members(Is<SurfaceRules> auto& value) {
  auto& [friction, roughness, tangential_stiffness, normal_stiffness] = value;
  return std::tie(friction, roughness, tangential_stiffness, normal_stiffness);
}
auto members(Is<Patch> auto& value) {
  auto& [name, frame, off_plane, cells, vertices, connectivity, fit_degree, fit_error, measure,
         share, tilted_areas, rules, wear_coefficient] = value;
  return std::tie(name, frame, off_plane, cells, vertices, connectivity, fit_degree, fit_error,
                  measure, share, tilted_areas, rules, wear_coefficient);
}
}  // namespace contact

namespace pipelines {
auto members(Is<HarmonicSettings> auto& value) {
  auto& [highest, orders, tolerance, checked, or_one] = value;
  return std::tie(highest, orders, tolerance, checked, or_one);
}
auto members(Is<ReducedModel> auto& value) {
  auto& [frequency, n_attachment, damping, sine, cosine, force_static, output, patches, preload,
         variation, effects, coordinates] = value;
  return std::tie(frequency, n_attachment, damping, sine, cosine, force_static, output, patches,
                  preload, variation, effects, coordinates);
}
}  // namespace pipelines
}  // namespace microslip
