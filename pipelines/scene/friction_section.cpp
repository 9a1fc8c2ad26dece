#include "pipelines/scene/friction_section.hpp"

#include <array>
#include <vector>

#include "pipelines/scene/law_table.hpp"

namespace microslip::pipelines {
namespace {

using contact::FrictionLaw;

struct Row {
  std::string_view law;
  std::vector<std::string_view> keys;
  FrictionDescription (*make)(const LawTable&);
};

FrictionDescription of_speed(const FrictionLaw& law) {
  return {.at_rest = {.value = law.at_rest(), .place = {}}, .law = law};
}

FrictionDescription exponential(const LawTable& t) {
  return of_speed(FrictionLaw::exponential(t.number("static", "1"), t.number("kinetic", "1"),
                                           t.number("rate", "s/m")));
}

FrictionDescription hyperbolic(const LawTable& t) {
  return of_speed(FrictionLaw::hyperbolic(t.number("static", "1"), t.number("rate", "s/m")));
}

const std::array rows{
    Row{"exponential", {"static", "kinetic", "rate"}, exponential},
    Row{"hyperbolic", {"static", "rate"}, hyperbolic},
};

}  // namespace

FrictionDescription read_friction(SectionReader& s, std::string_view key,
                                  const std::filesystem::path& folder) {
  FrictionDescription friction;
  const toml::table* table = s.node(key)->as_table();
  if (table != nullptr && !table->contains("file") && !table->contains("expression")) {
    const LawTable law(s, key, *table);
    friction = law.choose(std::span<const Row>(rows)).make(law);
    friction.at_rest.place = law.place();
  } else {
    friction.at_rest = read_field(s, key, folder, "1");
  }
  friction.at_rest.low = 0.0;
  return friction;
}

}  // namespace microslip::pipelines
