// SPDX-License-Identifier: Apache-2.0
#include "divided.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::divided;
namespace sdk = dust::sdk;

/// Where a grain lies along one axis: its cell, and the one plane that may cut it.
struct Cut {
  int cell = 0;
  int side = 0;           ///< -1 or +1: the neighbour that gets a share; 0 = not cut
  double distance = 1.0;  ///< of that plane from the centre over the radius
};

inline Cut cut_of(double position, double origin, double spacing, double inverse, double radius) {
  const double scaled = (position - origin) * inverse;
  const double cell = std::floor(scaled);
  const double below = (scaled - cell) * spacing;
  const double above = spacing - below;
  const double nearest = std::min(below, above);
  if (nearest >= radius) return {static_cast<int>(cell), 0, 1.0};
  return {static_cast<int>(cell), below < above ? -1 : 1, nearest / radius};
}

class Divided final : public sdk::VoidageRule {
 public:
  struct Parameters {};
  static sdk::ParameterSchema schema() { return sdk::SchemaOf<Parameters>{}.build(); }
  static sdk::ModelInfo describe() {
    return {.name = "divided",
            .version = "1.0",
            .summary = "A grain's volume goes to the cells it overlaps, by exact overlap volumes.",
            .equation = R"(\varepsilon = 1 - \frac{1}{V_c} \sum_g |S_g \cap C|)",
            .source = "own derivation, plugins/voidage/divided/README.md"};
  }
  explicit Divided(const Parameters&) {}

  [[nodiscard]] int capacity(const sdk::GridShape&, double) const override { return k_capacity; }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 0.5; }

  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& batch) const override {
    const sdk::Vec3 inverse{1.0 / grid.spacing.x, 1.0 / grid.spacing.y, 1.0 / grid.spacing.z};
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double radius = batch.radius[g];
      const Cut x = cut_of(batch.position.x[g], grid.origin.x, grid.spacing.x, inverse.x, radius);
      const Cut y = cut_of(batch.position.y[g], grid.origin.y, grid.spacing.y, inverse.y, radius);
      const Cut z = cut_of(batch.position.z[g], grid.origin.z, grid.spacing.z, inverse.z, radius);
      spread_one(batch, g, x, y, z);
    }
  }

 private:
  static constexpr int k_capacity = 8;

  /// The share of the cell that holds the centre is what the others leave, so that the sum is 1 to
  /// rounding: it is the largest one.
  static void spread_one(const sdk::VoidageBatch& batch, std::size_t g, Cut x, Cut y, Cut z) {
    const std::size_t first = g * static_cast<std::size_t>(batch.capacity);
    std::size_t used = 1;
    double given = 0.0;
    const auto add = [&](int i, int j, int k, double weight) {
      batch.cell_i[first + used] = x.cell + i;
      batch.cell_j[first + used] = y.cell + j;
      batch.cell_k[first + used] = z.cell + k;
      batch.weight[first + used] = weight;
      given += weight;
      ++used;
    };
    const auto add_some = [&](int i, int j, int k, double weight) {
      if (weight > 0.0) add(i, j, k, weight);
    };
    const bool is_xy = x.side != 0 && y.side != 0;
    const bool is_yz = y.side != 0 && z.side != 0;
    const bool is_zx = z.side != 0 && x.side != 0;
    const double xy = is_xy ? formula::edge(x.distance, y.distance) : 0.0;
    const double yz = is_yz ? formula::edge(y.distance, z.distance) : 0.0;
    const double zx = is_zx ? formula::edge(z.distance, x.distance) : 0.0;
    const double xyz = is_xy && is_yz ? formula::corner(x.distance, y.distance, z.distance) : 0.0;
    if (x.side != 0) add_some(x.side, 0, 0, formula::cap(x.distance) - xy - zx + xyz);
    if (y.side != 0) add_some(0, y.side, 0, formula::cap(y.distance) - xy - yz + xyz);
    if (z.side != 0) add_some(0, 0, z.side, formula::cap(z.distance) - yz - zx + xyz);
    add_some(x.side, y.side, 0, xy - xyz);
    add_some(0, y.side, z.side, yz - xyz);
    add_some(x.side, 0, z.side, zx - xyz);
    add_some(x.side, y.side, z.side, xyz);
    batch.cell_i[first] = x.cell;
    batch.cell_j[first] = y.cell;
    batch.cell_k[first] = z.cell;
    batch.weight[first] = 1.0 - given;
    batch.used[g] = static_cast<int>(used);
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Divided>(); }
