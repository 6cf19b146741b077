// SPDX-License-Identifier: Apache-2.0
#include "lubrication.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::lubrication;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(const formula::Constants& constants, const sdk::CohesionBatch& b) {
  const formula::Constants k = constants;
  const double *overlap = b.overlap, *radius = b.effective_radius, *mass = b.effective_mass;
  const double* speed = b.normal_velocity;
  const double time_step = b.time_step;
  double *seen = b.contact_overlap, *attraction = b.attraction;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    seen[q] = overlap[q];
    const double resistance = formula::resistance(k, radius[q], -overlap[q]);
    attraction[q] = formula::attraction(k, resistance, speed[q], mass[q], time_step);
  }
}

class Lubrication final : public sdk::CohesionLaw {
 public:
  struct Parameters {
    double viscosity = 0.0;
    double smallest_gap = 1e-3;
    double reach = 1.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::viscosity, "viscosity", sdk::dimension::dynamic_viscosity,
             "Viscosity of the fluid between the grains.")
        .symbol("\\mu")
        .above(0)
        .usual(1e-6, 1000);
    s.number(&Parameters::smallest_gap, "smallest_gap", sdk::dimension::none,
             "Gap over R* at which the force stops growing: the grains' roughness.")
        .symbol("\\delta_0")
        .above(0)
        .at_most(0.1)
        .optional();
    s.number(&Parameters::reach, "reach", sdk::dimension::none,
             "Gap over R* beyond which it does not act; above smallest_gap.")
        .symbol("\\delta_r")
        .above(0.001)
        .at_most(10)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "lubrication",
            .version = "1.0",
            .summary = "Fluid squeezed from between two grains resists their approach and parting.",
            .equation =
                "F = -6 \\pi \\mu R^{*2} v_n \\left(\\frac{1}{h} - \\frac{1}{h_r}\\right),"
                "\\quad h = \\max(s, \\delta_0 R^*),\\quad h_r = \\delta_r R^*",
            .source =
                "leading term of Jeffrey, Onishi, J. Fluid Mech. 139 (1984) 261, "
                "doi:10.1017/S0022112084000355"};
  }

  explicit Lubrication(const Parameters& p)
      : constants_{p.viscosity, p.smallest_gap, p.reach, formula::largest_resistance(p.reach)} {
    if (!(p.reach > p.smallest_gap)) {
      throw sdk::ParameterError(
          "reach must lie above smallest_gap, for the film acts between the two: give less of the "
          "one or more of the other");
    }
  }
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const sdk::CohesionBatch& batch) const override {
    evaluate_batch(constants_, batch);
  }
  [[nodiscard]] double range(double radius) const override { return constants_.reach * radius; }
  [[nodiscard]] double resting_overlap(double) const override { return 0.0; }

 private:
  formula::Constants constants_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Lubrication>(); }
