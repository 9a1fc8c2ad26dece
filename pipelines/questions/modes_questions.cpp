#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "pipelines/model/reduced_model.hpp"
#include "pipelines/questions/question.hpp"
#include "pipelines/response/curve_requirements.hpp"

namespace microslip::pipelines {
namespace {

/// Natural frequencies of the two linear limits [Hz], ascending, as many of each.
struct LimitFrequencies {
  Eigen::VectorXd free, stuck;
  double last = 0.0;  ///< of the modes, without static shapes
};

LimitFrequencies limit_frequencies(const ReducedModel& model) {
  LimitFrequencies limits{.free = model.frequency / (2.0 * std::numbers::pi),
                          .stuck = stuck_frequencies(model)};
  limits.last = limits.free.head(limits.free.size() - model.n_attachment).maxCoeff();
  std::ranges::sort(limits.free);
  return limits;
}

std::pair<double, double> range_of(const SceneDescription& scene) {
  return std::minmax({scene.response->frequency_begin_hz, scene.response->frequency_end_hz});
}

/// Given modes may be all there are: of them the beginning of the range counts, else its end.
Findings range_beyond_modes(const Facts& facts) {
  if (!facts.scene.response) return {};
  const double last = limit_frequencies(*facts.model).last;
  const auto [low, high] = range_of(facts.scene);
  if (!(last > 0.0)) return {};
  return {{"response.frequency", percent * (is_meshed(facts.scene) ? high : low) / last,
           fmt::format("of the last natural frequency, {:.6g} Hz", last)}};
}

/// Of a range that lies above the last mode altogether,
/// though not far enough for the question before.
Findings range_above_modes(const Facts& facts) {
  if (!facts.scene.response || !is_meshed(facts.scene)) return {};
  const double last = limit_frequencies(*facts.model).last;
  const auto [low, high] = range_of(facts.scene);
  if (!(last > 0.0) || high > 1.5 * last) return {};
  return {{"response.frequency", percent * low / last,
           fmt::format("of the last natural frequency, {:.6g} Hz", last)}};
}

/// Frequencies of another code may be angular ones. "": that would not explain a range without any.
std::string angular_hint(const SceneDescription& scene, const Eigen::VectorXd& frequencies,
                         std::pair<double, double> range) {
  if (given_modes(scene) == nullptr) return {};
  const Eigen::ArrayXd divided = frequencies.array() / (2.0 * std::numbers::pi);
  const auto n = (divided >= range.first && divided <= range.second).count();
  return n == 0
             ? std::string()
             : fmt::format("; divided by 2 pi, {} of them would be: does the file have rad/s?", n);
}

/// Modes that have the range, or a part of it, between their free and their stuck frequency.
Findings modes_in_range(const Facts& facts) {
  if (!facts.scene.response) return {};
  const auto [low, high] = range_of(facts.scene);
  if (low == high) return {};  // one point, not a search for a peak
  const LimitFrequencies limits = limit_frequencies(*facts.model);
  constexpr double margin = 0.02;  // damping and excitation move a peak a little
  int n = 0;
  Eigen::Index nearest = 0;
  double distance = unlimited;
  for (Eigen::Index i = 0; i < limits.free.size(); ++i) {
    const double from = (1.0 - margin) * limits.free[i];
    const double to = (1.0 + margin) * std::max(limits.free[i], limits.stuck[i]);
    if (from <= high && to >= low) ++n;
    const double away = std::max(from - high, low - to);
    if (away < distance) nearest = i;
    distance = std::min(distance, away);
  }
  const std::string hint = n > 0 ? "" : angular_hint(facts.scene, limits.free, {low, high});
  return {
      {"response.frequency", static_cast<double>(n),
       fmt::format("between {:g} and {:g} Hz; the nearest has {:.6g} Hz free, {:.6g} Hz stuck{}",
                   low, high, limits.free[nearest], limits.stuck[nearest], hint)}};
}

std::string stiffness_text(const std::optional<double>& stiffness) {
  return stiffness ? fmt::format("{:g} N/m^3", *stiffness) : "rigid";
}

/// Of the modes that have the range, or a part of it, between their limits; of all where none has.
double largest_shift(const LimitFrequencies& limits, std::pair<double, double> range) {
  double inside = -1.0;
  double anywhere = 0.0;
  for (Eigen::Index i = 0; i < limits.free.size() && limits.free[i] <= limits.last; ++i) {
    const double shift = (limits.stuck[i] - limits.free[i]) / limits.free[i];
    anywhere = std::max(anywhere, shift);
    const bool meets = limits.free[i] <= range.second && limits.stuck[i] >= range.first;
    if (meets) inside = std::max(inside, shift);
  }
  return inside < 0.0 ? anywhere : inside;
}

/// A contact that sticks moves the natural frequencies, or it does nothing. Asked before where a
/// stiffness is not usual by itself.
Findings shift_by_sticking(const Facts& facts) {
  if (facts.scene.contacts.empty() || !facts.scene.response) return {};
  const ContactDescription& contact = facts.scene.contacts.front();
  for (const auto* stiffness : {&contact.normal_stiffness, &contact.tangential_stiffness}) {
    const double given = stiffness->value_or(0.0);
    if (given > 0.0 && given < least_contact_stiffness) return {};
  }
  return {{contact.key + ".normal_stiffness",
           percent * largest_shift(limit_frequencies(*facts.model), range_of(facts.scene)),
           fmt::format("by a contact that sticks (normal_stiffness {}, tangential_stiffness {})",
                       stiffness_text(contact.normal_stiffness),
                       stiffness_text(contact.tangential_stiffness))}};
}

/// Given modes move as they move; the axes of a face are chosen in the scene.
Findings motion_along_r(const Facts& facts) {
  if (facts.scene.contacts.empty()) return {};
  return {{facts.scene.contacts.front().key + ".slip_direction",
           percent * facts.model->effects.motion_ratio, "of that along p"}};
}

constexpr std::array about_modes{
    Question{"the frequency range reaches", "%", 0.0, 150.0, "",
             "modes beyond the last are left out; raise modes.count or lower the range",
             range_beyond_modes},
    Question{"the frequency range rises from", "%", 0.0, 100.0, "",
             "the modes in and above it are left out; raise modes.count", range_above_modes},
    Question{"the number of modes", "", 1.0, unlimited, "",
             "the curve has no peak of theirs; is the range the right one?", modes_in_range},
    Question{"the largest shift of a natural frequency", "%", 0.01, unlimited, "",
             "stuck is the same as free: is the stiffness in N/mm^3? give the unit; does the face "
             "move in these modes?",
             shift_by_sticking},
    Question{"motion along r is", "%", 0.0, 200.0, "",
             "does the face slide along r rather? turn the slip direction", motion_along_r},
};

}  // namespace

std::span<const Question> modes_questions() { return about_modes; }

}  // namespace microslip::pipelines
