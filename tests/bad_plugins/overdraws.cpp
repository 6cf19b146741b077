// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/plugin.hpp"

namespace {

/// Whatever touches sets free all of the load, and some of it once more.
struct Overdrawing final : dust::sdk::LiberationLaw {
  struct Parameters {
    double excess = 0.0;
  };
  static dust::sdk::ModelInfo describe() {
    return {.name = "overdraws",
            .version = "1.0",
            .summary = "More than all.",
            .equation = "",
            .source = ""};
  }
  static dust::sdk::ParameterSchema schema() {
    dust::sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::excess, "excess", dust::sdk::dimension::none, "Of the load, beyond it.");
    return s.build();
  }
  explicit Overdrawing(const Parameters& p) : p_(p) {}
  void prepare(const dust::sdk::DustProperties&) override {}
  void in_contacts(const dust::sdk::GrainImpacts& impacts) const override {
    const dust::sdk::DustyGrains& g = impacts.grains;
    for (std::size_t q = 0; q < g.count; ++q) {
      const bool is_touched = impacts.normal_energy[q] > 0.0;
      for (std::size_t k = 0; k < g.classes; ++k) {
        const std::size_t at = k * g.stride + q;
        g.released[at] = is_touched ? (1.0 + p_.excess) * g.load[at] : 0.0;
      }
    }
  }
  [[nodiscard]] bool uses_moisture() const override { return true; }

 private:
  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Overdrawing>(); }
