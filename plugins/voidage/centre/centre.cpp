// SPDX-License-Identifier: Apache-2.0
#include "centre.hpp"

#include "dust/sdk/plugin.hpp"

namespace dust::model::centre {
namespace {

class Centre final : public sdk::VoidageRule {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    sdk::ModelInfo info;
    info.name = "centre";
    info.version = "1.0";
    info.summary = "All of a grain's volume goes to the cell of its centre.";
    info.equation = R"(\varepsilon = 1 - \frac{1}{V_c} \sum_{g:\, x_g \in C} V_g)";
    info.source = "Hoomans et al., Chem. Eng. Sci. 51 (1996) 99, doi:10.1016/0009-2509(95)00271-5";
    return info;
  }
  explicit Centre(const Parameters&) {}

  [[nodiscard]] int capacity(const sdk::GridShape&, double) const override { return 1; }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 0.5; }

  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& batch) const override {
    for (std::size_t g = 0; g < batch.count; ++g) {
      const std::size_t first = g * static_cast<std::size_t>(batch.capacity);
      batch.used[g] = 1;
      batch.cell_i[first] = cell_of(batch.x[g], grid.origin.x, grid.spacing.x);
      batch.cell_j[first] = cell_of(batch.y[g], grid.origin.y, grid.spacing.y);
      batch.cell_k[first] = cell_of(batch.z[g], grid.origin.z, grid.spacing.z);
      batch.weight[first] = 1.0;
    }
  }
};

}  // namespace
}  // namespace dust::model::centre

DUST_PLUGIN(registrar) { registrar.add<dust::model::centre::Centre>(); }
