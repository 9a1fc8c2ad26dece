#include "pipelines/scene/bar_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "pipelines/scene/bar_modes.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/expression.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

double read_end_stiffness(const SectionReader& s) {
  const toml::node& node = *s.node("end_stiffness");
  if (node.is_string() && *node.value<std::string>() == "clamped") {
    return std::numeric_limits<double>::infinity();
  }
  constexpr std::array<std::string_view, 1> words{"clamped"};
  const double stiffness = s.number_or_word_in(node, "end_stiffness", words);
  if (stiffness < 0.0) s.fail("end_stiffness", fmt::format("{:g} is negative", stiffness), &node);
  return stiffness;
}

/// Numbers of the modes kept: those asked for, or the lowest ones.
std::vector<int> read_mode_numbers(const SectionReader& s) {
  if (!s.given("which")) {
    std::vector<int> numbers(static_cast<std::size_t>(s.integer("count")));
    std::iota(numbers.begin(), numbers.end(), 1);
    return numbers;
  }
  const toml::node& node = *s.node("which");
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty()) s.fail("which", "expected a list of mode numbers", &node);
  std::vector<int> numbers;
  for (const toml::node& entry : *list) {
    const auto number = entry.is_integer() ? entry.value<std::int64_t>() : std::nullopt;
    constexpr std::int64_t highest = 1000;
    if (!number || *number < 1 || *number > highest) {
      s.fail("which", fmt::format("expected mode numbers from 1 to {}", highest), &entry);
    }
    if (std::find(numbers.begin(), numbers.end(), *number) != numbers.end()) {
      s.fail("which", fmt::format("mode {} stands twice", *number), &entry);
    }
    numbers.push_back(static_cast<int>(*number));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Values of a formula in x and L, or of a quantity such as "2 kN/m".
Eigen::VectorXd load_of_text(const SectionReader& s, const std::string& text,
                             const Eigen::VectorXd& x, double length) {
  try {
    return Eigen::VectorXd::Constant(x.size(), to_si(text, "N/m"));
  } catch (const UnitError&) {  // then it is a formula, or the formula's message tells
    const std::string place = place_of(s.node("load"), s.file()) + ": contact.load";
    return Expression(text, place, {{"L", length}}, {"x", ""})
        .at(x, Eigen::VectorXd::Zero(x.size()));
  }
}

/// Load per length at every point [N/m].
Eigen::VectorXd read_load(const SectionReader& s, const Eigen::VectorXd& x, double length) {
  const toml::node& node = *s.node("load");
  Eigen::VectorXd load(x.size());
  if (node.is_string()) {
    load = load_of_text(s, *node.value<std::string>(), x, length);
  } else {
    load.setConstant(s.number_in(node, "load"));
  }
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (std::isfinite(load[i]) && load[i] >= 0.0) continue;
    s.fail("load",
           fmt::format("{:g} N/m at x = {:g} m: must be finite and not negative", load[i], x[i]),
           &node);
  }
  return load;
}

/// 1/k = 1/k_local + c(x).
Eigen::VectorXd series_stiffness(const Bar& bar, const BarModes& modes, const Eigen::VectorXd& x,
                                 double local) {
  if (bar.end_stiffness == 0.0 && (modes.root.array() != 0.0).all()) {
    throw RefusedError(
        "modes.which: a free bar without its rigid-body mode (number 1) has no residual "
        "flexibility; keep "
        "that mode, or residual = \"none\"");
  }
  if (local == 0.0) return Eigen::VectorXd::Zero(x.size());
  const Eigen::ArrayXd flexibility = bar_residual_flexibility(bar, modes, x).array() + 1.0 / local;
  if (flexibility.minCoeff() <= 0.0) {
    throw RefusedError(fmt::format(
        "residual flexibility makes the contact stiffness not positive (smallest 1/k + c = {:.3g} "
        "m^2/N): give a lower contact.tangential_stiffness, more modes, or modes.residual = "
        "\"none\"",
        flexibility.minCoeff()));
  }
  return flexibility.inverse();
}

void set_contact(ModalModel& model, const SectionReader& s, const Bar& bar, const BarModes& modes) {
  const auto n = static_cast<Eigen::Index>(s.integer("points"));
  const double cell = bar.length / static_cast<double>(n);
  const Eigen::VectorXd x =
      cell * (Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)).array() + 0.5);
  const double local = s.number("tangential_stiffness");
  if (model.residual == ResidualKind::stiffness) model.local_stiffness = local;
  const Eigen::VectorXd stiffness = model.residual == ResidualKind::stiffness
                                        ? series_stiffness(bar, modes, x, local)
                                        : Eigen::VectorXd::Constant(n, local);
  const Eigen::VectorXd load = read_load(s, x, bar.length);
  const double friction = s.number("friction_coefficient");
  model.weights = Eigen::VectorXd::Constant(n, cell);
  for (Eigen::Index i = 0; i < n; ++i) {
    model.points.push_back({stiffness[i], 0.0, friction, load[i]});
  }
  model.shapes.u = bar_shapes(bar, modes, x);
  model.shapes.v = model.shapes.w = Eigen::MatrixXd::Zero(n, modes.root.size());
  model.positions = Eigen::MatrixX2d::Zero(n, 2);
  model.positions.col(0) = x;
}

}  // namespace

ModalModel read_bar(const LeanSections& sections) {
  const SectionReader& s = sections.model;
  const Bar bar{s.number("youngs_modulus"), s.number("area"), s.number("density"),
                s.number("length"), read_end_stiffness(s)};
  const BarModes modes = bar_modes(bar, read_mode_numbers(sections.modes));
  constexpr std::array<std::string_view, 2> residuals{"stiffness", "none"};
  ModalModel model;
  model.residual = sections.modes.word("residual", residuals) == "none" ? ResidualKind::none
                                                                        : ResidualKind::stiffness;
  model.frequency_hz = modes.frequency / (2.0 * std::numbers::pi);
  model.damping_ratio = read_damping_ratios(sections.modes, modes.frequency);
  model.output = modes.amplitude;  // φ_n(L) = c_n
  model.force_sine = sections.excitation.number("force") * modes.amplitude;
  model.force_cosine = model.force_static = Eigen::VectorXd::Zero(modes.root.size());
  set_contact(model, sections.contact, bar, modes);
  return model;
}

}  // namespace microslip::pipelines
