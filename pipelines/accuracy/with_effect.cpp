#include "pipelines/accuracy/with_effect.hpp"

namespace microslip::pipelines {

std::optional<solver::PeakOfBoth> at_its_frequency(const solver::Scene& own,
                                                   solver::ContinuationOptions options,
                                                   const solver::ResponsePoint& point,
                                                   const solver::OtherModel& with) {
  options.frequency_begin = options.frequency_end = point.frequency;
  solver::ResponseCurve alone;
  alone.points = {point};
  alone.points.front().mark = solver::PointMark::none;  // of a peak the frequency would move
  return solver::peak_elsewhere(own, options, alone, {with.scene, with.embedding, 1.0});
}

double load_with(const ReducedModel& richer, const ReducedModel& model, double load) {
  return load == model.static_preload ? richer.static_preload.value_or(load) : load;
}

}  // namespace microslip::pipelines
