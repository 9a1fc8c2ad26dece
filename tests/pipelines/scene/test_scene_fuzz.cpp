// Scenes that are damaged in ways nobody thought of: read, or refused with their place, never
// anything else.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "pipelines/scene/scene_file.hpp"
#include "pipelines/scene/scene_template.hpp"
#include "pipelines/system/scene_error.hpp"
#include "tests/support/campaign.hpp"

namespace microslip::pipelines::test_scene_fuzz {
namespace {

constexpr std::array kinds{"blade", "modal", "bar", "chain",
                           "block"};  // a mesh file would be missing

constexpr std::array values{"nan",
                            "-inf",
                            "1e400",
                            "-1e400",
                            "1e-400",
                            "0",
                            "-1",
                            "-0.0",
                            "1e308",
                            "5e-324",
                            "9223372036854775807",
                            "99999999999999999999",
                            "0x7fffffff",
                            "true",
                            "1979-05-27",
                            "''",
                            "\"x\"",
                            "\"5 Hz\"",
                            "\"1 parsec\"",
                            "\"-5 %\"",
                            "\"1e999 m\"",
                            "\"nan\"",
                            "\"1/0\"",
                            "\"(1+2\"",
                            "\"10^400\"",
                            "\"\\u0000\"",
                            "\"ünï\"",
                            "\"/\"",
                            "\"../../x\"",
                            "[]",
                            "{}",
                            "[[]]",
                            "[1, \"a\"]",
                            "[nan, 2]",
                            "[0, 0, 0]",
                            "[1e200, 0, 0]",
                            "[2, 1e400]",
                            "{ a = 1 }",
                            "{ file = \"none.csv\" }",
                            "{ file = \"/\" }",
                            "{ law = \"x\" }",
                            "{ law = \"exponential\" }",
                            "{ expression = \"1/0\" }",
                            "{ alpha = 1, beta = nan }"};

constexpr std::array pieces{"\xef\xbb\xbf", "\r\n", "\xff\xfe", "€", "[",           "{",
                            "\"",           "'''",  "#",        "=", "[[model]]\n", "[model]\n"};

using Random = std::mt19937;

std::size_t below(std::size_t n, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

template <typename List>
std::string one_of(const List& list, Random& random) {
  return list[below(list.size(), random)];
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Another value, a key that is missing, twice or misspelt, or a section that is gone.
std::string with_another_line(const std::string& text, Random& random) {
  std::vector<std::string> lines = lines_of(text);
  std::size_t at = below(lines.size(), random);
  while (lines[at].find('=') == std::string::npos) at = below(lines.size(), random);
  std::string& line = lines[at];
  if (line.starts_with("# ")) line.erase(0, 2);
  switch (below(5, random)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), std::string(line));
      break;
    case 2:
      line.insert(line.begin() + 1, 'x');
      break;
    default:
      line = line.substr(0, line.find('=') + 1) + " " + one_of(values, random);
  }
  return joined(lines);
}

/// Other bytes, a piece that is missing, twice or foreign, or an end that is too early.
std::string with_other_bytes(std::string text, Random& random) {
  const std::size_t at = below(text.size(), random);
  const std::size_t length = std::min(1 + below(40, random), text.size() - at);
  switch (below(5, random)) {
    case 0:
      text[at] = static_cast<char>(below(256, random));
      return text;
    case 1:
      return text.erase(at, length);
    case 2:
      return text.insert(at, text.substr(at, length));
    case 3:
      return text.insert(at, one_of(pieces, random));
    default:
      return text.substr(0, at);
  }
}

/// Words of libraries and languages, which are no help to a user.
bool is_raw(std::string_view message) {
  constexpr std::array words{"std::", "toml::", "basic_string", "vector::", "bad_alloc",
                             "stoi",  "what()", "exception",    "_M_range", "regex"};
  return std::ranges::any_of(
      words, [&](const char* word) { return message.find(word) != std::string_view::npos; });
}

TEST(SceneFuzz, ADamagedSceneIsReadOrRefusedWithItsPlace) {
  Random random(11);
  const int n = tests::campaign_size(10000);
  int refused = 0;
  for (int i = 0; i < n; ++i) {
    const std::string whole = scene_template(one_of(kinds, random));
    const bool lines = below(2, random) == 0;
    const std::string text =
        lines ? with_another_line(whole, random) : with_other_bytes(whole, random);
    try {
      static_cast<void>(parse_scene(text, "scene.toml", "/nowhere", {}));
    } catch (const std::exception& error) {
      ++refused;
      const std::string message = error.what();
      const bool own = dynamic_cast<const SceneError*>(&error) != nullptr ||
                       dynamic_cast<const RefusedError*>(&error) != nullptr;
      EXPECT_TRUE(own) << message << "\n" << text;
      EXPECT_FALSE(is_raw(message)) << message;
      EXPECT_TRUE(message.starts_with("scene.toml:") || message.starts_with("/"))
          << message;  // or a file it names
      if (HasFailure()) break;
    }
  }
  EXPECT_GT(refused, n / 3);  // else the damage would be none
  EXPECT_LT(refused, n);
}

}  // namespace
}  // namespace microslip::pipelines::test_scene_fuzz
