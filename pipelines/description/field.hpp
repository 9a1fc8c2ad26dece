/// @file
/// A quantity over a contact patch as a scene gives it: one number, an expression in p and r, a
/// table { file = "mu.csv" } with the columns p, r [m] and value [SI],
/// or whatever else a function of p and r says.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines {

class SectionReader;

/// n values [SI] at n places of the patch plane; p, r [m], from its centroid.
using FieldFunction =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& p, const Eigen::VectorXd& r)>;

struct Field {
  std::variant<double, FieldFunction> value = 0.0;
  std::string place;  ///< e.g. "scene.toml:12: contact.friction_coefficient", for messages
  std::optional<Eigen::AlignedBox2d> table_box{};  ///< p, r of its table [m]; none: no table
  double low = -unbounded;                         ///< low ≤ value ≤ high everywhere
  double high = unbounded;

  [[nodiscard]] bool is_zero() const;
  /// @param p, r  [m], n each.
  /// @throws SceneError  a value that is not finite or out of range; names the position.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;
};

/// @throws SceneError  what cannot be read, see Expression.
[[nodiscard]] FieldFunction field_of_expression(const std::string& text, const std::string& place);
/// Interpolated as PositionTable does.
/// @param file  columns p, r, value, header required, any order and further columns allowed.
/// @throws SceneError  as CsvTable; a column missing; no rows; the same position twice.
[[nodiscard]] FieldFunction field_of_table(const std::filesystem::path& file);

/// The value of a key: a number with or without its unit, an expression, { expression = "…" } or {
/// file = "….csv" }, of which the completed scene keeps the absolute path.
/// @param folder  relative files start here.
[[nodiscard]] Field read_field(SectionReader& section, std::string_view key,
                               const std::filesystem::path& folder, const char* unit);

}  // namespace microslip::pipelines
