#include "contact/patch/patch_load.hpp"

#include "contact/patch/patch_surfaces.hpp"
#include "contact/patch/preload_equilibrium.hpp"

namespace microslip::contact {
namespace {

/// Pressure of each point: the unit field times the load, or the gap the load stands for.
Eigen::VectorXd pressures(const Eigen::VectorXd& unit, const Eigen::VectorXd& normal_stiffness,
                          const PatchLoad& load) {
  if (load.load >= 0.0 || unit.size() == 0 || load.total_stiffness == 0.0) return load.load * unit;
  return (load.load / load.total_stiffness) * normal_stiffness;
}

/// Coordinate of points along an axis of the patch, from its centroid [m].
Eigen::VectorXd along(const Patch& patch, const Eigen::MatrixX3d& points, int axis) {
  return (points.rowwise() - centroid(patch).transpose()) * patch.frame.row(axis).transpose();
}

/// Surfaces that just touch, of `n` points from `begin` on.
std::vector<SurfaceLaw> touching_surfaces(const SurfaceRules& rules, const PatchSamples& samples,
                                          const std::string& key, Eigen::Index begin,
                                          Eigen::Index n) {
  const Eigen::VectorXd k = samples.stiffness.col(1).segment(begin, n);
  const bool constant = k.isZero(0.0);
  if (!constant && !(k.minCoeff() > 0.0)) {
    throw LoadError(key +
                    ": bodies that tilt need normal stiffness at every contact point, or at none");
  }
  std::vector<SurfaceLaw> laws;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PointParameters point{0.0, constant ? 1.0 : k[i], 0.0, 0.0};
    laws.push_back(constant ? SurfaceLaw(point, 0.0)
                            : surface_at(rules, samples, begin + i, point));
  }
  return laws;
}

PreloadEquilibrium equilibrium(const Patch& patch, const TiltedArea& area,
                               const std::vector<SurfaceLaw>& laws, double load) {
  const ContactArea cells({area.r, area.p, patch.cells.weights.segment(area.begin, area.p.size())});
  const CellSprings springs = [&](Eigen::Index i, double approach) {
    const SurfaceState state = laws[static_cast<std::size_t>(i)].at(approach, 0.0);
    return NormalResponse{state.load, state.load_by_approach};
  };
  try {
    return preload_equilibrium(
        cells, springs,
        {.force = load * area.share, .moment_y = area.moment[1], .moment_z = area.moment[0]});
  } catch (const PreloadError& error) {
    throw LoadError("preload-unbalanced: " + area.key + ": " + error.what());
  }
}

/// The rest load with which a law is at rest at an approach.
double rest_load_at(const SurfaceLaw& law, double approach) {
  const double load = law.at(approach, 0.0).load;
  return load > 0.0 ? load : law.point().normal_stiffness * approach;
}

/// Contact points have a weight, places for pictures have none.
bool is_points(const PatchSamples& samples) { return samples.weights.size() > 0; }

double total_stiffness(const Patch& patch) {
  return patch.cells.stiffness.col(1).dot(patch.cells.weights);
}

}  // namespace

Eigen::Vector3d centroid(const Patch& patch) {
  const PatchSamples& cells = patch.cells;
  return cells.points.transpose() * cells.weights / cells.weights.sum();
}

std::vector<PatchLoad> shared_load(const std::vector<Patch>& patches, double load) {
  double stiffness = 0.0;
  double shares = 0.0;
  bool in_newtons = false;
  for (const Patch& patch : patches) {
    in_newtons = in_newtons || patch.load_measure == LoadMeasure::force;
    if (patch.load_measure == LoadMeasure::force) stiffness += total_stiffness(patch);
    shares += patch.load_share;
  }
  if (in_newtons && load < 0.0 && stiffness <= 0.0) {
    throw LoadError("response.preload: a gap needs a normal contact stiffness, and it is zero");
  }
  std::vector<PatchLoad> loads;
  for (const Patch& patch : patches) {
    const bool whole = patch.load_measure == LoadMeasure::scale || load < 0.0;
    loads.push_back({whole ? load : load * (patch.load_share / shares), stiffness});
  }
  return loads;
}

Eigen::VectorXd tilted_pressures(const Patch& patch, const TiltedArea& area,
                                 const PatchSamples& samples, double load) {
  const Eigen::Index n_points = area.p.size();
  std::vector<SurfaceLaw> laws =
      touching_surfaces(patch.rules, patch.cells, area.key, area.begin, n_points);
  const PreloadEquilibrium rest = equilibrium(patch, area, laws, load);
  Eigen::VectorXd p = area.p;
  Eigen::VectorXd r = area.r;
  if (!is_points(samples)) {
    p = along(patch, samples.points, 0);
    r = along(patch, samples.points, 2);
    laws = touching_surfaces(patch.rules, samples, area.key, 0, p.size());
  }
  Eigen::VectorXd pressure(p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const double approach = rest.approach + p[i] * rest.rotation_y - r[i] * rest.rotation_z;
    pressure[i] = rest_load_at(laws[static_cast<std::size_t>(i)], approach);
  }
  return pressure;
}

std::vector<PointParameters> point_parameters(const Patch& patch, const PatchSamples& samples,
                                              const ContactEffects& effects,
                                              const PatchLoad& load) {
  const auto& stiffness = samples.stiffness;
  Eigen::VectorXd pressure = pressures(samples.preload_field, stiffness.col(1), load);
  for (const TiltedArea& area : patch.tilted_areas) {
    const Eigen::VectorXd tilted = tilted_pressures(patch, area, samples, load.load);
    pressure.segment(is_points(samples) ? area.begin : 0, tilted.size()) = tilted;
  }
  std::vector<PointParameters> points(static_cast<std::size_t>(pressure.size()));
  for (Eigen::Index i = 0; i < pressure.size(); ++i) {
    points[static_cast<std::size_t>(i)] = {stiffness(i, 0),
                                           effects.normal_stiffness(stiffness(i, 1)),
                                           samples.friction[i], pressure[i]};
  }
  return points;
}

}  // namespace microslip::contact
