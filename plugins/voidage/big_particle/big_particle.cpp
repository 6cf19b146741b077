// SPDX-License-Identifier: Apache-2.0
#include "big_particle.hpp"

#include <dust/sdk/plugin.hpp>
#include "../shares_of_grain.hpp"

#include <array>

namespace {

namespace formula = dust::model::big_particle;
namespace sdk = dust::sdk;

/// Shares below this are the rounding of differences between volumes of order 1.
constexpr double k_nothing = 1e-14;

class BigParticle final : public sdk::VoidageRule {
 public:
  struct Parameters {
    double inner_void_fraction = 0.5;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::inner_void_fraction, "inner_void_fraction", sdk::dimension::none,
             "Void fraction inside the sphere that a lone grain's volume is spread over.")
        .symbol("\\varepsilon_i")
        .at_least(0.3)
        .at_most(0.95)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "big_particle",
        .version = "1.0",
        .summary =
            "Grains larger than a cell: volume spread evenly over an enlarged sphere, by exact "
            "overlap "
            "with the cells.",
        .equation =
            R"(\varepsilon = 1 - (1 - \varepsilon_i) \frac{1}{V_c} \sum_g |S_g' \cap C|,\quad R' = R\,(1 - \varepsilon_i)^{-1/3})",
        .source = "own derivation, plugins/voidage/big_particle/README.md"};
  }
  explicit BigParticle(const Parameters& p) : scale_(formula::enlargement(p.inner_void_fraction)) {}

  [[nodiscard]] int capacity(const sdk::GridShape& grid, double radius) const override {
    int cells = 1;
    for (int d = 0; d < 3; ++d) {
      cells *= static_cast<int>(2.0 * scale_ * radius / grid.spacing[d]) + 2;
    }
    return cells;
  }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 8.0; }
  [[nodiscard]] sdk::Vec3 reach(const sdk::GridShape&, double radius) const override {
    return {scale_ * radius, scale_ * radius, scale_ * radius};
  }

  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& batch) const override {
    thread_local std::array<formula::Planes, 3> planes;
    thread_local std::vector<double> beyond;  // share beyond three planes, x fastest
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double radius = scale_ * batch.radius[g];
      planes[0].set(batch.position.x[g], grid.origin.x, grid.spacing.x, radius);
      planes[1].set(batch.position.y[g], grid.origin.y, grid.spacing.y, radius);
      planes[2].set(batch.position.z[g], grid.origin.z, grid.spacing.z, radius);
      beyond.clear();
      for (const double c : planes[2].distances()) {
        for (const double b : planes[1].distances()) {
          for (const double a : planes[0].distances()) {
            beyond.push_back(sdk::sphere_parts::any_corner(a, b, c));
          }
        }
      }
      spread_one(batch, g, planes, beyond);
    }
  }

 private:
  /// Each cell is the alternating sum over its eight corners.
  static void spread_one(const sdk::VoidageBatch& batch, std::size_t g,
                         const std::array<formula::Planes, 3>& planes,
                         const std::vector<double>& beyond) {
    dust::model::SharesOfGrain out(batch, g);
    const std::size_t row = planes[0].distances().size();
    const std::size_t layer = row * planes[1].distances().size();
    for (std::size_t k = 0; k < planes[2].cells(); ++k) {
      for (std::size_t j = 0; j < planes[1].cells(); ++j) {
        for (std::size_t i = 0; i < planes[0].cells(); ++i) {
          const double* at = &beyond[i + row * j + layer * k];
          const double low = (at[0] - at[1]) - (at[row] - at[row + 1]);
          const double high = (at[layer] - at[layer + 1]) - (at[layer + row] - at[layer + row + 1]);
          const double weight = low - high;
          if (weight <= k_nothing) continue;
          out.add(planes[0].first() + static_cast<int>(i), planes[1].first() + static_cast<int>(j),
                  planes[2].first() + static_cast<int>(k), weight);
        }
      }
    }
    out.close();
  }

  double scale_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<BigParticle>(); }
