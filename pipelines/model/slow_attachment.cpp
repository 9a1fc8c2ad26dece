#include "pipelines/model/slow_attachment.hpp"

#include <algorithm>

namespace microslip::pipelines {
namespace {

// The tenth harmonic of the excitation is off by (10/20)² of a part that is some percent of the
// motion, the first by (1/20)².
constexpr double above_excitation = 20.0;
constexpr double above_modes = 2.0;

void scale_columns(contact::ModalShapes& shapes, const Eigen::VectorXd& factors) {
  for (Eigen::MatrixXd* along : {&shapes.u, &shapes.v, &shapes.w}) {
    if (along->cols() == factors.size()) *along = *along * factors.asDiagonal();
  }
}

}  // namespace

Eigen::VectorXd slowing(const ReducedModel& model, double frequency) {
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(model.frequency.size());
  const Eigen::Index n_free = factors.size() - model.n_attachment;
  if (n_free == 0) return factors;
  const double limit =
      std::max(above_modes * model.frequency.head(n_free).maxCoeff(), above_excitation * frequency);
  for (Eigen::Index i = n_free; i < factors.size(); ++i) {
    factors[i] = std::min(1.0, limit / model.frequency[i]);
  }
  return factors;
}

ReducedModel slowed(ReducedModel model, const Eigen::VectorXd& factors) {
  model.coordinates = {};  // of other modes
  for (Eigen::VectorXd* values : {&model.frequency, &model.force_sine, &model.force_cosine,
                                  &model.force_static, &model.output}) {
    *values = values->cwiseProduct(factors);
  }
  for (contact::Patch& patch : model.patches) {
    scale_columns(patch.cells.shapes, factors);
    scale_columns(patch.vertices.shapes, factors);
  }
  return model;
}

}  // namespace microslip::pipelines
