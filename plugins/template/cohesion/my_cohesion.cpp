// SPDX-License-Identifier: Apache-2.0
#include "my_cohesion.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_cohesion;
namespace sdk = dust::sdk;

DUST_KERNEL void evaluate_batch(double surface_energy, double reach, const sdk::CohesionBatch& b) {
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    // The contact law sees the overlap as it is: this attraction deforms nothing.
    b.contact_overlap[q] = b.overlap[q];
    b.attraction[q] =
        formula::attraction(surface_energy, reach, b.effective_radius[q], b.overlap[q]);
  }
}

class MyCohesion final : public sdk::CohesionLaw {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double surface_energy = 0.0;
    double reach = 1e-6;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::surface_energy, "surface_energy", sdk::dimension::surface_energy,
             "Work to part a unit area of the two surfaces.")
        .symbol("\\gamma")
        .above(0);
    s.number(&Parameters::reach, "reach", sdk::dimension::length,
             "Gap at which the attraction ends.")
        .symbol("a")
        .above(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_cohesion",
            .version = "1.0",
            .summary = "Constant attraction in touch that ends over a short gap.",
            .equation = "F_c = 2 \\pi \\gamma R^* \\max(0, 1 - s/a)",
            .source =
                "Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53 (1975) 314, "
                "doi:10.1016/0021-9797(75)90018-1, in touch; the end is our own"};
  }

  explicit MyCohesion(const Parameters& p) : p_(p) {}

  // 3. The pair of materials, once. It keeps nothing per pair.
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    young_ = sdk::effective_young_modulus(i, j);
  }
  [[nodiscard]] int history_size() const override { return 0; }
  // 4. The law on a batch, before the contact stage.
  void evaluate(const sdk::CohesionBatch& batch) const override {
    evaluate_batch(p_.surface_energy, p_.reach, batch);
  }
  // 5. What the core asks for its search and its time steps.
  [[nodiscard]] double range(double) const override { return p_.reach; }
  [[nodiscard]] double resting_overlap(double radius) const override {
    return formula::resting_overlap(p_.surface_energy, young_, radius);
  }

 private:
  Parameters p_;
  double young_ = 0.0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyCohesion>(); }
