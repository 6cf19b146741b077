// SPDX-License-Identifier: Apache-2.0
#include "dmt.hpp"

#include "../surface_energy.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = dust::model::dmt;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(double surface_energy, const sdk::CohesionBatch& b) {
  const double *overlap = b.overlap, *radius = b.effective_radius;
  double *seen = b.contact_overlap, *attraction = b.attraction;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    seen[q] = overlap[q];
    attraction[q] = formula::attraction(surface_energy, radius[q], overlap[q]);
  }
}

class Dmt final : public dust::model::SurfaceEnergyLaw {
 public:
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    dust::model::declare_surface_energy(s, "2 pi");
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "dmt",
            .version = "1.0",
            .summary = "Constant attraction of small, stiff spheres in touch.",
            .equation = "F_c = 2 \\pi \\gamma R^*",
            .source =
                "Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53 (1975) 314, "
                "doi:10.1016/0021-9797(75)90018-1"};
  }

  explicit Dmt(const Parameters& p) : SurfaceEnergyLaw(p) {}
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const sdk::CohesionBatch& batch) const override {
    evaluate_batch(surface_energy(), batch);
  }
  [[nodiscard]] double range(double) const override { return 0.0; }
  [[nodiscard]] double resting_overlap(double radius) const override {
    return formula::resting_overlap(surface_energy(), young(), radius);
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Dmt>(); }
