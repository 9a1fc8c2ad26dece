/// @file
/// Files that are there whole or not at all: written beside their place, then renamed into it.
/// Every writer goes through here, so that a full disk or a folder without permission is told in
/// one way: an ExhaustedError that names the path.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace microslip::pipelines {

/// What is asked for as a folder can be one: no file stands there, or on the way to it.
/// @param option  that names it, for the message.
/// @throws SceneError  a file does; the message names it.
///         What cannot be looked at is told when it is written.
void require_folder_name(const std::filesystem::path& folder, const std::string& option);

/// What is asked for as a file can be one: its folder is there, and no folder stands in its place.
/// @throws SceneError  otherwise.
void require_file_name(const std::filesystem::path& file, const std::string& option);

/// Writes `content` to a temporary file in the same folder and renames it to `file`. An older
/// `file` stays as it was until the new one is complete; nothing is left behind on failure. A link
/// is followed, and a device or pipe, such as /dev/stdout, is written to as it is:
/// a rename would put a file in its place.
/// @throws ExhaustedError  the folder is missing, not writable or full; names path and reason.
void write_whole(const std::filesystem::path& file, std::string_view content);

/// Bytes of a binary file, otherwise the same.
void write_whole(const std::filesystem::path& file, std::span<const std::byte> content);

/// Creates a folder and its parents where they are missing.
/// @throws ExhaustedError  it cannot be created or is not a folder.
void make_folder(const std::filesystem::path& folder);

/// A folder, made and looked at for whether it can be written in before long work. At its end it is
/// removed where nothing was written, with those on the way to it that were made for it.
class FolderToFill {
 public:
  /// @throws ExhaustedError  as make_folder() and require_writable().
  explicit FolderToFill(const std::filesystem::path& folder);
  FolderToFill(const FolderToFill&) = delete;
  FolderToFill& operator=(const FolderToFill&) = delete;
  FolderToFill(FolderToFill&&) = delete;
  FolderToFill& operator=(FolderToFill&&) = delete;
  ~FolderToFill();

 private:
  std::vector<std::filesystem::path> made_;  ///< from the folder up
};

/// @throws ExhaustedError  no file can be created in `folder` (which must exist): asked before the
///         long stages, not after them.
void require_writable(const std::filesystem::path& folder);

/// The shortest decimal text that reads back to the same double, with a point in any locale.
[[nodiscard]] std::string format_number(double value);

}  // namespace microslip::pipelines
