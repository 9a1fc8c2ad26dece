#include "pipelines/system/sealed_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "pipelines/system/byte_archive.hpp"

namespace microslip::pipelines {

std::string bytes_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return std::move(content).str();
}

std::string sealed(const std::string& header, std::string_view bytes) {
  ByteWriter sum;
  sum(fingerprint(bytes));
  std::string content = header + '\n' + sum.bytes();
  content += bytes;
  return content;
}

Unsealed unsealed(const std::string& header, std::string_view content) {
  if (!content.starts_with(header + '\n')) {
    constexpr std::size_t shown = 80;
    return {{},
            fmt::format("expected \"{}\", found \"{}\": another version or build has written it",
                        header, content.substr(0, std::min(content.find('\n'), shown)))};
  }
  content.remove_prefix(header.size() + 1);
  std::uint64_t sum = 0;
  if (content.size() < sizeof sum) return {{}, "damaged"};
  std::memcpy(&sum, content.data(), sizeof sum);
  content.remove_prefix(sizeof sum);
  if (sum != fingerprint(content)) return {{}, "damaged"};
  return {content, {}};
}

}  // namespace microslip::pipelines
