/// @file
/// Curves, their errors, their maps and the best value that earlier runs have solved for
/// (system/result_cache.hpp): a scene that asks for another preload solves for that one alone.
#pragma once

#include <optional>
#include <string>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/record/pictures.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// What a search comes to.
struct BestValue {
  solver::Optimum optimum;
  CurveBudget budget{};
  std::optional<OptimumBracket> bracket{};
};

/// Nothing is found or kept where the run has no cache. What follows from less than all there is,
/// as time was over or an interrupt came, and what was solved for in no time, is not kept.
class KeptResults {
 public:
  /// @param model  borrowed.
  /// @param scene  its settings are those of the model, whatever its text says.
  KeptResults(const ReducedModel& model, const SceneDescription& scene);

  /// @param near  where it begins (response_stage.hpp); nullptr: nothing is known of it.
  [[nodiscard]] std::optional<CurveResult> curve(const CurveRequest& request,
                                                 const solver::ResponseCurve* near = nullptr) const;
  /// @param curve  of this model, begun there.
  void keep(const CurveResult& curve, const solver::ResponseCurve* near = nullptr) const;

  /// What is known of the errors of this curve alone.
  [[nodiscard]] std::optional<CurveBudget> budget(const CurveResult& curve) const;
  void keep(const CurveBudget& budget, const CurveResult& curve) const;

  /// Maps of this curve and its motion, where the model is that of the maps.
  [[nodiscard]] std::optional<Pictures> pictures(const CurveResult& curve) const;
  void keep(const Pictures& pictures, const CurveResult& curve) const;

  [[nodiscard]] std::optional<BestValue> best_value() const;
  void keep(const BestValue& best) const;

 private:
  [[nodiscard]] bool is_worth(long evaluations) const;

  const ReducedModel& model_;
  double n_points_ = 0.0;
  std::string curves_;  ///< all that they follow from, their loads apart
  std::string best_;    ///< likewise
  std::string maps_;    ///< which maps, as the scene says
};

}  // namespace microslip::pipelines
