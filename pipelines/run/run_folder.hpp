/// @file
/// A run folder as a place: who writes in it, and what of an earlier run is cleared away.
#pragma once

#include <filesystem>

namespace microslip::pipelines {

/// An advisory lock that dies with the process: two runs in one folder would mix their files.
/// @return its descriptor, for the owner to close.
/// @throws ExhaustedError  another run holds it, or nothing can be written there.
[[nodiscard]] int lock_folder(const std::filesystem::path& folder);

/// Whatever bears the name of a result is an earlier run's, or not ours to remove: a run begins with its
/// scene and its log.
/// @throws SceneError  the folder holds such a name and no run.
void require_own(const std::filesystem::path& folder);

/// Removes the results of an earlier run.
void clear_results(const std::filesystem::path& folder);

}  // namespace microslip::pipelines
