#include "contact/line/band_quadrature.hpp"

#include "contact/numerics/gauss_legendre.hpp"

namespace microslip::contact {
namespace {

BandPanel make_panel() {
  const LineRule rule = gauss_legendre(n_band_nodes);
  BandPanel panel;
  for (int i = 0; i < n_band_nodes; ++i) {
    const double x = 2.0 * rule.nodes[i] - 1.0;
    panel.node[static_cast<std::size_t>(i)] = x;
    panel.weight[i] = 2.0 * rule.weights[i];
    for (int k = 0; k < 4; ++k) {
      const double counted = std::pow(0.1, 3 - k);
      panel.top(k, i) = counted * (k + n_band_nodes - 3.5) * panel.weight[i] *
                        std::legendre(static_cast<unsigned>(k + n_band_nodes - 4), x);
    }
  }
  return panel;
}

}  // namespace

const BandPanel& band_panel() {
  static const BandPanel rule = make_panel();
  return rule;
}

double band_friction(const SliderBand& band, const BandPiece& piece, const BandInstant& now) {
  if (!band.has_spring() || piece.state == ContactState::separated) return 0.0;
  const SurfaceState& y = now.surface;
  if (piece.state != ContactState::stick) {
    return piece.slip_sign() * y.friction_coefficient * y.load;
  }
  return band.law().first_stiffness() * y.stiffness_ratio * (now.position - piece.slider);
}

}  // namespace microslip::contact
