/// @file
/// An analytic expression of position, as users write it: "0.3 + 0.1*sin(40*p) - r^2".
///
/// Names: p, r [m], or others the caller gives to the coordinates; pi, e; constants of the caller;
/// functions sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp ln log (both to
/// base e) log2 log10 sqrt abs sign rint min max sum avg; operators + - * / ^, comparisons, && ||,
/// and `condition ? a : b`.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include <Eigen/Core>

namespace microslip::pipelines {

class Expression {
 public:
  /// @param text       the expression, at most 10 000 characters.
  /// @param place      what messages begin with, e.g. "scene.toml:12:
  ///                   contact.friction_coefficient".
  /// @param constants  further names and their values.
  /// @param coordinates  names of the two coordinates; an empty second one: there is only one.
  /// @throws SceneError  with the position (character, from 1) and the offending part; an unknown
  ///         name comes with the nearest known one and the list of them.
  Expression(const std::string& text, std::string place,
             const std::map<std::string, double>& constants = {},
             std::array<std::string, 2> coordinates = {"p", "r"});
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  /// n values. Safe to call from several threads.
  /// @param p, r  [m], n each.
  /// @throws SceneError  a value is not finite; names the place where.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string text_;
  std::string place_;
  std::array<std::string, 2> coordinates_;
};

}  // namespace microslip::pipelines
