// SPDX-License-Identifier: Apache-2.0
#include "jkr.hpp"

#include "../surface_energy.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::jkr;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(double surface_energy, const sdk::CohesionBatch& b) {
  const double *overlap = b.overlap, *radius = b.effective_radius;
  double *seen = b.contact_overlap, *attraction = b.attraction, *stuck = b.history[0];
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    // The length stands where the attraction will be.
    formula::Bond c{overlap[q], radius[q], attraction[q], stuck[q], 0.0, 0.0};
    formula::evaluate(surface_energy, c);
    seen[q] = c.contact_overlap;
    attraction[q] = c.attraction;
    stuck[q] = c.is_stuck;
  }
}

class Jkr final : public dust::model::SurfaceEnergyLaw {
 public:
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    dust::model::declare_surface_energy(s, "3/2 pi");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "jkr",
            .version = "1.0",
            .summary = "Adhesive elastic spheres with a neck that tears; replaces the Hertz force.",
            .equation =
                "F = \\frac{4 E^* a^3}{3 R^*} - \\sqrt{8 \\pi \\gamma E^* a^3},\\quad "
                "d = \\frac{a^2}{R^*} - \\sqrt{\\frac{2 \\pi \\gamma a}{E^*}}",
            .source =
                "Johnson, Kendall, Roberts, Proc. R. Soc. A 324 (1971) 301, "
                "doi:10.1098/rspa.1971.0141"};
  }

  explicit Jkr(const Parameters& p) : SurfaceEnergyLaw(p) {}
  [[nodiscard]] int history_size() const override { return 1; }
  void evaluate(const sdk::CohesionBatch& batch) const override {
    // The cube root is a call: apart from the rest, so that that can use all lanes.
    for (std::size_t q = 0; q < batch.count; ++q) {
      batch.attraction[q] = formula::length(surface_energy(), young(), batch.effective_radius[q]);
    }
    evaluate_batch(surface_energy(), batch);
  }
  [[nodiscard]] double range(double radius) const override {
    const double length = formula::length(surface_energy(), young(), radius);
    return -formula::k_tear * length * length / radius;
  }
  [[nodiscard]] double resting_overlap(double radius) const override {
    const double length = formula::length(surface_energy(), young(), radius);
    const double b = std::cbrt(formula::k_rest_cubed);
    return length * length / radius * b * formula::k_rest_cubed;
  }
  [[nodiscard]] bool needs_hertz_force() const override { return true; }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Jkr>(); }
