#include "pipelines/expression.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace microslip::pipelines {
namespace {

using Function = double (*)(double);
constexpr int deepest = 200;  // brackets within brackets: no formula needs more, a stack could not take any

const std::array<std::pair<std::string_view, Function>, 7>& functions() {
  static const std::array<std::pair<std::string_view, Function>, 7> known{{
      {"sqrt", [](double x) { return std::sqrt(x); }},
      {"exp", [](double x) { return std::exp(x); }},
      {"log", [](double x) { return std::log(x); }},
      {"sin", [](double x) { return std::sin(x); }},
      {"cos", [](double x) { return std::cos(x); }},
      {"tan", [](double x) { return std::tan(x); }},
      {"abs", [](double x) { return std::abs(x); }},
  }};
  return known;
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

/// One descent through the grammar of the header; every method leaves its value on the stack of steps.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const std::vector<std::string>& variables,
                   std::vector<Expression::Step>& steps)
      : text_(text), variables_(variables), steps_(steps) {}

  void all() {
    sum();
    if (peek() != '\0') fail(fmt::format("\"{}\" is out of place", peek()));
  }

 private:
  using Operation = Expression::Operation;

  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ExpressionError(fmt::format("\"{}\", character {}: {}", text_, at_ + 1, message));
  }

  void put(Operation operation) { steps_.push_back({operation, 0.0, 0, nullptr}); }

  void sum() {
    if (++depth_ > deepest) fail("too many brackets");
    product();
    for (;;) {
      if (take('+')) {
        product();
        put(Operation::add);
      } else if (take('-')) {
        product();
        put(Operation::subtract);
      } else {
        break;
      }
    }
    --depth_;
  }

  void product() {
    power();
    for (;;) {
      if (take('*')) {
        power();
        put(Operation::multiply);
      } else if (take('/')) {
        power();
        put(Operation::divide);
      } else {
        return;
      }
    }
  }

  void power() {
    if (++depth_ > deepest) fail("too many signs or powers");
    if (take('-')) {
      power();
      put(Operation::negate);
    } else if (take('+')) {
      power();
    } else {
      atom();
      if (take('^')) {
        power();
        put(Operation::power);
      }
    }
    --depth_;
  }

  void atom() {
    const char c = peek();
    if (take('(')) {
      sum();
      if (!take(')')) fail("expected \")\"");
    } else if (is_digit(c) || c == '.') {
      number();
    } else if (is_letter(c)) {
      name();
    } else {
      fail(c == '\0' ? "ends too early" : fmt::format("\"{}\" is out of place", c));
    }
  }

  void number() {
    double value = 0.0;
    const auto [end, code] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (code != std::errc()) fail("not a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    steps_.push_back({Operation::constant, value, 0, nullptr});
  }

  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    const auto variable = std::find(variables_.begin(), variables_.end(), word);
    if (variable != variables_.end()) {
      const auto index = static_cast<std::size_t>(variable - variables_.begin());
      steps_.push_back({Operation::variable, 0.0, index, nullptr});
    } else if (word == "pi") {
      steps_.push_back({Operation::constant, std::numbers::pi, 0, nullptr});
    } else {
      at_ = begin;
      call(word);
    }
  }

  void call(std::string_view word) {
    const auto& known = functions();
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto& entry) { return entry.first == word; });
    if (found == known.end()) {
      fail(fmt::format("\"{}\" is not known here; known: {}, pi, and sqrt, exp, log, sin, cos, tan, "
                       "abs of a bracket",
                       word, fmt::join(variables_, ", ")));
    }
    at_ += word.size();
    if (!take('(')) fail(fmt::format("expected \"(\" after {}", word));
    sum();
    if (!take(')')) fail("expected \")\"");
    steps_.push_back({Operation::call, 0.0, 0, found->second});
  }

  std::string_view text_;
  const std::vector<std::string>& variables_;
  std::vector<Expression::Step>& steps_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(std::string_view text, std::vector<std::string> variables)
    : n_variables_(variables.size()) {
  ExpressionParser(text, variables, steps_).all();
}

double Expression::operator()(std::span<const double> values) const {
  if (values.size() != n_variables_) {
    throw std::invalid_argument(
        fmt::format("expression: {} values for {} variables", values.size(), n_variables_));
  }
  std::vector<double> stack;
  const auto pop = [&] {
    const double value = stack.back();
    stack.pop_back();
    return value;
  };
  for (const Step& step : steps_) {
    if (step.operation == Operation::constant) {
      stack.push_back(step.constant);
      continue;
    }
    if (step.operation == Operation::variable) {
      stack.push_back(values[step.variable]);
      continue;
    }
    const double right = pop();
    switch (step.operation) {
      case Operation::negate: stack.push_back(-right); break;
      case Operation::call: stack.push_back(step.function(right)); break;
      case Operation::add: stack.back() += right; break;
      case Operation::subtract: stack.back() -= right; break;
      case Operation::multiply: stack.back() *= right; break;
      case Operation::divide: stack.back() /= right; break;
      default: stack.back() = std::pow(stack.back(), right); break;
    }
  }
  return stack.back();
}

}  // namespace microslip::pipelines
