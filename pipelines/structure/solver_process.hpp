/// @file
/// A structure solved in a process of its own, beside what this one solves: the libraries of fem/
/// belong to one thread of a process. The other is the program itself, which is told by files.
#pragma once

#include <filesystem>

#include "pipelines/structure/structure_task.hpp"

namespace microslip::pipelines {

/// The first word of its command line; the files of the task and of its modes follow.
inline constexpr const char* solver_word = "solve-task";

/// The program that lies beside the mesher. @throws mesh::MeshError  there is no mesher.
[[nodiscard]] std::filesystem::path solver_program();

/// With one thread of BLAS; from any thread of this process. Ends with an interrupt of it.
/// @param program  as solver_program().
/// @throws InterruptedError
/// @throws std::runtime_error  it cannot be started or has failed, with what it said last.
[[nodiscard]] StructureModes solve_in_process(const StructureTask& task,
                                              const std::filesystem::path& program);

/// What the other process does; it dies with whoever started it.
/// @throws SceneError  the file holds no task of this program. @throws as solve().
void solve_task_file(const std::filesystem::path& task_file,
                     const std::filesystem::path& modes_file);

}  // namespace microslip::pipelines
