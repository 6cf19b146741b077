// SPDX-License-Identifier: Apache-2.0
#include "sjkr.hpp"

#include <dust/sdk/plugin.hpp>

#include <cmath>
#include <sstream>

namespace {

namespace formula = dust::model::sjkr;
namespace sdk = dust::sdk;

/// Beyond this share of R* an overlap is no longer small.
constexpr double k_largest_strain = 0.1;

DUST_KERNEL void evaluate_batch(double energy_density, const sdk::CohesionBatch& b) {
  const double *overlap = b.overlap, *radius = b.effective_radius;
  double *seen = b.contact_overlap, *attraction = b.attraction;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    seen[q] = overlap[q];
    attraction[q] = formula::attraction(energy_density, radius[q], overlap[q]);
  }
}

class Sjkr final : public sdk::CohesionLaw {
 public:
  struct Parameters {
    double energy_density = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::energy_density, "energy_density", sdk::dimension::pressure,
             "Attraction per area of overlap (J/m3 = Pa).")
        .symbol("C")
        .above(0);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "sjkr",
            .version = "1.0",
            .summary = "Attraction in proportion to the area of overlap, in touch only.",
            .equation = "F_c = C A,\\quad A = 2 \\pi R^* d",
            .source =
                "simplified form of Johnson, Kendall, Roberts, Proc. R. Soc. A 324 (1971) 301, "
                "doi:10.1098/rspa.1971.0141"};
  }

  explicit Sjkr(const Parameters& p) : energy_density_(p.energy_density) {}
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    young_ = sdk::effective_young_modulus(i, j);
    if (formula::resting_strain(energy_density_, young_) <= k_largest_strain) return;
    std::ostringstream text;
    text << "energy_density: " << energy_density_
         << " Pa would pull the grains more than a tenth of R* into each other: at most "
         << std::sqrt(k_largest_strain) * young_ / (1.5 * std::numbers::pi)
         << " Pa goes with these materials (0.067 of their effective Young's modulus)";
    throw sdk::ParameterError(text.str());
  }
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const sdk::CohesionBatch& batch) const override {
    evaluate_batch(energy_density_, batch);
  }
  [[nodiscard]] double range(double) const override { return 0.0; }
  [[nodiscard]] double resting_overlap(double radius) const override {
    return radius * formula::resting_strain(energy_density_, young_);
  }

 private:
  double energy_density_;
  double young_ = 0.0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Sjkr>(); }
