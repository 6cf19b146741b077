// SPDX-License-Identifier: Apache-2.0
#include "energy.hpp"

#include "../moisture.hpp"

#include <dust/sdk/plugin.hpp>

#include <vector>

namespace {

namespace formula = dust::model::energy;
namespace sdk = dust::sdk;

class Energy final : public sdk::LiberationLaw {
 public:
  struct Parameters {
    double binding_energy = 0.0;
    double reference_diameter = 10e-6;
    double size_exponent = 5.0 / 3.0;
    double sliding_share = 1.0;
    double reference_moisture = 0.01;
    double moisture_scale = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::binding_energy, "binding_energy", sdk::dimension::specific_energy,
             "Energy dissipated in contacts that sets a mass of dust free, for dust of the "
             "reference diameter at the reference moisture.")
        .symbol("e_b")
        .above(0)
        .usual(1e2, 1e9);
    s.number(&Parameters::reference_diameter, "reference_diameter", sdk::dimension::length,
             "Diameter of the dust that the binding energy is given for.")
        .symbol("d_0")
        .above(0)
        .optional();
    s.number(&Parameters::size_exponent, "size_exponent", sdk::dimension::none,
             "By which power of the diameter the binding energy falls: 5/3 as the work to part "
             "two spheres of JKR over their mass.")
        .symbol("n")
        .at_least(0)
        .optional();
    s.number(&Parameters::sliding_share, "sliding_share", sdk::dimension::none,
             "Share of the energy dissipated by sliding and rolling that counts, beside that of "
             "impacts.")
        .symbol("s")
        .at_least(0)
        .at_most(1)
        .optional();
    dust::model::add_moisture(s, "binding energy");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "energy",
            .version = "1.0",
            .summary = "Dust comes off by the energy that contacts dissipate.",
            .equation = R"(\Delta m = m \left(1 - e^{-E/(m_0 e_b)}\right),\ E = E_n + s E_t,\ )"
                        R"(e_b = e_{b,0} (d/d_0)^{-n}\, b(M),\ b = (M/M_0)^{1.4} )"
                        R"((M, M_0 \ge 0.25\,\%),\ \text{with } M_1:\ 10^{(M - M_0)/M_1})",
            .source =
                "Hilton and Cleary, Int. J. Numer. Meth. Fluids 72 (2013) 528, "
                "doi:10.1002/fld.3750; AP-42, 13.2.4 (2006)"};
  }
  explicit Energy(const Parameters& p) : p_(p) {}

  void prepare(const sdk::DustProperties& dust) override {
    binding_.clear();
    for (std::size_t k = 0; k < dust.classes; ++k) {
      binding_.push_back(formula::binding_of(dust.diameter[k], p_.binding_energy,
                                             p_.reference_diameter, p_.size_exponent));
    }
  }
  [[nodiscard]] bool uses_moisture() const override { return true; }

  /// Classes share the energy as they shared the fresh load.
  void in_contacts(const sdk::GrainImpacts& impacts) const override {
    const sdk::DustyGrains& g = impacts.grains;
    for (std::size_t q = 0; q < g.count; ++q) {
      const double energy =
          impacts.normal_energy[q] + p_.sliding_share * impacts.tangential_energy[q];
      const double binds =
          dust::model::binding_by_moisture(g.moisture[q], p_.reference_moisture, p_.moisture_scale);
      const double fresh = g.fresh_sum(q);
      for (std::size_t k = 0; k < g.classes; ++k) {
        const std::size_t at = k * g.stride + q;
        g.released[at] = formula::released(g.load[at], fresh, energy, binding_[k] * binds);
      }
    }
  }

 private:
  Parameters p_;
  std::vector<double> binding_;  ///< [J/kg] by class
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Energy>(); }
