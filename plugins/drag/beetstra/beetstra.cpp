// SPDX-License-Identifier: Apache-2.0
#include "beetstra.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::beetstra;
namespace sdk = dust::sdk;

class Beetstra final : public sdk::DragLaw {
 public:
  struct Parameters {
    bool polydisperse = false;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.boolean(&Parameters::polydisperse, "polydisperse",
              "Whether a grain's drag depends on its size relative to its neighbours'.")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "beetstra",
        .version = "1.0",
        .summary =
            "Drag in random arrays of spheres of one or several sizes, lattice-Boltzmann, to Re "
            "1000.",
        .equation =
            R"(F = \varepsilon F_B(Re, \varepsilon);\ F_i = (y_i + 0.064 y_i^3)\, \varepsilon F_B(Re / y_i, \varepsilon),\ y_i = D_i / \langle D \rangle)",
        .source =
            "Beetstra, van der Hoef and Kuipers, AIChE J. 53 (2007) 489-501, "
            "doi:10.1002/aic.11065"};
  }
  explicit Beetstra(const Parameters& p) : is_polydisperse_(p.polydisperse) {}

  [[nodiscard]] bool needs_size_ratio() const override { return is_polydisperse_; }
  void evaluate(const sdk::DragBatch& batch) const override {
    if (!is_polydisperse_) {
      for (std::size_t g = 0; g < batch.count; ++g) {
        batch.factor[g] = formula::factor(batch.reynolds[g], batch.void_fraction[g]);
      }
      return;
    }
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] =
          formula::factor(batch.reynolds[g], batch.void_fraction[g], batch.size_ratio[g]);
    }
  }

 private:
  bool is_polydisperse_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Beetstra>(); }
