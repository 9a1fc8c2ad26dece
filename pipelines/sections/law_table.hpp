/// @file
/// { law = "NAME", … }: the inline table of a key whose value follows one of several laws.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

class LawTable {
 public:
  /// Borrowed, all three.
  LawTable(const SectionReader& section, std::string_view key, const toml::table& table)
      : section_(section), key_(key), table_(table) {}

  /// The row whose law is named.
  /// @param laws  each with its `law` and the `keys` that stand beside it.
  /// @throws SceneError  no law, or none of these; a key that the law does not have.
  template <typename Row>
  [[nodiscard]] const Row& choose(std::span<const Row> laws) const {
    std::vector<std::string_view> names;
    for (const Row& row : laws) names.push_back(row.law);
    const Row& row = laws[index_of(names)];
    require_known(row.keys);
    return row;
  }
  /// What a key has. @throws SceneError  nothing.
  [[nodiscard]] const toml::node& node(std::string_view name) const;
  /// What messages about the table begin with.
  [[nodiscard]] std::string place() const { return section_.place(key_); }
  /// The number of a key, ≥ 0. @param unit  that it may be given in.
  [[nodiscard]] double number(std::string_view name, const char* unit) const;
  /// @throws SceneError  about the value of a key.
  [[noreturn]] void fail(std::string_view name, const std::string& message) const;

 private:
  [[nodiscard]] std::size_t index_of(const std::vector<std::string_view>& names) const;
  void require_known(const std::vector<std::string_view>& keys) const;

  const SectionReader& section_;
  std::string_view key_;
  const toml::table& table_;
};

}  // namespace microslip::pipelines
