/// @file
/// A folder for files nobody keeps.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "pipelines/scene_error.hpp"

namespace microslip::pipelines {

/// A folder that is gone when this is.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "microslip-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw ExhaustedError("no temporary folder can be made in " +
                           std::filesystem::temp_directory_path().string());
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
