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

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What has changed, in one piece.
void write_over(const std::filesystem::path& file, std::string_view before,
                std::string_view after) {
  const auto [first, ignored] = std::ranges::mismatch(after, before);
  const auto last =
      std::ranges::mismatch(after.rbegin(), after.rend(), before.rbegin(), before.rend())
          .in1.base();
  if (before.size() != after.size() || first >= last) return;
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(first - after.begin());
  stream.write(&*first, last - first);
}

/// Of a key of the whole document: where its value begins, and where the line ends.
struct JsonLine {
  std::size_t begin = std::string::npos;
  std::size_t end = std::string::npos;
  explicit operator bool() const { return begin != std::string::npos; }
};

JsonLine entry_of(const std::string& text, const std::string& key) {
  const std::string name = fmt::format("\n  \"{}\": ", key);
  const std::size_t found = text.find(name);
  if (found == std::string::npos) return {};
  return {found + name.size(), text.find('\n', found + 1)};
}

/// The message of a run that did not begin, and what stood there; as long as that with its blanks.
std::string failed_start_over(const std::string& message, char code) {
  const std::string known = message.substr(0, message.find_last_of(',') + 1);
  std::string text = fmt::format(
      "\"no room; nothing was solved: what stands here is of an earlier run, which ended with exit "
      "code {0}\", \"earlier\": {{\"exit_code\": {0}, \"message\": {1}}},",
      code, known.substr(0, known.size() - 1));
  if (known.empty() || text.size() > message.size()) return message;
  text.resize(message.size(), ' ');
  return text;
}

}  // namespace

void tell_failure_in_place(const std::filesystem::path& summary, ExitCode code) {
  const std::string before = text_of(summary);
  std::string text = before;
  const auto entry = [](ExitCode of_run) {
    return fmt::format("\"exit_code\": {},", static_cast<int>(of_run));
  };
  replace_in(text, entry(ExitCode::incomplete), entry(code));
  replace_in(text, fmt::format("\"{}\"", unfinished_message),
             fmt::format("\"{}\"", no_room_message));
  write_over(summary, before, text);
}

void tell_failed_start_in_place(const std::filesystem::path& summary) {
  const std::string before = text_of(summary);
  std::string text = before;
  const JsonLine code = entry_of(text, "exit_code");
  const JsonLine message = entry_of(text, "message");
  if (!code || !message) return;
  const std::string known = text.substr(message.begin, message.end - message.begin);
  const bool is_first =
      known.find("\"earlier\": ") == std::string::npos && !entry_of(text, "earlier");
  if (is_first)
    text.replace(message.begin, known.size(), failed_start_over(known, text[code.begin]));
  text[code.begin] = static_cast<char>('0' + static_cast<int>(ExitCode::exhausted));
  write_over(summary, before, text);
}

}  // namespace microslip::pipelines
