// SPDX-License-Identifier: Apache-2.0
#include "liquid_bridge.hpp"

#include <dust/sdk/plugin.hpp>

#include <sstream>
#include <vector>

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
    std::vector<double> moisture;
    double liquid_density = 1000.0;
    double coordination = 6.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::surface_tension, "surface_tension", sdk::dimension::surface_energy,
             "Surface tension of the liquid.")
        .symbol("\\gamma")
        .above(0)
        .usual(0.01, 2);
    s.number(&Parameters::contact_angle, "contact_angle", sdk::dimension::angle,
             "Angle at which the liquid meets the grains.")
        .symbol("\\theta")
        .at_least(0)
        .below(std::numbers::pi / 2)
        .optional();
    s.number(&Parameters::volume, "volume", sdk::dimension::volume,
             "Liquid in every bridge; give this, relative_volume or moisture.")
        .symbol("V")
        .at_least(0)
        .optional();
    s.number(&Parameters::relative_volume, "relative_volume", sdk::dimension::none,
             "Liquid in a bridge over (2 R*)^3, for two equal grains over the cube of their "
             "radius; give this, volume or moisture.")
        .symbol("V^*")
        .at_least(0)
        .at_most(formula::k_largest_relative_volume)
        .optional();
    s.numbers(
         &Parameters::moisture, "moisture", sdk::dimension::none,
         "Liquid over dry solids, by mass, of the two materials in the order of `between`; left "
         "out with both volumes: their own `moisture`. Of two moist materials each brings its "
         "part; a dry one is taken for a wall.")
        .symbol("M")
        .at_least(0)
        .at_most(formula::k_largest_moisture)
        .optional();
    s.number(&Parameters::liquid_density, "liquid_density", sdk::dimension::density,
             "Density of the liquid, for moisture.")
        .symbol("\\rho_l")
        .above(0)
        .optional();
    s.number(&Parameters::coordination, "coordination", sdk::dimension::none,
             "Bridges that a grain shares its liquid among, for moisture.")
        .symbol("k")
        .at_least(1)
        .at_most(14)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "liquid_bridge",
        .version = "1.0",
        .summary =
            "Capillary force of a pendular bridge that forms at touch and breaks at a "
            "distance.",
        .equation =
            "F_c = \\frac{4 \\pi R^* \\gamma \\cos\\theta}{1 + 1.05 \\hat S + 2.5 \\hat S^2},"
            "\\quad \\hat S = S \\sqrt{2 R^*/V},\\quad S_c = (1 + \\theta/2) V^{1/3},"
            "\\quad V = \\frac{4 \\pi}{3} \\frac{M_i \\rho_i + M_j \\rho_j}{k \\rho_l} (2 R^*)^3",
        .source =
            "Willett, Adams, Johnson, Seville, Langmuir 16 (2000) 9396, "
            "doi:10.1021/la000657y; Lian, Thornton, Adams, J. Colloid Interface Sci. 161 "
            "(1993) 138, doi:10.1006/jcis.1993.1452; k: Kohonen, Geromichalos, Scheel, Schier, "
            "Herminghaus, Physica A 339 (2004) 7, doi:10.1016/j.physa.2004.03.047"};
  }

  explicit LiquidBridge(const Parameters& p) {
    const int given = (p.volume > 0.0) + (p.relative_volume > 0.0) + !p.moisture.empty();
    if (given != 1) {
      throw sdk::ParameterError(
          "a bridge needs its liquid: give volume, relative_volume or moisture (of the law or of "
          "the "
          "materials), one of the three");
    }
    if (!p.moisture.empty() && p.moisture.size() != 2) {
      throw sdk::ParameterError(
          "moisture: two numbers are expected, of the two materials in the order of between, like "
          "[2 %, 0]");
    }
    moisture_ = p.moisture;
    liquid_density_ = p.liquid_density;
    coordination_ = p.coordination;
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
    if (!moisture_.empty()) moisten(i.density, j.density);
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
  void moisten(double density_i, double density_j) {
    const double volume = formula::relative_volume(
        moisture_[0] * density_i, moisture_[1] * density_j, liquid_density_, coordination_);
    if (volume > formula::k_largest_relative_volume) {
      std::ostringstream text;
      text
          << "moisture: puts " << volume
          << " (2 R*)^3 of liquid into a bridge; bridges are small and apart from each other up to "
          << formula::k_largest_relative_volume << ": give at most "
          << formula::k_largest_relative_volume / volume << " times that moisture";
      throw sdk::ParameterError(text.str());
    }
    constants_.relative_volume = volume;
    constants_.relative_root = std::cbrt(volume);
    if (volume > 0.0) return;
    // Dry: no force, no reach, and a volume that can be divided by.
    constants_.surface_tension = constants_.stretch = 0.0;
    constants_.relative_volume = 1.0;
  }

  formula::Constants constants_;
  std::vector<double> moisture_;
  double liquid_density_ = 1000.0;
  double coordination_ = 6.0;
  double young_ = 0.0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<LiquidBridge>(); }
