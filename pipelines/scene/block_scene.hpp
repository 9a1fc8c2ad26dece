/// @file
/// Scene kind `block`: a rigid block on springs, six degrees of freedom, that rests on the ground
/// with a rectangle of n × m cells (paper B, section 2.3, in full; theory sections 12 and 20.6).
///
/// All vectors are told along p, q, r: q points out of the block into the ground, p and r lie in
/// the contact plane. With the motion x = (d, φ) of the centre of mass G,
/// and c a point seen from G,
///
///   M = diag(m, m, m, I_p, I_q, I_r),     M ẍ + C ẋ + K x = Σ D(c)ᵀ F + contact         (1)
///   d(c) = D(c) x = d + φ × c                                                           (2)
///
/// The centre C of the contact rectangle lies at c = (centre_p, height, centre_r). Its motion U and
/// the cells' G_i (contact_area.hpp) give the shapes of the cells, φ_u, φ_v, φ_w along p, q, r:
/// normal force and moments of the contact vary within the cycle.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "pipelines/sections/modes_section.hpp"

namespace microslip::pipelines {

/// A displacement that is told.
struct BlockOutput {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();          ///< from the centre of mass [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit
};

/// Motion of a point of a rigid body by (d, φ): D(c) of (2), 3 × 6.   @param c  [m]
[[nodiscard]] Eigen::Matrix<double, 3, 6> point_motion(const Eigen::Vector3d& c);

/// `response.output` of a block. @throws SceneError  as SectionReader.
[[nodiscard]] BlockOutput read_block_output(SectionReader& response);

/// @param output  none: the scene has no response.
/// @param folder  relative files start here.
/// @param rules   receives friction law and roughness, @param wear_coefficient  Archard [m²/N].
/// @return modes and one point per cell, constants per area.
///         The load of a curve is the total normal force.
/// @throws SceneError  none or both of the springs' two forms, a matrix that is not symmetric or
///         not positive semidefinite, moments on an area one cell wide.
[[nodiscard]] ModalModel read_block(LeanSections sections, const std::optional<BlockOutput>& output,
                                    const std::filesystem::path& folder,
                                    contact::SurfaceRules& rules, double& wear_coefficient);

}  // namespace microslip::pipelines
