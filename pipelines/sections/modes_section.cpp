#include "pipelines/sections/modes_section.hpp"

#include <fmt/format.h>

#include "mesh/count_text.hpp"
#include "pipelines/description/damping_ratios.hpp"

namespace microslip::pipelines {
namespace {

double damping_in(const SectionReader& s, const toml::node& node) {
  const double value = s.number_in(node, "damping_ratio");
  if (value < 0.0) s.fail("damping_ratio", fmt::format("{:g} is negative", value), &node);
  return value;
}

}  // namespace

std::variant<std::vector<double>, RayleighDamping> read_damping(const SectionReader& s) {
  const toml::node& damping = *s.node("damping_ratio");
  if (const toml::table* table = damping.as_table()) {
    RayleighDamping rayleigh;
    for (const auto& [key, value] : *table) {
      const bool alpha = key.str() == "alpha";
      if (!alpha && key.str() != "beta") {
        s.fail("damping_ratio", fmt::format("unknown key \"{}\"; known: alpha, beta", key.str()),
               &value);
      }
      (alpha ? rayleigh.alpha : rayleigh.beta) = damping_in(s, value);
    }
    return rayleigh;
  }
  if (const toml::array* list = damping.as_array()) {
    std::vector<double> ratios;
    for (const toml::node& entry : *list) ratios.push_back(damping_in(s, entry));
    return ratios;
  }
  return std::vector<double>{damping_in(s, damping)};
}

Eigen::VectorXd read_damping_ratios(const SectionReader& s, const Eigen::VectorXd& frequency) {
  ModesDescription modes;
  modes.damping = read_damping(s);
  const toml::node& given = *s.node("damping_ratio");
  const auto n_modes = static_cast<std::size_t>(frequency.size());
  if (const toml::array* list = given.as_array(); list != nullptr && list->size() != n_modes) {
    s.fail("damping_ratio",
           fmt::format("{} for {}; give one, or one each",
                       mesh::counted(list->size(), "value", "values"),
                       mesh::counted(n_modes, "mode", "modes")),
           &given);
  }
  return damping_ratios(modes, frequency);
}

Eigen::VectorXd read_numbers(const SectionReader& s, std::string_view key) {
  const toml::node& node = *s.node(key);
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty()) s.fail(key, "expected a list of numbers [a, b, …]", &node);
  Eigen::VectorXd values(static_cast<Eigen::Index>(list->size()));
  for (std::size_t i = 0; i < list->size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = s.number_in(*list->get(i), key);
  }
  return values;
}

}  // namespace microslip::pipelines
