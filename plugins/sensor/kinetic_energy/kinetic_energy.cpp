// SPDX-License-Identifier: Apache-2.0
#include "kinetic_energy.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::kinetic_energy;
namespace sdk = dust::sdk;

class KineticEnergy final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    double settled_below = 1e-9;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    sdk::declare_selection(s);
    s.number(&Parameters::settled_below, "settled_below", sdk::dimension::energy,
             "Mean energy per grain below which the grains count as settled.")
        .above(0)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "kinetic_energy",
            .version = "1.0",
            .summary =
                "Kinetic energy of the grains, its mean per grain, and the granular temperature.",
            .equation =
                R"(E = \sum_i w_i \left(\tfrac12 m_i v_i^2 + \tfrac15 m_i R_i^2 \omega_i^2\right))",
            .source =
                "Haff, J. Fluid Mech. 134 (1983) 401, doi:10.1017/S0022112083003419 (temperature)"};
  }

  explicit KineticEnergy(const Parameters& p) : p_(p) {}

  void observe(const sdk::WorldView& world) override {
    formula::Sums sums;
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      sums += formula::Sums::of_grain(
          g.weight[i], g.mass[i], 0.5 * g.diameter[i],
          {g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]},
          {g.angular_velocity_x[i], g.angular_velocity_y[i], g.angular_velocity_z[i]});
    }
    values_ = {sums.translation, sums.rotation, sums.mean_per_grain(), sums.temperature()};
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
    // The last time from which on the grains were slow.
    const bool is_settled = sums.number > 0.0 && sums.mean_per_grain() < p_.settled_below;
    if (is_settled && !is_settled_) settled_at_ = world.time;
    is_settled_ = is_settled;
    if (sums.number > 0.0) curve_.add(world.time, values_[2]);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) {
      sink.figure(k_names[n], values_[n], k_units[n],
                  sdk::error_beside(values_[n], sdk::k_no_estimate), sdk::detail(k_quantities[n]));
    }
  }
  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) {
      const sdk::Quantity quantity = k_quantities[n];
      sink.figure(k_names[n], means_.mean(n), k_units[n], means_.error(n),
                  n == 0 ? sdk::overview(quantity, 1) : sdk::detail(quantity));
      sink.figure(std::string(k_names[n]) + "_at_end", values_[n], k_units[n],
                  sdk::error_beside(values_[n], sdk::k_no_estimate), sdk::detail(quantity));
    }
    sink.figure("is_settled", is_settled_ ? 1.0 : 0.0, "1", sdk::Quantity::number);
    const double settled_at = is_settled_ ? settled_at_ : sdk::k_no_value;
    sink.figure("settled_at", settled_at, "s", sdk::error_beside(settled_at, sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::time));
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Kinetic energy", "time [s]", "mean per grain [J]", "all grains", curve_.x(),
               curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    a.number("settled_at", settled_at_);
    a.integer("is_settled", is_settled_ ? 1 : 0);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    values_ = a.numbers("values");
    settled_at_ = a.number("settled_at");
    is_settled_ = a.integer("is_settled") != 0;
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr std::size_t k_columns = 4;
  static constexpr const char* k_names[k_columns] = {"translation", "rotation", "mean_per_grain",
                                                     "granular_temperature"};
  static constexpr const char* k_units[k_columns] = {"J", "J", "J", "m2/s2"};
  static constexpr sdk::Quantity k_quantities[k_columns] = {
      sdk::Quantity::energy, sdk::Quantity::energy, sdk::Quantity::energy,
      sdk::Quantity::granular_temperature};

  Parameters p_;
  /// At the last sample.
  std::vector<double> values_ = {0.0, 0.0, sdk::k_no_value, sdk::k_no_value};
  double settled_at_ = 0.0;  ///< [s]
  bool is_settled_ = false;
  sdk::KnownMeans means_{k_columns};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<KineticEnergy>(); }
