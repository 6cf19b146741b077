// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/plugin.hpp"

#include <limits>

namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

enum class Time { zero, negative, not_a_number };

/// A contact law that reports a collision time which no step can be made of.
template <Time time>
struct Timeless final : dust::sdk::ContactLaw {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    const char* const names[] = {"zero", "negative", "not_a_number"};
    return {.kind = "",
            .name = names[static_cast<int>(time)],
            .version = "1.0",
            .summary = "No force.",
            .equation = "",
            .source = "",
            .parameters = {}};
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit Timeless(const Parameters&) {}
  void prepare(const dust::sdk::MaterialProperties&,
               const dust::sdk::MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const dust::sdk::ContactBatch& batch) const override {
    for (std::size_t n = 0; n < batch.count; ++n) batch.force.set(n, {});
  }
  [[nodiscard]] double collision_time(double, double, double) const override {
    const double times[] = {0.0, -1e-6, k_nan};
    return times[static_cast<int>(time)];
  }
  [[nodiscard]] double half_period(double, double, double) const override { return 1e-6; }
};

}  // namespace

DUST_PLUGIN(registrar) {
  registrar.add<Timeless<Time::zero>>();
  registrar.add<Timeless<Time::negative>>();
  registrar.add<Timeless<Time::not_a_number>>();
}
