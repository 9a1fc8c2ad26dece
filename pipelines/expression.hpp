/// @file
/// A formula as users write it, "2000*(0.2 + 0.8*(2*x/L - 1)^2)": parsed once, evaluated often.
///
///   sum     = product { ("+" | "-") product }
///   product = power { ("*" | "/") power }
///   power   = ["-" | "+"] atom ["^" power]          −x^2 is −(x²), 2^3^2 is 2^9
///   atom    = number | name | function "(" sum ")" | "(" sum ")"
///
/// Functions: sqrt, exp, log, sin, cos, tan, abs. The name pi is known everywhere.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace microslip::pipelines {

/// What is wrong with a formula, and at which character (from 1).
class ExpressionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Expression {
 public:
  /// @param text       the formula.
  /// @param variables  names it may use.
  /// @throws ExpressionError  it cannot be read, or uses another name.
  Expression(std::string_view text, std::vector<std::string> variables);

  /// @param values  of the variables, in their order.
  /// @return the value; not finite where the formula is not (1/0, sqrt(-1)).
  [[nodiscard]] double operator()(std::span<const double> values) const;

 private:
  friend class ExpressionParser;
  using Function = double (*)(double);
  enum class Operation { constant, variable, add, subtract, multiply, divide, power, negate, call };
  struct Step {
    Operation operation = Operation::constant;
    double constant = 0.0;
    std::size_t variable = 0;
    Function function = nullptr;
  };
  std::vector<Step> steps_;  // in reverse Polish order
  std::size_t n_variables_ = 0;
};

}  // namespace microslip::pipelines
