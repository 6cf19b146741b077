// SPDX-License-Identifier: Apache-2.0
#include "liquid_bridge.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::liquid_bridge;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(const formula::Constants& constants, const sdk::CohesionBatch& b) {
  const formula::Constants k = constants;
  const double *overlap = b.overlap, *radius = b.effective_radius;
  double *seen = b.contact_overlap, *attraction = b.attraction, *bridged = b.history[0];
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Bridge c{overlap[q], radius[q], bridged[q], 0.0};
    formula::evaluate(k, c);
    seen[q] = overlap[q];
    attraction[q] = c.attraction;
    bridged[q] = c.is_bridged;
  }
}

class LiquidBridge final : public sdk::CohesionLaw {
 public:
  struct Parameters {
    double surface_tension = 0.0;
    double contact_angle = 0.0;
    double volume = 0.0;
    double relative_volume = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::surface_tension, "surface_tension", sdk::dimension::surface_energy,
             "Surface tension of the liquid.")
        .symbol("\\gamma")
        .above(0);
    s.number(&Parameters::contact_angle, "contact_angle", sdk::dimension::angle,
             "Angle at which the liquid meets the grains.")
        .symbol("\\theta")
        .at_least(0)
        .below(std::numbers::pi / 2)
        .optional();
    s.number(&Parameters::volume, "volume", sdk::dimension::volume,
             "Liquid in every bridge; give this or relative_volume.")
        .symbol("V")
        .at_least(0)
        .optional();
    s.number(&Parameters::relative_volume, "relative_volume", sdk::dimension::none,
             "Liquid in a bridge over (2 R*)^3, for two equal grains over the cube of their "
             "radius; give this or volume.")
        .symbol("V^*")
        .at_least(0)
        .at_most(0.1)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "liquid_bridge",
            .version = "1.0",
            .summary =
                "Capillary force of a pendular bridge that forms at touch and breaks at a "
                "distance.",
            .equation =
                "F_c = \\frac{4 \\pi R^* \\gamma \\cos\\theta}{1 + 1.05 \\hat S + 2.5 \\hat S^2},"
                "\\quad \\hat S = S \\sqrt{2 R^*/V},\\quad S_c = (1 + \\theta/2) V^{1/3}",
            .source =
                "Willett, Adams, Johnson, Seville, Langmuir 16 (2000) 9396, "
                "doi:10.1021/la000657y; Lian, Thornton, Adams, J. Colloid Interface Sci. 161 "
                "(1993) 138, doi:10.1006/jcis.1993.1452"};
  }

  explicit LiquidBridge(const Parameters& p) {
    if ((p.volume > 0.0) == (p.relative_volume > 0.0)) {
      throw sdk::ParameterError(
          "a bridge needs its liquid: give volume or relative_volume, one "
          "of both");
    }
    constants_.surface_tension = p.surface_tension;
    constants_.cosine = std::cos(p.contact_angle);
    constants_.stretch = 1.0 + 0.5 * p.contact_angle;
    constants_.volume = p.volume;
    constants_.relative_volume = p.relative_volume;
    constants_.volume_root = std::cbrt(p.volume);
    constants_.relative_root = std::cbrt(p.relative_volume);
  }
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    young_ = sdk::effective_young_modulus(i, j);
  }
  [[nodiscard]] int history_size() const override { return 1; }
  void evaluate(const sdk::CohesionBatch& batch) const override {
    evaluate_batch(constants_, batch);
  }
  [[nodiscard]] double range(double radius) const override {
    return formula::rupture_distance(constants_, radius);
  }
  [[nodiscard]] double resting_overlap(double radius) const override {
    // 4/3 E* sqrt(R*) d^(3/2) = F
    const double root = std::cbrt(0.75 * formula::force_at_touch(constants_, radius) /
                                  (young_ * std::sqrt(radius)));
    return root * root;
  }

 private:
  formula::Constants constants_;
  double young_ = 0.0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<LiquidBridge>(); }
