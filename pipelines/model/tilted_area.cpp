#include "pipelines/model/tilted_area.hpp"

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "contact/patch/preload_equilibrium.hpp"
#include "contact/surface/surface_law.hpp"
#include "pipelines/model/contact_effects.hpp"
#include "pipelines/model/contact_stage.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// Coordinate of points along an axis of the patch, from its centroid [m].
Eigen::VectorXd along(const ReducedModel& model, const Eigen::MatrixX3d& points, int axis) {
  return (points.rowwise() - patch_centroid(model).transpose()) *
         model.frame.row(axis).transpose();
}

/// Surfaces that just touch, of `n` points from `begin` on.
std::vector<contact::SurfaceLaw> touching_surfaces(const ReducedModel& model,
                                                   const TiltedArea& area, Eigen::Index begin,
                                                   Eigen::Index n, bool on_vertices) {
  const Eigen::VectorXd k = (on_vertices ? model.vertex_normal_stiffness : model.normal_stiffness)
                                .segment(begin, n);
  const bool constant = k.isZero(0.0);
  if (!constant && !(k.minCoeff() > 0.0)) {
    throw RefusedError(
        fmt::format("{}: bodies that tilt need normal stiffness at every contact point, or at none",
                    area.key));
  }
  std::vector<contact::SurfaceLaw> laws;
  for (Eigen::Index i = 0; i < n; ++i) {
    const contact::PointParameters point{0.0, constant ? 1.0 : k[i], 0.0, 0.0};
    laws.push_back(constant ? contact::SurfaceLaw(point, 0.0)
                            : surface_of_point(model, point, begin + i, on_vertices));
  }
  return laws;
}

contact::PreloadEquilibrium equilibrium(const ReducedModel& model, const TiltedArea& area,
                                        const std::vector<contact::SurfaceLaw>& laws, double load) {
  const contact::ContactArea cells(
      {area.r, area.p, model.weights.segment(area.begin, area.p.size())});
  const auto law = [&](Eigen::Index i, double approach) {
    const contact::SurfaceState state = laws[static_cast<std::size_t>(i)].at(approach, 0.0);
    return contact::NormalResponse{state.load, state.load_by_approach};
  };
  try {
    return contact::preload_equilibrium(
        cells, law,
        {.force = load * area.share, .moment_y = area.moment[1], .moment_z = area.moment[0]});
  } catch (const contact::PreloadError& error) {
    throw RefusedError(fmt::format("preload-unbalanced: {}: {}", area.key, error.what()));
  }
}

/// What a law needs as preload to rest at an approach.
double pressure_at(const contact::SurfaceLaw& law, double approach) {
  const double load = law.at(approach, 0.0).load;
  return load > 0.0 ? load : law.point().normal_stiffness * approach;
}

struct Moments {
  std::string key;
  std::array<double, 2> moment;  // about p and r [N m]
};

std::vector<Moments> moments_of(const SceneDescription& scene) {
  constexpr std::array none{0.0, 0.0};
  std::vector<Moments> moments;
  if (scene.contact && scene.contact->preload_moment != none) {
    moments.push_back({"contact.preload_moment", scene.contact->preload_moment});
  }
  if (const auto* modal = std::get_if<ModalModel>(&scene.model)) {
    for (const TiltedArea& area : modal->tilted_areas) {
      if (area.moment != none) moments.push_back({area.key, area.moment});
    }
  }
  return moments;
}

void require_pressing(const Moments& moments, const std::string& name, double load, const char* unit = "N") {
  if (load > 0.0) return;
  throw RefusedError(fmt::format(
      "preload-unbalanced: {} = {:g} {}: {} = [{:g}, {:g}] N m turns the contact under every preload, and {} "
      "carries no moment; leave this preload out, or the moments",
      name, load, unit, moments.key, moments.moment[0], moments.moment[1],
      load < 0.0 ? "a gap (a negative preload)" : "a contact without load"));
}

}  // namespace

void require_pressing_loads(const SceneDescription& scene) {
  for (const Moments& moments : moments_of(scene)) {
    for (std::size_t i = 0; i < scene.response->preload.size(); ++i) {
      const auto* load = std::get_if<double>(&scene.response->preload[i]);
      const auto* gap = std::get_if<UniformGap>(&scene.response->preload[i]);
      const std::string place = fmt::format("response.preload[{}]", i);
      if (load != nullptr) require_pressing(moments, place, *load);
      if (gap != nullptr) require_pressing(moments, place + ": minus the gap", -gap->width, "m");
    }
    const auto& optimum = scene.response->optimum;
    if (optimum && optimum->of_preload() && optimum->range) {
      require_pressing(moments, "response.optimum_range[0]", (*optimum->range)[0]);
    }
  }
}

Eigen::VectorXd tilted_pressures(const ReducedModel& model, const TiltedArea& area, double load,
                                 bool on_vertices) {
  const Eigen::Index n_points = area.p.size();
  std::vector<contact::SurfaceLaw> laws =
      touching_surfaces(model, area, area.begin, n_points, false);
  const contact::PreloadEquilibrium rest = equilibrium(model, area, laws, load);
  Eigen::VectorXd p = area.p;
  Eigen::VectorXd r = area.r;
  if (on_vertices) {
    p = along(model, model.vertices, 0);
    r = along(model, model.vertices, 2);
    laws = touching_surfaces(model, area, 0, p.size(), true);
  }
  Eigen::VectorXd pressure(p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    const double approach = rest.approach + p[i] * rest.rotation_y - r[i] * rest.rotation_z;
    pressure[i] = pressure_at(laws[static_cast<std::size_t>(i)], approach);
  }
  return pressure;
}

}  // namespace microslip::pipelines
