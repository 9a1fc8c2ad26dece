/// @file
/// The mesher as the program starts it: an interrupt ends it, and so does a budget of time.
#pragma once

#include "mesh/mesh_error.hpp"
#include "mesh/mesher_process.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

/// @param work  starts the mesher with the limits it is given; its result is returned.
/// @throws InterruptedError  an interrupt was asked for.
/// @throws ExhaustedError    the budget of time leaves nothing to solve in.
template <typename Work>
auto with_mesher(const Work& work) {
  mesh::MesherLimits limits;
  limits.stop = [] { return interrupt_requested() || time_is_short(); };
  try {
    return work(limits);
  } catch (const mesh::MeshError&) {
    if (interrupt_requested()) throw InterruptedError("interrupted while meshing");
    if (time_is_short()) {
      throw ExhaustedError(
          "out of time: the mesh takes longer than the budget leaves for it; take larger elements, "
          "a "
          "mesh that is made already (kind \"mesh\"), or a longer budget");
    }
    throw;
  }
}

}  // namespace microslip::pipelines
