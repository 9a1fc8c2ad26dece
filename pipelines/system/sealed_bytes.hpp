/// @file
/// Bytes of an earlier run that another may read: a line that tells who wrote them,
/// their fingerprint, and they.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace microslip::pipelines {

/// The whole of a file; empty where it cannot be read, and of what is no file: a device may have no
/// end, a pipe would be used up.
[[nodiscard]] std::string bytes_of(const std::filesystem::path& file);

/// @param header  one line without its end: whoever reads it must have the same.
[[nodiscard]] std::string sealed(const std::string& header, std::string_view bytes);

struct Unsealed {
  std::string_view bytes;  ///< borrowed of what was given
  std::string fault;       ///< "damaged", or whose it is; empty: none
};

/// What sealed() was given, if `content` is whole and has the header.
[[nodiscard]] Unsealed unsealed(const std::string& header, std::string_view content);

}  // namespace microslip::pipelines
