// SPDX-License-Identifier: Apache-2.0
// A law that comes in several versions: LAW_VERSION, LAW_NUMBERS kept per contact, and LAW_BUILD.
#include <dust/sdk/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {
namespace sdk = dust::sdk;

class ChangingLaw final : public sdk::ContactLaw {
 public:
  struct Parameters {
    double stiffness = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::stiffness, "stiffness", sdk::dimension::stiffness, "Of the spring.")
        .above(0.0);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "changing_law",
            .version = LAW_VERSION,
            .summary = "A spring that is softer the deeper it has been.",
            .equation = "F = k d",
            .source = "a test, built as " LAW_BUILD};
  }
  explicit ChangingLaw(const Parameters& p) : parameters_(p) {}
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return LAW_NUMBERS; }
  void evaluate(const sdk::ContactBatch& b) const override {
    for (std::size_t q = 0; q < b.count; ++q) {
      const double overlap = std::max(0.0, b.overlap[q]);
      double* deepest = b.history[LAW_NUMBERS - 1] + q;
      const double k = parameters_.stiffness * (overlap < *deepest ? 0.5 : 1.0);
      *deepest = std::max(*deepest, overlap);
      b.normal_force[q] = k * overlap;
      b.normal_stiffness[q] = k;
      b.tangential_stiffness[q] = 0.0;
      b.force.x[q] = k * overlap * b.normal.x[q];
      b.force.y[q] = k * overlap * b.normal.y[q];
      b.force.z[q] = k * overlap * b.normal.z[q];
    }
  }
  [[nodiscard]] double collision_time(double, double mass, double) const override {
    return std::numbers::pi * std::sqrt(mass / parameters_.stiffness);
  }
  [[nodiscard]] double half_period(double, double mass, double) const override {
    return std::numbers::pi * std::sqrt(mass / parameters_.stiffness);
  }

 private:
  Parameters parameters_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<ChangingLaw>(); }
