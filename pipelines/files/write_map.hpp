/// @file
/// Contact maps: what every point of the patch does over one period, for ParaView (one .vtp per
/// phase and a .pvd over them) and for scripts (one .h5 with everything).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "contact/patch.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// Writes into `folder` (created if missing), NAME being map.name:
///
/// - NAME_000.vtp …: the patch in world coordinates [m] at one phase, complete in itself. Arrays
///   (interfaces.md section 3): `state`, `normal_traction_Pa`, `friction_traction_Pa`,
///   `relative_displacement_m`, `approach_m`, `slip_m` and per cycle `dissipated_energy_J_per_m2`,
///   `slip_distance_m`, `wear_depth_m`; as cell data (values of the contact points, crisp colours)
///   and, where the map has vertices, as point data (smooth fields). For each state STATE of stick,
///   positive_slip, negative_slip, separation, slip (in two directions): `STATE_start_deg` where it
///   first begins (-1: never, or it lasts the whole period), `STATE_starts` how often it begins,
///   `STATE_share` of the period. Guards of the period `slip_guard_Pa`, `smallest_load_Pa`,
///   `largest_load_Pa`: their zero lines part points that stick throughout from those that slip,
///   that never open from those that do, that touch at times from those always open. Field arrays
///   `frequency_Hz`, `phase_deg`, `state_names`.
/// - NAME.pvd: the series; time is the phase in degrees, 0 … 360.
/// - NAME.h5: the same arrays over all phases (n × m), `/phase_deg`, every start of every state
///   (`/state_starts_deg`, n × 5k: k columns per state, -1 beyond its last), the transition fields
///   at the vertices (`/vertex_…`), and the patch in its plane:
///   `/points` (n × 2: p, r), `/vertices`, `/cells`.
///
/// All names with units and meaning: columns.hpp. A patch without cells gives one vertex per
/// contact point; one without positions puts the points in a row.
/// @return names of the files.
/// @throws std::invalid_argument  the map does not have one row per contact point (or vertex).
/// @throws ExhaustedError         cannot be written.
std::vector<std::string> write_map(const std::filesystem::path& folder, const contact::Patch& patch,
                                   const NamedMap& map);

}  // namespace microslip::pipelines
