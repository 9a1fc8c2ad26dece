#include "mesh/text_file.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/mesh_error.hpp"

namespace microslip::mesh {

std::optional<ZeroByte> first_zero_byte(const std::filesystem::path& file) {
  constexpr std::size_t block = std::size_t{1} << 20U;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw MeshError(file.string() + ": cannot be read");
  std::vector<char> bytes(block);
  ZeroByte place;
  while (stream.good()) {
    stream.read(bytes.data(), static_cast<std::streamsize>(block));
    const auto size = static_cast<std::size_t>(stream.gcount());
    const auto* found = static_cast<const char*>(std::memchr(bytes.data(), 0, size));
    const char* end = found != nullptr ? found : bytes.data() + size;
    place.offset += static_cast<std::uintmax_t>(end - bytes.data());
    place.line += static_cast<std::uintmax_t>(std::count<const char*>(bytes.data(), end, '\n'));
    if (found != nullptr) return place;
  }
  return std::nullopt;
}

void require_text(const std::filesystem::path& file) {
  const std::optional<ZeroByte> zero = first_zero_byte(file);
  if (!zero) return;
  throw MeshError(file.string() + ':' + std::to_string(zero->line) +
                  ": a byte of value 0, as no text holds (byte " + std::to_string(zero->offset) +
                  " of the file): a part of it is damaged or missing; copy or export it again");
}

}  // namespace microslip::mesh
