// SPDX-License-Identifier: Apache-2.0
#include "basset.hpp"

#include "../acceleration_number.hpp"

#include <dust/sdk/plugin.hpp>

#include <string>

namespace {

namespace formula = dust::model::basset;
namespace sdk = dust::sdk;

class Basset final : public sdk::FluidForce {
 public:
  struct Parameters {
    double window = 1.0;
    bool sudden_start = true;
    std::string acceleration = "any";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::window, "window", sdk::dimension::time,
             "How far back the history is looked at; what is older is forgotten.")
        .symbol("T")
        .above(0)
        .optional();
    s.boolean(&Parameters::sudden_start, "sudden_start",
              "Whether a new grain came into its slip at that instant; else it had it for long.")
        .optional();
    s.text(&Parameters::acceleration, "acceleration",
           "The coefficient at any acceleration, or falling with the acceleration number as Odar "
           "and Hamilton measured.")
        .one_of({"any", "odar_hamilton"})
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "basset",
        .version = "1.0",
        .summary = "Memory of the viscous layer round an accelerating grain.",
        .equation =
            R"(f = \frac32 D^2 \sqrt{\pi \rho_f \mu} \int_{t - T}^{t} \frac{dw / dt'}{\sqrt{t - t'}}\, dt')",
        .source =
            "Basset, A treatise on hydrodynamics, vol. 2 (1888), chapter 22; in this form Maxey, "
            "Riley, "
            "Phys. Fluids 26 (1983) 883-889, doi:10.1063/1.864230; over the acceleration number "
            "Odar, Hamilton, J. Fluid Mech. 18 (1964) 302-314, doi:10.1017/S0022112064000210"};
  }
  explicit Basset(const Parameters& p)
      : window_(p.window),
        is_sudden_(p.sudden_start),
        is_measured_(p.acceleration == "odar_hamilton") {}

  void evaluate(const sdk::FluidForceBatch& batch) const override {
    // Mean over the interval of the part that the interval itself makes, per acceleration.
    const double present = 4.0 / 3.0 * std::sqrt(batch.interval);
    for (std::size_t g = 0; g < batch.count; ++g) {
      double* row = batch.history + g * static_cast<std::size_t>(history_size());
      formula::History history(row);
      double c = formula::factor(batch.diameter[g], batch.density[g], batch.viscosity[g]);
      if (is_measured_) {
        dust::model::LastSlip last(row + formula::History::k_numbers);
        c *= dust::model::history_factor(
            last.note(batch.diameter[g], batch.slip[g], batch.interval));
      }
      history.note(batch.slip[g], is_sudden_);
      const sdk::Vec3 past = history.past(batch.interval, window_);
      batch.added_mass[g] = c * present;
      batch.force.set(g, c * (past + present * batch.acceleration[g]));
    }
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override { return {.acceleration = true}; }
  [[nodiscard]] int history_size() const override {
    return formula::History::k_numbers + (is_measured_ ? dust::model::LastSlip::k_numbers : 0);
  }

 private:
  double window_;
  bool is_sudden_;
  bool is_measured_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Basset>(); }
