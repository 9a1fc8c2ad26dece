/// @file
/// The mesher as the program starts it: an interrupt ends it.
#pragma once

#include "mesh/mesh_error.hpp"
#include "mesh/mesher_process.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

/// @param work  starts the mesher with the limits it is given; its result is returned.
/// @throws InterruptedError  an interrupt was asked for.
template <typename Work>
auto with_mesher(const Work& work) {
  mesh::MesherLimits limits;
  limits.stop = interrupt_requested;
  try {
    return work(limits);
  } catch (const mesh::MeshError&) {
    if (interrupt_requested()) throw InterruptedError("interrupted while meshing");
    throw;
  }
}

}  // namespace microslip::pipelines
