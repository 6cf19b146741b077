// SPDX-License-Identifier: Apache-2.0
#include "beetstra.hpp"

#include "dust/sdk/plugin.hpp"

namespace dust::model::beetstra {
namespace {

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
    sdk::ModelInfo info;
    info.name = "beetstra";
    info.version = "1.0";
    info.summary =
        "Drag in random arrays of spheres of one or several sizes, lattice-Boltzmann, to Re 1000.";
    info.equation =
        R"(F = \varepsilon F_B(Re, \varepsilon);\ F_i = (y_i + 0.064 y_i^3)\, \varepsilon F_B(Re / y_i, \varepsilon),\ y_i = D_i / \langle D \rangle)";
    info.source =
        "Beetstra, van der Hoef and Kuipers, AIChE J. 53 (2007) 489-501, doi:10.1002/aic.11065";
    return info;
  }
  explicit Beetstra(const Parameters& p) : is_polydisperse_(p.polydisperse) {}

  [[nodiscard]] bool needs_size_ratio() const override { return is_polydisperse_; }
  void evaluate(const sdk::DragBatch& batch) const override {
    if (!is_polydisperse_) {
      for (std::size_t g = 0; g < batch.count; ++g) {
        batch.factor[g] = factor(batch.reynolds[g], batch.void_fraction[g]);
      }
      return;
    }
    for (std::size_t g = 0; g < batch.count; ++g) {
      batch.factor[g] = factor(batch.reynolds[g], batch.void_fraction[g], batch.size_ratio[g]);
    }
  }

 private:
  bool is_polydisperse_;
};

}  // namespace
}  // namespace dust::model::beetstra

DUST_PLUGIN(registrar) { registrar.add<dust::model::beetstra::Beetstra>(); }
