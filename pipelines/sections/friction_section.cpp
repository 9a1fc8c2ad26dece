#include "pipelines/sections/friction_section.hpp"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "pipelines/sections/law_table.hpp"

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
  const double at_rest = t.number("static", "1");
  const double at_speed = t.number("kinetic", "1");
  if (at_rest == 0.0 && at_speed > 0.0) {
    t.fail("static", fmt::format("0 with kinetic = {:g}: such a contact could never stick; "
                                 "expected a static coefficient above 0",
                                 at_speed));
  }
  return of_speed(FrictionLaw::exponential(at_rest, at_speed, t.number("rate", "s/m")));
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
