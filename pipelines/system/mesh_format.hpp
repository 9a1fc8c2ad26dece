/// @file
/// Files of meshes and modes by their ending.
#pragma once

#include <filesystem>
#include <string>

namespace microslip::pipelines {

/// converted: by share/scripts/convert_mesh.py.
enum class MeshFormat { gmsh, converted, unknown };

/// Of the name, in small letters: ".inp".
[[nodiscard]] std::string ending_of(const std::filesystem::path& file);

/// By the ending of the name, in capitals or not.
[[nodiscard]] MeshFormat mesh_format(const std::filesystem::path& file);

/// Whether its name ends in .step or .stp, in capitals or not.
[[nodiscard]] bool is_step_file(const std::filesystem::path& file);

/// Bulk data of Nastran: .bdf, .nas, .fem, in capitals or not.
[[nodiscard]] bool is_nastran_deck(const std::filesystem::path& file);

/// What Nastran punches: .pch, in capitals or not.
[[nodiscard]] bool is_punch_file(const std::filesystem::path& file);

/// The mesh of a file of modes where none is named: the deck of that name beside it, or the file
/// itself; empty: none is there.
[[nodiscard]] std::filesystem::path mesh_beside(const std::filesystem::path& modes);

/// ".msh, .inp, …", for messages.
[[nodiscard]] std::string mesh_endings();

}  // namespace microslip::pipelines
