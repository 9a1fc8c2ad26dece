/// @file
/// Fuzzing of readers (libFuzzer): a damaged text is read, or refused by an error of the reader's
/// own. Anything else, another exception, a finding of a sanitizer, too much memory or time, ends
/// the process. share/scripts/fuzz.sh builds and runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace microslip::tests {

/// @tparam Refusal  what the reader may throw.
template <typename Refusal, typename Reader>
int read_or_refused(const std::uint8_t* data, std::size_t size, const Reader& reader) {
  try {
    reader(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const Refusal&) {  // NOLINT(bugprone-empty-catch): as it should
  }
  return 0;
}

}  // namespace microslip::tests
