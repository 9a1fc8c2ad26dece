/// @file
/// A job for microslip-mesher: its text, and the child that does it.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>

#include "mesh/mesher_process.hpp"

namespace microslip::mesh {

/// An empty text whose numbers will be read as they were.
[[nodiscard]] std::ostringstream job_text();

/// Has the mesher do a job (mesher_main.cpp) that writes `file`, whole or not at all.
/// @throws MeshError  as mesh_blade().
void run_mesher(const std::string& job, const std::filesystem::path& file,
                const MesherLimits& limits);

}  // namespace microslip::mesh
