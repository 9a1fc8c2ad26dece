/// @file
/// Effects that a curve leaves out, which no bar has: told beside every bar.
#pragma once

#include <map>
#include <string>

namespace microslip::pipelines {

/// By name: what having the effect changes a peak of the curve by, relative, ≥ 0; infinite: the
/// highest peak is lost; NaN: nothing says.
using BesideBar = std::map<std::string, double>;

/// Of several curves the larger change, NaN above all.
void keep_larger(const BesideBar& one, BesideBar& of_all);

/// "left out: second_direction (would change peaks by up to 7.5 %)". Empty where nothing changes by
/// 1e-5.
[[nodiscard]] std::string beside_bar_text(const BesideBar& left_out);

/// The same to follow a bar: after "; ", or empty.
[[nodiscard]] std::string after_bar(const BesideBar& left_out);

}  // namespace microslip::pipelines
