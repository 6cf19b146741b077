// SPDX-License-Identifier: Apache-2.0
#include "gaussian.hpp"

#include <dust/sdk/plugin.hpp>
#include "../shares_of_grain.hpp"

#include <array>

namespace {

namespace formula = dust::model::gaussian;
namespace sdk = dust::sdk;

class Gaussian final : public sdk::VoidageRule {
 public:
  struct Parameters {
    double width_over_diameter = 1.5;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::width_over_diameter, "width_over_diameter", sdk::dimension::none,
             "Standard deviation of the kernel over the grain's diameter; at least half a cell.")
        .symbol("b")
        .above(0)
        .at_most(3)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "gaussian",
        .version = "1.0",
        .summary = "A grain's volume is spread as a Gaussian, cut at three standard deviations.",
        .equation =
            R"(w = \prod_d \frac{\mathrm{erf}(x_d^+ / \sqrt2 \sigma_d) - \mathrm{erf}(x_d^- / \sqrt2 \sigma_d)}{2\,\mathrm{erf}(3 / \sqrt2)},\quad \sigma_d = \max(b D, \Delta x_d / 2))",
        .source =
            "kernel averaging: Anderson and Jackson, Ind. Eng. Chem. Fundam. 6 (1967) 527, "
            "doi:10.1021/i160024a007"};
  }
  explicit Gaussian(const Parameters& p) : width_(p.width_over_diameter) {}

  [[nodiscard]] int capacity(const sdk::GridShape& grid, double radius) const override {
    int cells = 1;
    for (int d = 0; d < 3; ++d) {
      const double sigma = formula::deviation(width_, 2.0 * radius, grid.spacing[d]);
      cells *= formula::most_cells(sigma, grid.spacing[d]);
    }
    return cells;
  }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 4.0; }
  [[nodiscard]] sdk::Vec3 reach(const sdk::GridShape& grid, double radius) const override {
    sdk::Vec3 r;
    for (int d = 0; d < 3; ++d) {
      r[d] = formula::k_reach * formula::deviation(width_, 2.0 * radius, grid.spacing[d]);
    }
    return r;
  }

  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& batch) const override {
    thread_local std::array<formula::Shares, 3> shares;
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double place[3] = {batch.position.x[g], batch.position.y[g], batch.position.z[g]};
      for (int d = 0; d < 3; ++d) {
        shares[static_cast<std::size_t>(d)].set(
            place[d], grid.origin[d], grid.spacing[d],
            formula::deviation(width_, 2.0 * batch.radius[g], grid.spacing[d]));
      }
      spread_one(batch, g, shares);
    }
  }

 private:
  static void spread_one(const sdk::VoidageBatch& batch, std::size_t g,
                         const std::array<formula::Shares, 3>& shares) {
    dust::model::SharesOfGrain out(batch, g);
    const auto& [x, y, z] = shares;
    for (std::size_t k = 0; k < z.weights().size(); ++k) {
      for (std::size_t j = 0; j < y.weights().size(); ++j) {
        for (std::size_t i = 0; i < x.weights().size(); ++i) {
          const double weight = x.weights()[i] * y.weights()[j] * z.weights()[k];
          if (weight <= formula::k_nothing) continue;
          out.add(x.first() + static_cast<int>(i), y.first() + static_cast<int>(j),
                  z.first() + static_cast<int>(k), weight);
        }
      }
    }
    out.close();
  }

  double width_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Gaussian>(); }
