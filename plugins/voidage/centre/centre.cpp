// SPDX-License-Identifier: Apache-2.0
#include "centre.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::centre;
namespace sdk = dust::sdk;

class Centre final : public sdk::VoidageRule {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {
        .name = "centre",
        .version = "1.0",
        .summary = "All of a grain's volume goes to the cell of its centre.",
        .equation = R"(\varepsilon = 1 - \frac{1}{V_c} \sum_{g:\, x_g \in C} V_g)",
        .source = "Hoomans et al., Chem. Eng. Sci. 51 (1996) 99, doi:10.1016/0009-2509(95)00271-5"};
  }
  explicit Centre(const Parameters&) {}

  [[nodiscard]] int capacity(const sdk::GridShape&, double) const override { return 1; }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 0.5; }

  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const std::size_t first = g * static_cast<std::size_t>(batch.capacity);
      batch.used[g] = 1;
      batch.cell_i[first] = formula::cell_of(batch.position.x[g], grid.origin.x, grid.spacing.x);
      batch.cell_j[first] = formula::cell_of(batch.position.y[g], grid.origin.y, grid.spacing.y);
      batch.cell_k[first] = formula::cell_of(batch.position.z[g], grid.origin.z, grid.spacing.z);
      batch.weight[first] = 1.0;
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Centre>(); }
