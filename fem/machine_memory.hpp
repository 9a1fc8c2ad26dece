/// @file
/// How much memory there is, asked before it is taken: the system would end the program without a
/// word, not refuse an allocation.
#pragma once

namespace microslip::fem {

/// Memory the machines of all ranks can still give without swapping [MB]; the same on every rank.
/// Infinite where the system does not say. Collective over PETSC_COMM_WORLD.
[[nodiscard]] double available_memory_mb();

}  // namespace microslip::fem
