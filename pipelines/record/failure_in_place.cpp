#include "pipelines/record/failure_in_place.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

constexpr std::string_view no_room_message =
    "this could not be written anew (no room?); what was written before is kept";
static_assert(no_room_message.size() <= unfinished_message.size());

/// Of equal length, or nothing.
void replace_in(std::string& text, const std::string& before, std::string after) {
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos) return;
  after.resize(before.size(), ' ');  // blanks behind the value
  text.replace(begin, before.size(), after);
}

}  // namespace

void tell_failure_in_place(const std::filesystem::path& summary, ExitCode code) {
  std::fstream file(summary, std::ios::in | std::ios::out | std::ios::binary);
  const std::string before(std::istreambuf_iterator<char>(file), {});
  std::string text = before;
  const auto entry = [](ExitCode of_run) {
    return fmt::format("\"exit_code\": {},", static_cast<int>(of_run));
  };
  replace_in(text, entry(ExitCode::incomplete), entry(code));
  replace_in(text, fmt::format("\"{}\"", unfinished_message),
             fmt::format("\"{}\"", no_room_message));
  const auto [first, ignored] = std::ranges::mismatch(text, before);
  const auto last =
      std::ranges::mismatch(text.rbegin(), text.rend(), before.rbegin(), before.rend()).in1.base();
  if (first >= last) return;
  file.clear();
  file.seekp(first - text.begin());
  file.write(&*first, last - first);
}

}  // namespace microslip::pipelines
