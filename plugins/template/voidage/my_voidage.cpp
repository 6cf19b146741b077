// SPDX-License-Identifier: Apache-2.0
#include "my_voidage.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_voidage;
namespace sdk = dust::sdk;

class MyVoidage final : public sdk::VoidageRule {
 public:
  // 1. What a scenario may say: nothing.
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_voidage",
            .version = "1.0",
            .summary = "Each grain counts as a cube of its volume, cut exactly by the cells.",
            .equation = "\\varepsilon = 1 - \\frac{1}{V_c} \\sum_g |Q_g \\cap C|",
            .source = "own definition"};
  }
  explicit MyVoidage(const Parameters&) {}

  // 3. A cube not larger than a cell touches at most two cells per direction.
  [[nodiscard]] int capacity(const sdk::GridShape&, double) const override { return 8; }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 1.0; }

  // 4. The rule on a batch; the shares of each grain sum to 1.
  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double side = formula::k_side * batch.radius[g];
      const auto x = formula::shares(batch.position.x[g], side, grid.origin.x, grid.spacing.x);
      const auto y = formula::shares(batch.position.y[g], side, grid.origin.y, grid.spacing.y);
      const auto z = formula::shares(batch.position.z[g], side, grid.origin.z, grid.spacing.z);
      int used = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1;
        const int j = corner >> 1 & 1;
        const int k = corner >> 2;
        const double weight = (i == 0 ? x.in_first : 1.0 - x.in_first) *
                              (j == 0 ? y.in_first : 1.0 - y.in_first) *
                              (k == 0 ? z.in_first : 1.0 - z.in_first);
        if (weight == 0.0) continue;
        const std::size_t row =
            g * static_cast<std::size_t>(batch.capacity) + static_cast<std::size_t>(used++);
        batch.cell_i[row] = x.first + i;
        batch.cell_j[row] = y.first + j;
        batch.cell_k[row] = z.first + k;
        batch.weight[row] = weight;
      }
      batch.used[g] = used;
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyVoidage>(); }
