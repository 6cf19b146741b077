// SPDX-License-Identifier: Apache-2.0
#include "given.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::given;
namespace sdk = dust::sdk;

class Given final : public sdk::LiberationLaw {
 public:
  struct Parameters {
    double emission = 0.0;
    double drop = 1.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::emission, "emission", sdk::dimension::none,
             "Dust set free per mass of material in a drop, as measured: 3.6 g/t.")
        .symbol("r")
        .at_least(0)
        .at_most(1);
    s.number(&Parameters::drop, "drop", sdk::dimension::length,
             "Height of that drop: what it dissipates is the weight times the height.")
        .symbol("H")
        .above(0)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "given",
            .version = "1.0",
            .summary = "Dust comes off as a measured drop says, in proportion to the energy.",
            .equation = R"(\Delta m_k = \min\left(m_k, s_k\, r\, \frac{E}{g H}\right))",
            .source = "own definition"};
  }
  explicit Given(const Parameters& p) : p_(p) {}

  void prepare(const sdk::DustProperties& dust) override {
    if (!(dust.gravity > 0.0)) {
      throw sdk::ParameterError(
          "the law 'given' measures by a drop: there is no gravity to drop by; give gravity, or "
          "the law 'energy'");
    }
    drop_ = dust.gravity * p_.drop;
  }

  void in_contacts(const sdk::GrainImpacts& impacts) const override {
    const sdk::DustyGrains& g = impacts.grains;
    for (std::size_t q = 0; q < g.count; ++q) {
      const double energy = impacts.normal_energy[q] + impacts.tangential_energy[q];
      const double fresh = g.fresh_sum(q);
      for (std::size_t k = 0; k < g.classes; ++k) {
        const std::size_t at = k * g.stride + q;
        const double share = fresh > 0.0 ? g.fresh[at] / fresh : 0.0;
        g.released[at] = formula::released(g.load[at], share, p_.emission, energy, drop_);
      }
    }
  }

 private:
  Parameters p_;
  double drop_ = 0.0;  ///< [J/kg]
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Given>(); }
