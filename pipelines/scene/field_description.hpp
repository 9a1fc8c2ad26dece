/// @file
/// A quantity over a contact patch as a scene gives it: one number, an expression in p and r, or a table
/// { file = "mu.csv" } with the columns p, r [m] and value [SI].
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "contact/patch/position_table.hpp"
#include "pipelines/text/expression.hpp"
#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {

struct FieldExpression {
  std::string text;
};

struct FieldTable {
  std::filesystem::path file;  ///< absolute
};

/// What messages need: where it is written, and what values may be.
struct FieldDescription {
  std::variant<double, FieldExpression, FieldTable> value = 0.0;
  std::string place;        ///< e.g. "scene.toml:12: contact.friction_coefficient"
  double low = -unbounded;  ///< low ≤ value ≤ high everywhere
  double high = unbounded;

  [[nodiscard]] bool is_zero() const {
    const auto* number = std::get_if<double>(&value);
    return number != nullptr && *number == 0.0;
  }
};

/// The field ready for use: expressions parsed, tables read. Copies share what is inside, which does not
/// change.
class Field {
 public:
  /// @throws SceneError  an expression or table that cannot be read (see Expression, CsvTable), a column
  ///         missing, the same position twice, a number out of range.
  explicit Field(FieldDescription description);

  /// n values in the patch plane [SI]; tables are interpolated as PositionTable does.
  /// @param p, r  [m], n each.
  /// @throws SceneError  a value that is not finite or out of range; names the position.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;

 private:
  FieldDescription description_;
  // Shared: a Field is copied into callables, and both are immutable and may be large.
  std::shared_ptr<const Expression> expression_;
  std::shared_ptr<const contact::PositionTable> table_;
};

/// @param file  columns p, r, value, header required, any order and further columns allowed.
/// @throws SceneError  as CsvTable; a column missing; no rows; the same position twice.
[[nodiscard]] contact::PositionTable read_position_table(const std::filesystem::path& file);

}  // namespace microslip::pipelines
