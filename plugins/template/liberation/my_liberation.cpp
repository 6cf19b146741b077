// SPDX-License-Identifier: Apache-2.0
#include "my_liberation.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_liberation;
namespace sdk = dust::sdk;

class MyLiberation final : public sdk::LiberationLaw {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double specific_energy = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::specific_energy, "specific_energy", sdk::dimension::specific_energy,
             "Dissipated energy per mass of the grain that leaves a share 1/e of its dust.")
        .symbol("e")
        .above(0);
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_liberation",
            .version = "1.0",
            .summary = "Dust comes off by the energy per mass of the grain.",
            .equation = "\\Delta m = m (1 - e^{-E/(M e)})",
            .source = "your own"};
  }

  explicit MyLiberation(const Parameters& p) : p_(p) {}

  // 3. Once, before any batch: the classes of dust, the gas, gravity.
  void prepare(const sdk::DustProperties&) override {}

  // 4. The law on a batch of grains: columns in, columns out; no allocation, no lock, no state.
  void in_contacts(const sdk::GrainImpacts& impacts) const override {
    const sdk::DustyGrains& grains = impacts.grains;
    for (std::size_t k = 0; k < grains.classes; ++k) {
      for (std::size_t n = 0; n < grains.count; ++n) {
        const std::size_t at = k * grains.stride + n;
        grains.released[at] = formula::released(
            grains.load[at], impacts.normal_energy[n] + impacts.tangential_energy[n],
            grains.mass[n], p_.specific_energy);
      }
    }
  }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyLiberation>(); }
