/// @file
/// The structure for ParaView: its modes on the mesh, and its motion over one period.
#pragma once

#include <filesystem>
#include <string>

#include "contact/harmonics.hpp"
#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"

namespace microslip::pipelines {

/// modes.vtu: the mesh with its quadratic cells; point arrays `mode_1 … mode_N` (3 components,
/// mass-normalised, 1/√kg); field array `frequency_Hz`. `surface_NAME` and `set_NAME` are 1 at the
/// nodes of the named surfaces and node sets, else 0.
/// @throws ExhaustedError  cannot be written.
void write_modes_vtu(const std::filesystem::path& file, const mesh::Mesh& mesh,
                     const fem::ModalBasis& basis);

/// The motion x(θ) = Φ q(θ) over one period as `folder`/NAME.pvd with one .vtp per phase: the
/// corner nodes of the outer faces, `displacement_m` (3 components). Time is the phase in degrees,
/// 0 … 360; warp by `displacement_m` with a scale to see it.
///
/// @param folder    created if missing.
/// @param q         a solution [m√kg], one signal per mode of `basis`.
/// @param n_phases  frames per period, ≥ 1.
/// @return names of the files.
/// @throws ExhaustedError  cannot be written.
std::vector<std::string> write_motion(const std::filesystem::path& folder, const std::string& name,
                                      const mesh::Mesh& mesh, const fem::ModalBasis& basis,
                                      const contact::Harmonics& q, double frequency_hz,
                                      int n_phases = 24);

}  // namespace microslip::pipelines
