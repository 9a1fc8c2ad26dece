/// @file
/// Keys of [response], by kinds: a part of the table in scene_keys.cpp, and of no use elsewhere.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "pipelines/text/scene_keys.hpp"

namespace microslip::pipelines::keys {

using enum KeyType;

inline constexpr KeySpec frequency_key{
    "frequency", other,
    "Hz",        "",
    0,           0,
    false,       "from, to (either order): a curve; a single value: the solution there"};
inline constexpr KeySpec method_key{
    "method",
    text,
    "",
    "\"harmonic_balance\"",
    0,
    0,
    false,
    "harmonic_balance | time: integrated to the steady state, frequencies swept from → to"};
inline constexpr KeySpec time_points_key{
    "points", integer,
    "",       "40",
    2,        100'000,
    false,    "of method = \"time\": number of frequencies; continuation chooses its own"};
inline constexpr KeySpec steps_key{"steps_per_period",
                                   integer,
                                   "",
                                   "0",
                                   0,
                                   10'000'000,
                                   false,
                                   "of method = \"time\": fixed steps of fourth-order Runge-Kutta "
                                   "as in paper B; 0: every change of contact located"};
inline constexpr KeySpec harmonics_key{"harmonics",
                                       other,
                                       "",
                                       "\"auto\"",
                                       1,
                                       99,
                                       false,
                                       "highest harmonic, a list such as [1, 3, 5], or \"auto\": "
                                       "chosen by what they do to the peaks of a curve; 1 "
                                       "where that is all a method knows"};
inline constexpr KeySpec harmonic_tolerance_key{
    "harmonic_tolerance",
    number,
    "1",
    "0.01",
    1e-9,
    0.1,
    false,
    "of harmonics = \"auto\": share of a peak's amplitude that the harmonics left out may change"};
inline constexpr KeySpec search_key{
    "search_starts",
    other,
    "",
    "\"auto\"",
    0,
    1000,
    false,
    "starts per frequency of a search for branches detached from the curve, or for other "
    "solutions at a single frequency; 0: none; auto: as effects.coexistence"};
inline constexpr KeySpec time_budget_key{
    "time_budget",
    other,
    "s",
    "\"1 h\"",
    0,
    unbounded,
    true,
    "wall time of one curve, e.g. \"5 min\", or \"off\"; then it ends with the points it has"};
inline constexpr KeySpec maps_key{
    "maps", other, "Hz",  "[]",
    0,      0,     false, "where contact maps are drawn: \"peak\", \"folds\", or frequencies"};
inline constexpr KeySpec phases_key{
    "map_phases", integer, "", "24", 4, 3600, false, "instants per period in a map"};

inline constexpr KeySpec preload_key{"preload",
                                     other,
                                     "N",
                                     "[\"free\", \"stuck\"]",
                                     0,
                                     0,
                                     false,
                                     "total normal force carried, one curve each; negative: "
                                     "uniform gap −preload/∬k_v dA; { gap = \"8 um\" }: a gap "
                                     "that does not depend on stiffness; \"free\", \"stuck\"; "
                                     "\"static\": what contact.preload = \"static\" gives"};
inline constexpr KeySpec optimum_key{
    "optimum",
    text,
    "",
    "",
    0,
    0,
    false,
    "the number whose best value is searched: \"preload\", or any key of the "
    "scene, e.g. \"contact.friction_coefficient\"",
    true};
inline constexpr KeySpec optimum_range_key{"optimum_range",
                                           other,
                                           "N",
                                           "",
                                           0,
                                           0,
                                           false,
                                           "[low, high] of the search, in the unit of that key; "
                                           "for the preload else the smallest and largest "
                                           "positive one",
                                           true};
inline constexpr KeySpec optimum_at_key{
    "optimum_at",
    other,
    "N",
    "",
    0,
    0,
    false,
    "preload (kind modal, bar: scale), or \"static\", under which another key "
    "is searched; else the only positive one",
    true};

template <std::size_t... sizes>
inline constexpr auto joined(const std::array<KeySpec, sizes>&... parts) {
  std::array<KeySpec, (sizes + ...)> all{};
  auto end = all.begin();
  ((end = std::copy(parts.begin(), parts.end(), end)), ...);
  return all;
}

// What every kind has in common, so that a key added here is known to all of them.
inline constexpr std::array method_keys{frequency_key, method_key,     time_points_key,
                                        steps_key,     harmonics_key,  harmonic_tolerance_key,
                                        search_key,    time_budget_key};
inline constexpr std::array result_keys{optimum_key, optimum_range_key, optimum_at_key, maps_key,
                                        phases_key};

inline constexpr auto loaded_keys = joined(method_keys, std::array{preload_key}, result_keys);
inline constexpr auto response_keys =
    joined(std::array{KeySpec{"output", other, "", "", 0, 0, false,
                              "{ at = …, direction = […] }: the displacement that is told"}},
           loaded_keys);
inline constexpr auto chain_response_keys =
    joined(std::array{KeySpec{"output", text, "", "", 0, 0, false, "coordinate that is told"}},
           loaded_keys);
inline constexpr auto block_response_keys = joined(
    std::array{KeySpec{"output", other, "", "", 0, 0, false,
                       "{ at = [p, q, r], direction = [p, q, r] }: the displacement that is told"}},
    loaded_keys);
inline constexpr auto modal_response_keys =
    joined(method_keys,
           std::array{KeySpec{"preload_scale", other, "1", "[1]", 0, 0, false,
                              "factors on the rest loads of the points, one curve each"},
                      KeySpec{"limits", other, "", "false", 0, 0, false,
                              "true: the free and the stuck limit as curves of their own"}},
           result_keys);

}  // namespace microslip::pipelines::keys
