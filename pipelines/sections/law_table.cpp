#include "pipelines/sections/law_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/text/units.hpp"

namespace microslip::pipelines {

std::size_t LawTable::index_of(const std::vector<std::string_view>& names) const {
  const auto law = table_["law"].value<std::string>();
  const auto found = law ? std::ranges::find(names, std::string_view(*law)) : names.end();
  if (found == names.end()) {
    section_.fail(key_, fmt::format("law: expected one of: {}", fmt::join(names, ", ")), &table_);
  }
  return static_cast<std::size_t>(found - names.begin());
}

void LawTable::require_known(const std::vector<std::string_view>& keys) const {
  for (const auto& [name, value] : table_) {
    if (name.str() == "law" || std::ranges::find(keys, name.str()) != keys.end()) continue;
    section_.fail(
        key_, fmt::format("unknown key \"{}\"; known: law, {}", name.str(), fmt::join(keys, ", ")),
        &value);
  }
}

const toml::node& LawTable::node(std::string_view name) const {
  const toml::node* found = table_.get(name);
  if (found == nullptr) section_.fail(key_, fmt::format("{} is missing", name), &table_);
  return *found;
}

double LawTable::number(std::string_view name, const char* unit) const {
  const toml::node& given = node(name);
  double value = std::numeric_limits<double>::quiet_NaN();
  if (given.is_number()) {
    value = *given.value<double>();
  } else if (given.is_string()) {
    try {
      value = to_si(*given.value<std::string>(), unit);
    } catch (const UnitError& error) {
      fail(name, error.what());
    }
  }
  if (!(std::isfinite(value) && value >= 0.0)) {
    fail(name, fmt::format("expected a number, at least 0 [{}]", unit));
  }
  if (!is_of_usable_size(value)) fail(name, "expected 0, or a number from 1e-100 to 1e100");
  return value;
}

void LawTable::fail(std::string_view name, const std::string& message) const {
  section_.fail(key_, fmt::format("{}: {}", name, message), &node(name));
}

}  // namespace microslip::pipelines
