// SPDX-License-Identifier: Apache-2.0
#include "shear.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

namespace formula = dust::model::shear;
namespace sdk = dust::sdk;

class Shear final : public sdk::LiberationLaw {
 public:
  struct Parameters : sdk::WindErosion {
    double held_moisture = 0.005;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    sdk::declare_wind_erosion(s);
    s.number(&Parameters::held_moisture, "held_moisture", sdk::dimension::none,
             "Moisture that pores and clay hold without binding the dust.")
        .symbol("w'")
        .at_least(0)
        .at_most(1)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "shear",
            .version = "1.0",
            .summary = "Wind over grains takes dust off above a threshold of its shear.",
            .equation = R"(F = \alpha \frac{\rho_f}{g} u_*^3 \left(1 - u_{*t}^2/u_*^2\right),\ )"
                        R"(u_{*t}^2 = 0.0123 \left(\frac{\rho_p}{\rho_f} g d + )"
                        R"(\frac{\gamma}{\rho_f d}\right)\left(1 + 1.21 (w - w')^{0.68}\right))",
            .source =
                "Shao and Lu, J. Geophys. Res. 105 (2000) 22437, "
                "doi:10.1029/2000JD900304; Fecan, Marticorena and Bergametti, Ann. "
                "Geophysicae 17 (1999) 149, doi:10.1007/s00585-999-0149-7; Marticorena and "
                "Bergametti, J. Geophys. Res. 100 (1995) 16415, doi:10.1029/95JD00690"};
  }
  explicit Shear(const Parameters& p) : p_(p) {}

  void prepare(const sdk::DustProperties& dust) override {
    if (!(dust.gravity > 0.0)) {
      throw sdk::ParameterError(
          "the law 'shear' knows no threshold without gravity; give gravity, or the law 'energy'");
    }
    gas_density_ = dust.gas_density;
    gravity_ = dust.gravity;
    threshold_.clear();
    for (std::size_t k = 0; k < dust.classes; ++k) {
      threshold_.push_back(formula::threshold(dust.diameter[k], dust.density, dust.gas_density,
                                              p_.cohesion, dust.gravity));
    }
  }
  [[nodiscard]] bool needs_wind() const override { return true; }
  [[nodiscard]] bool uses_moisture() const override { return true; }

  void in_contacts(const sdk::GrainImpacts& impacts) const override {
    const sdk::DustyGrains& g = impacts.grains;
    for (std::size_t k = 0; k < g.classes; ++k) {
      for (std::size_t q = 0; q < g.count; ++q) g.released[k * g.stride + q] = 0.0;
    }
  }

  void in_wind(const sdk::GrainWind& wind) const override {
    const sdk::DustyGrains& g = wind.grains;
    for (std::size_t q = 0; q < g.count; ++q) {
      const double friction_velocity = std::sqrt(wind.shear[q] / gas_density_);
      const double raised = formula::raised_by_moisture(g.moisture[q], p_.held_moisture);
      const double area = std::numbers::pi * g.diameter[q] * g.diameter[q];
      const double fresh = g.fresh_sum(q);
      for (std::size_t k = 0; k < g.classes; ++k) {
        const std::size_t at = k * g.stride + q;
        const double flux = formula::flux(friction_velocity, raised * threshold_[k], gas_density_,
                                          p_.emission_coefficient, gravity_);
        g.released[at] = formula::released(g.load[at], fresh, flux * area * g.time_step);
      }
    }
  }

 private:
  Parameters p_;
  double gas_density_ = 0.0;       ///< [kg/m3]
  double gravity_ = 0.0;           ///< [m/s2]
  std::vector<double> threshold_;  ///< [m/s] of dry dust, by class
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Shear>(); }
