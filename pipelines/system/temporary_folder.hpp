/// @file
/// A folder for files nobody keeps.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

/// A folder that is gone when this is.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code none;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(none);
    std::string pattern = (parent / "microslip-XXXXXX").string();
    if (none || ::mkdtemp(pattern.data()) == nullptr) {
      throw ExhaustedError(
          "no temporary folder can be made: TMPDIR or /tmp is missing or not writable");
    }
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;  // a leftover in the temporary folder harms nobody
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace microslip::pipelines
