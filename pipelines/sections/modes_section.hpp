/// @file
/// What the sections of several kinds share: damping ratios, and the four sections of the kinds
/// that have formulas for their modes (bar, chain, block).
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

struct LeanSections {
  SectionReader model;
  SectionReader modes;
  SectionReader contact;
  SectionReader excitation;
};

/// `damping_ratio`: one number, a list, or { alpha = …, beta = … }. That a list fits the modes is
/// checked where the modes are known.
/// @throws SceneError  not a number, negative, another key.
[[nodiscard]] std::variant<std::vector<double>, RayleighDamping> read_damping(
    const SectionReader& modes);

/// The same for modes that are known. @param frequency  ω_n [rad/s].  @return ζ_n.
/// @throws SceneError  a list of another length; α with a rigid-body mode.
[[nodiscard]] Eigen::VectorXd read_damping_ratios(const SectionReader& modes,
                                                  const Eigen::VectorXd& frequency);

/// A list of numbers with units, in the range of the key. @throws SceneError  not a list, empty.
[[nodiscard]] Eigen::VectorXd read_numbers(const SectionReader& section, std::string_view key);

}  // namespace microslip::pipelines
