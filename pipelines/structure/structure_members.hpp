/// @file
/// What the archive of bytes (system/byte_archive.hpp) is told of solved structures.
#pragma once

#include <tuple>

#include "pipelines/structure/structure_task.hpp"
#include "pipelines/system/byte_archive.hpp"

// Structured bindings name every member: one that is added and not kept does not compile.
namespace microslip::fem {

auto members(pipelines::Is<ModalBasis> auto& value) {
  auto& [frequency, shapes, residual, n_rigid_body, inertia_count, n_attachment] = value;
  return std::tie(frequency, shapes, residual, n_rigid_body, inertia_count, n_attachment);
}
auto members(pipelines::Is<RicherBasis> auto& value) {
  auto& [basis, embedding] = value;
  return std::tie(basis, embedding);
}
auto members(pipelines::Is<ResidualFlexibility> auto& value) {
  auto& [row_sums, displacements] = value;
  return std::tie(row_sums, displacements);
}
auto members(pipelines::Is<ModalTimings> auto& value) {
  auto& [assembly, factorisation, ordering, eigensolve, inertia] = value;
  return std::tie(assembly, factorisation, ordering, eigensolve, inertia);
}

}  // namespace microslip::fem

namespace microslip::contact {

auto members(pipelines::Is<ElasticFace> auto& value) {
  auto& [flexibility, approach] = value;
  return std::tie(flexibility, approach);
}

}  // namespace microslip::contact

namespace microslip::pipelines {

auto members(Is<StructureModes> auto& value) {
  auto& [n_dofs, mass, basis, residuals, attachment_text, notes, warnings, timings, richer, rotated,
         static_face] = value;
  return std::tie(n_dofs, mass, basis, residuals, attachment_text, notes, warnings, timings, richer,
                  rotated, static_face);
}

}  // namespace microslip::pipelines
