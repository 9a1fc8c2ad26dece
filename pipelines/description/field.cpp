#include "pipelines/description/field.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contact/patch/position_table.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/csv_table.hpp"
#include "pipelines/text/expression.hpp"
#include "pipelines/text/required_file.hpp"
#include "pipelines/text/section_reader.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

Eigen::VectorXd column(const CsvTable& table, std::string_view name) {
  const std::size_t index = table.require(name);
  Eigen::VectorXd values(static_cast<Eigen::Index>(table.n_rows()));
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    values[static_cast<Eigen::Index>(row)] = table.at(row, index);
  }
  return values;
}

contact::PositionTable position_table(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  try {
    return {column(table, "p"), column(table, "r"), column(table, "value")};
  } catch (const std::invalid_argument& error) {
    throw SceneError(fmt::format("{}: {} (rows below the header)", table.name(), error.what()));
  }
}

FieldFunction field_of(std::shared_ptr<const contact::PositionTable> table) {
  return [table = std::move(table)](const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
    return table->at(p, r);
  };
}

/// { expression = … } or { file = … }.
void set_function(SectionReader& s, std::string_view key, const toml::table& table,
                  const std::filesystem::path& folder, Field& field) {
  const bool expression = table.contains("expression");
  const auto text = table[expression ? "expression" : "file"].value<std::string>();
  if (!text || table.size() != 1) {
    s.fail(key, "expected { expression = \"…\" } or { file = \"….csv\" }", &table);
  }
  if (expression) {
    field.value = field_of_expression(*text, field.place);
    return;
  }
  const std::filesystem::path file =
      std::filesystem::path(*text).is_absolute() ? std::filesystem::path(*text) : folder / *text;
  require_file(file, field.place);
  const auto points = std::make_shared<const contact::PositionTable>(position_table(file));
  field.value = field_of(points);
  field.table_box = points->box();
  toml::table complete;
  complete.is_inline(true);
  complete.insert_or_assign("file", file.string());
  s.complete(key, std::move(complete));
}

}  // namespace

bool Field::is_zero() const {
  const auto* number = std::get_if<double>(&value);
  return number != nullptr && *number == 0.0;
}

Eigen::VectorXd Field::at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  const auto* number = std::get_if<double>(&value);
  Eigen::VectorXd values = number != nullptr ? Eigen::VectorXd::Constant(p.size(), *number)
                                             : std::get<FieldFunction>(value)(p, r);
  KeySpec range;
  range.low = low;
  range.high = high;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] >= low && values[i] <= high) continue;
    throw SceneError(fmt::format("{}: {} at p = {} m, r = {} m; must be {}", place, values[i], p[i],
                                 r[i], range_text(range)));
  }
  return values;
}

// What is inside does not change and may be large: copies of the functions share it.
FieldFunction field_of_expression(const std::string& text, const std::string& place) {
  return [expression = std::make_shared<const Expression>(text, place)](
             const Eigen::VectorXd& p, const Eigen::VectorXd& r) { return expression->at(p, r); };
}

FieldFunction field_of_table(const std::filesystem::path& file) {
  return field_of(std::make_shared<const contact::PositionTable>(position_table(file)));
}

Field read_field(SectionReader& s, std::string_view key, const std::filesystem::path& folder,
                 const char* unit) {
  const toml::node& node = *s.node(key);
  Field field{.place = s.place(key)};
  if (const toml::table* table = node.as_table()) {
    set_function(s, key, *table, folder, field);
  } else if (node.is_string()) {
    const std::string text = *node.value<std::string>();
    try {
      field.value = to_si(text, unit);
    } catch (const UnitError&) {  // no quantity, so an expression: its own messages follow
      field.value = field_of_expression(text, field.place);
    }
  } else {
    field.value = s.number_in(node, key);
  }
  return field;
}

}  // namespace microslip::pipelines
