#include "pipelines/scene/field_description.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/csv_table.hpp"

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

void require_range(const FieldDescription& field, const Eigen::VectorXd& values,
                   const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  KeySpec range;
  range.low = field.low;
  range.high = field.high;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!(values[i] >= field.low && values[i] <= field.high)) {
      throw SceneError(fmt::format("{}: {} at p = {} m, r = {} m; must be {}", field.place,
                                   values[i], p[i], r[i], range_text(range)));
    }
  }
}

}  // namespace

contact::PositionTable read_position_table(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  try {
    return {column(table, "p"), column(table, "r"), column(table, "value")};
  } catch (const std::invalid_argument& error) {
    throw SceneError(fmt::format("{}: {} (rows below the header)", table.name(), error.what()));
  }
}

Field::Field(FieldDescription description) : description_(std::move(description)) {
  if (const auto* expression = std::get_if<FieldExpression>(&description_.value)) {
    expression_ = std::make_shared<const Expression>(expression->text, description_.place);
  } else if (const auto* table = std::get_if<FieldTable>(&description_.value)) {
    table_ = std::make_shared<const contact::PositionTable>(read_position_table(table->file));
  } else {
    (void)at(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));  // out of range: now, not later
  }
}

Eigen::VectorXd Field::at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const {
  Eigen::VectorXd values =
      expression_ ? expression_->at(p, r)
      : table_    ? table_->at(p, r)
                  : Eigen::VectorXd::Constant(p.size(), std::get<double>(description_.value));
  require_range(description_, values, p, r);
  return values;
}

}  // namespace microslip::pipelines
