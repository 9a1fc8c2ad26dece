#include "pipelines/text/expression.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <muParser.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/nearest_name.hpp"

namespace microslip::pipelines {

struct Expression::Parser {
  mu::Parser parser;
};

namespace {

constexpr std::size_t longest_expression = 10000;

std::vector<std::string_view> known_names(const mu::Parser& parser) {
  std::vector<std::string_view> names;
  for (const auto& [name, address] : parser.GetVar()) {
    names.push_back(name);
  }
  for (const auto& [name, value] : parser.GetConst()) {
    if (!name.starts_with('_')) {  // the library's own _pi and _e
      names.push_back(name);
    }
  }
  for (const auto& [name, function] : parser.GetFunDef()) {
    names.push_back(name);
  }
  return names;
}

// The first '=' that assigns instead of comparing; text.size() without one.
std::size_t assignment_in(const std::string& text) {
  constexpr std::string_view before = "=<>!";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') {
      continue;
    }
    const bool compares = i > 0 && before.find(text[i - 1]) != std::string_view::npos;
    if (!compares && (i + 1 == text.size() || text[i + 1] != '=')) {
      return i;
    }
  }
  return text.size();
}

std::string unknown_name(const mu::Parser& parser, const std::string& token) {
  const std::vector<std::string_view> names = known_names(parser);
  const std::string nearest = nearest_name(token, names);
  return fmt::format("\"{}\" is not known{}; known are {}", token,
                     nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest),
                     fmt::join(names, ", "));
}

// The message without its position, which the library counts from 0, and without the blank it adds
// to tokens.
std::string in_our_count(const std::string& message) {
  static const std::regex position(" (found )?at (expression )?position [0-9]+|[.]$");
  static const std::regex token("\"([^\"]*[^\" ]) +\"");
  return std::regex_replace(std::regex_replace(message, position, ""), token, "\"$1\"");
}

// The library's words; what it does not know gets ours.
[[noreturn]] void refuse(const mu::Parser& parser, const std::string& text,
                         const std::string& place, const mu::ParserError& error) {
  const bool is_name = error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !error.GetToken().empty() &&
                       (std::isalpha(static_cast<unsigned char>(error.GetToken()[0])) != 0 ||
                        error.GetToken()[0] == '_');
  const std::string what =
      is_name ? unknown_name(parser, error.GetToken()) : in_our_count(error.GetMsg());
  const auto end = static_cast<int>(text.size());
  const int position = std::clamp(error.GetPos() + 1, 1, end + 1);
  throw SceneError(fmt::format(
      "{}: expression \"{}\", {}: {}", place, text,
      fmt::format("character {}{}", position, position > end ? ", its end" : ""), what));
}

void define(mu::Parser& parser, const std::string& place,
            const std::map<std::string, double>& constants) {
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineConst("e", std::numbers::e);
  for (const auto& [name, value] : constants) {
    try {
      parser.DefineConst(name, value);
    } catch (const mu::ParserError& error) {
      throw SceneError(fmt::format("{}: constant \"{}\": {}", place, name, error.GetMsg()));
    }
  }
}

// Variables are bound by address. (Not named bind: std::bind would be found first.)
void set_coordinates(mu::Parser& parser, const std::array<std::string, 2>& names, double& first,
                     double& second) {
  parser.DefineVar(names[0], &first);
  if (!names[1].empty()) {
    parser.DefineVar(names[1], &second);
  }
}

void require_writable(const std::string& text, const std::string& place) {
  if (text.size() > longest_expression) {
    throw SceneError(fmt::format("{}: expression of {} characters; at most {}", place, text.size(),
                                 longest_expression));
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw SceneError(fmt::format("{}: expression \"{}\": is empty", place, text));
  }
  const std::size_t assignment = assignment_in(text);
  if (assignment < text.size()) {
    throw SceneError(
        fmt::format("{}: expression \"{}\", character {}: nothing is assigned here; == compares",
                    place, text, assignment + 1));
  }
}

}  // namespace

Expression::Expression(const std::string& text, std::string place,
                       const std::map<std::string, double>& constants,
                       std::array<std::string, 2> coordinates)
    : parser_(std::make_unique<Parser>()),
      text_(text),
      place_(std::move(place)),
      coordinates_(std::move(coordinates)) {
  require_writable(text, place_);
  mu::Parser& parser = parser_->parser;
  define(parser, place_, constants);
  double p = 0.0;
  double r = 0.0;
  try {
    set_coordinates(parser, coordinates_, p, r);
    parser.SetExpr(text);
    int n_values = 0;
    (void)parser.Eval(n_values);
    if (n_values != 1) {
      throw SceneError(
          fmt::format("{}: expression \"{}\" has {} values, separated by commas; one is "
                      "expected",
                      place_, text, n_values));
    }
  } catch (const mu::ParserError& error) {
    refuse(parser, text, place_, error);
  }
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

Eigen::VectorXd Expression::at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  mu::Parser parser = parser_->parser;  // a copy of its own: variables are bound by address
  double p_here = 0.0;
  double r_here = 0.0;
  set_coordinates(parser, coordinates_, p_here, r_here);
  Eigen::VectorXd values(p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    p_here = p[i];
    r_here = r[i];
    values[i] = parser.Eval();
    if (!std::isfinite(values[i])) {
      const std::string second =
          coordinates_[1].empty() ? "" : fmt::format(", {} = {} m", coordinates_[1], r_here);
      throw SceneError(fmt::format("{}: expression \"{}\" is {} at {} = {} m{}", place_, text_,
                                   values[i], coordinates_[0], p_here, second));
    }
  }
  return values;
}

}  // namespace microslip::pipelines
