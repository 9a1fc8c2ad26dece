/// @file
/// Files that other programs write as text: what is none is told before it is read whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace microslip::mesh {

struct ZeroByte {
  std::uintmax_t offset = 0;  ///< in the file
  std::uintmax_t line = 1;    ///< it stands in
};

/// The first byte of value 0, which no text holds; reads a block at a time, up to there.
/// @throws MeshError  the file cannot be read.
[[nodiscard]] std::optional<ZeroByte> first_zero_byte(const std::filesystem::path& file);

/// @throws MeshError  a byte of value 0, with its line: a part of the file is damaged or missing.
void require_text(const std::filesystem::path& file);

}  // namespace microslip::mesh
