// SPDX-License-Identifier: Apache-2.0
#include "force_ratio.hpp"

#include "../moisture.hpp"

#include <dust/sdk/plugin.hpp>

#include <vector>

namespace {

namespace formula = dust::model::force_ratio;
namespace sdk = dust::sdk;

class ForceRatio final : public sdk::LiberationLaw {
 public:
  struct Parameters {
    double binding_force = 0.0;
    double reference_diameter = 10e-6;
    double spread = 3.0;
    double reference_moisture = 0.01;
    double moisture_scale = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::binding_force, "binding_force", sdk::dimension::force,
             "Median force that binds a dust particle of the reference diameter to its grain, at "
             "the reference moisture; in proportion to the diameter.")
        .symbol("F_b")
        .above(0);
    s.number(&Parameters::reference_diameter, "reference_diameter", sdk::dimension::length,
             "Diameter of the dust that the binding force is given for.")
        .symbol("d_0")
        .above(0)
        .optional();
    s.number(&Parameters::spread, "spread", sdk::dimension::none,
             "Geometric standard deviation of the binding forces of dust of one size.")
        .symbol("sigma")
        .above(1)
        .optional();
    dust::model::add_moisture(s, "binding force");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "force_ratio",
            .version = "1.0",
            .summary = "Dust comes off where its inertia in an impact exceeds what binds it.",
            .equation = R"(\Delta m = \max\left(0, m - m_0 (1 - P)\right),\ )"
                        R"(P = \Phi\left(\frac{\ln R}{\ln \sigma}\right),\ )"
                        R"(R = \frac{\pi \rho_d d^3 a}{6 F_b},\ F_b = F_{b,0}\, (d/d_0)\, b(M),\ )"
                        R"(b = (M/M_0)^{1.4}\ (M, M_0 \ge 0.25\,\%),\ )"
                        R"(\text{with } M_1:\ 10^{(M - M_0)/M_1})",
            .source =
                "Plinke, Leith, Boundy and Loeffler, Am. Ind. Hyg. Assoc. J. 56 (1995) "
                "251; AP-42, 13.2.4 (2006)"};
  }
  explicit ForceRatio(const Parameters& p) : p_(p) {}

  void prepare(const sdk::DustProperties& dust) override {
    diameter_.assign(dust.diameter, dust.diameter + dust.classes);
    density_ = dust.density;
  }
  [[nodiscard]] bool uses_moisture() const override { return true; }

  void in_contacts(const sdk::GrainImpacts& impacts) const override {
    const sdk::DustyGrains& g = impacts.grains;
    for (std::size_t q = 0; q < g.count; ++q) {
      const double binds =
          dust::model::binding_by_moisture(g.moisture[q], p_.reference_moisture, p_.moisture_scale);
      for (std::size_t k = 0; k < g.classes; ++k) {
        const std::size_t at = k * g.stride + q;
        const double force = p_.binding_force * binds * diameter_[k] / p_.reference_diameter;
        const double ratio = formula::ratio(diameter_[k], density_, impacts.acceleration[q], force);
        g.released[at] =
            formula::released(g.load[at], g.fresh[at], formula::share_below(ratio, p_.spread));
      }
    }
  }

 private:
  Parameters p_;
  std::vector<double> diameter_;  ///< [m] by class
  double density_ = 0.0;          ///< [kg/m3]
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<ForceRatio>(); }
