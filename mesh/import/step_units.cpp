#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "mesh/import/step_statements.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/step_geometry.hpp"
#include "mesh/text_file.hpp"

namespace microslip::mesh {
namespace {

namespace fs = std::filesystem;

void require_begin(std::string_view text, const fs::path& file) {
  constexpr std::string_view begin = "ISO-10303-21;";
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == text.npos || text.compare(first, begin.size(), begin) != 0) {
    throw MeshError(file.string() +
                    ": not a STEP file: it does not begin with \"ISO-10303-21;\"; export the "
                    "geometry as STEP (AP203, AP214 or AP242), in text");
  }
}

/// Of a file of any size: what is none in STEP is told before it is read whole.
std::string text_of(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw MeshError(file.string() + ": no such file");
  if (!fs::is_regular_file(file, error)) throw MeshError(file.string() + ": not a file");
  std::ifstream stream(file, std::ios::binary);
  std::string preface(4096, ' ');
  stream.read(preface.data(), static_cast<std::streamsize>(preface.size()));
  require_begin(preface, file);
  require_text(file);
  stream.clear();
  stream.seekg(0);
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

void require_end(const std::string& text, const fs::path& file) {
  constexpr std::string_view end = "END-ISO-10303-21;";
  constexpr std::size_t tail = 1000;  // comments may follow the mark
  if (text.find(end, text.size() - std::min(tail, text.size())) == text.npos) {
    throw MeshError(file.string() + ": the file ends before its end mark \"" + std::string(end) +
                    "\": it was cut off (" + std::to_string(text.size()) +
                    " bytes); export or copy it again");
  }
}

/// Statements by their number, without blanks; of those that hold one of the words.
class Statements {
 public:
  explicit Statements(std::string_view text) {
    std::string statement;
    bool quoted = false;
    for (const char c : text) {
      if (c == '\'') quoted = !quoted;
      if (c == ';' && !quoted) {
        keep(std::exchange(statement, {}));
      } else if (quoted || std::isspace(static_cast<unsigned char>(c)) == 0) {
        statement += c;
      }
    }
  }

  /// Empty: not there.
  [[nodiscard]] const std::string& at(int number) const {
    static const std::string none;
    const auto found = kept_.find(number);
    return found == kept_.end() ? none : found->second;
  }
  [[nodiscard]] const std::map<int, std::string>& all() const { return kept_; }

 private:
  void keep(const std::string& statement) {
    constexpr std::array<std::string_view, 3> words{"LENGTH_UNIT", "GLOBAL_UNIT_ASSIGNED_CONTEXT",
                                                    "LENGTH_MEASURE"};
    if (statement.empty() || statement.front() != '#') return;
    if (std::ranges::none_of(words,
                             [&](auto word) { return statement.find(word) != statement.npos; }))
      return;
    int number = 0;
    std::from_chars(statement.data() + 1, statement.data() + statement.size(), number);
    kept_[number] = statement.substr(statement.find('=') + 1);
  }

  std::map<int, std::string> kept_;
};

/// What stands between `before` and the next `after`; empty: nothing does.
std::string between(const std::string& text, std::string_view before, std::string_view after) {
  const std::size_t at = text.find(before);
  if (at == text.npos) return {};
  const std::size_t from = at + before.size();
  const std::size_t to = text.find(after, from);
  return to == text.npos ? std::string() : text.substr(from, to - from);
}

int number_in(std::string_view reference) {  // "#12"
  int number = 0;
  if (!reference.empty()) {
    std::from_chars(reference.data() + 1, reference.data() + reference.size(), number);
  }
  return number;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// SI_UNIT(.MILLI.,.METRE.)
std::optional<StepUnit> si_unit(const std::string& statement) {
  constexpr std::array<std::pair<std::string_view, double>, 7> prefixes{{{"", 1.0},
                                                                         {"milli", 1e-3},
                                                                         {"centi", 1e-2},
                                                                         {"deci", 1e-1},
                                                                         {"kilo", 1e3},
                                                                         {"micro", 1e-6},
                                                                         {"nano", 1e-9}}};
  if (statement.find(".METRE.") == statement.npos) return std::nullopt;
  const std::string prefix = lower(between(statement, "SI_UNIT(.", ".,"));
  const auto* found =
      std::ranges::find(prefixes, prefix, &std::pair<std::string_view, double>::first);
  if (found == prefixes.end()) return std::nullopt;
  return StepUnit{prefix + "metre", found->second};
}

/// A unit by its statement, through those it is defined by: CONVERSION_BASED_UNIT('INCH',#7), where
/// #7 is LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#8).
std::optional<StepUnit> unit_of(const Statements& statements, int number, int depth = 0) {
  constexpr int most_nested = 4;
  const std::string& statement = statements.at(number);
  if (statement.find("LENGTH_UNIT") == statement.npos || depth > most_nested) return std::nullopt;
  const std::string conversion = between(statement, "CONVERSION_BASED_UNIT(", ")");
  if (conversion.empty()) return si_unit(statement);
  const std::string& measure = statements.at(number_in(between(conversion + ')', ",", ")")));
  const std::string value = between(measure, "LENGTH_MEASURE(", ")");
  double factor = 0.0;
  std::from_chars(value.data(), value.data() + value.size(), factor);
  const auto base = unit_of(statements, number_in(between(measure, "),", ")")), depth + 1);
  if (!base || !(factor > 0.0)) return std::nullopt;
  return StepUnit{lower(between(conversion, "'", "'")), factor * base->metres};
}

}  // namespace

std::vector<StepUnit> step_length_units(const fs::path& file) {
  const std::string text = text_of(file);
  require_end(text, file);
  require_sound_statements(text, file);
  const Statements statements(text);
  std::vector<StepUnit> units;
  for (const auto& [number, statement] : statements.all()) {
    std::istringstream references(between(statement, "GLOBAL_UNIT_ASSIGNED_CONTEXT((", "))"));
    for (std::string reference; std::getline(references, reference, ',');) {
      const auto unit = unit_of(statements, number_in(reference));
      if (unit && std::ranges::find(units, *unit) == units.end()) units.push_back(*unit);
    }
  }
  return units;
}

}  // namespace microslip::mesh
