// SPDX-License-Identifier: Apache-2.0
// Energy of many elastic collisions.
#include "dust/sdk/random.hpp"
#include "verification/contact/gas_energy.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

using dust::particles::NewGrain;
using namespace dust::test;

namespace {

/// An elastic frictionless gas of 1000 grains in a periodic box.
class Gas {
 public:
  explicit Gas(double step) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.law(sand, sand, 1.0, 0.0);
    rig.diameters = {2 * k_radius};
    rig.setup.domain.min = {0, 0, 0};
    rig.setup.domain.max = {k_edge, k_edge, k_edge};
    rig.setup.time.dem_step = step;
    for (int d = 0; d < 3; ++d) rig.periodic(d);
    const dust::sdk::Random random(5, 2);
    std::vector<NewGrain> grains;
    for (std::uint64_t n = 0; n < 1000; ++n) {
      grains.push_back({.position = {1e-3 * (static_cast<double>(n % 10) + 0.5),
                                     1e-3 * (static_cast<double>(n / 10 % 10) + 0.5),
                                     1e-3 * (static_cast<double>(n / 100) + 0.5)},
                        .velocity = {random.uniform(n, 0) - 0.5, random.uniform(n, 1) - 0.5,
                                     random.uniform(n, 2) - 0.5},
                        .diameter = 2 * k_radius});
    }
    dem_ = rig.make();
    dem_->insert(grains);
    stepper_ = std::make_unique<Stepper>(*dem_);
    start_ = energy();
  }
  /// Change of the energy after `steps` more steps, as a share, mean of `samples` one collision
  /// apart: what the collisions under way add is of second order and fluctuates.
  double change(std::int64_t steps, int samples) {
    stepper_->step(steps);
    double sum = 0.0;
    const auto apart = static_cast<std::int64_t>(4e-5 / dem_->coarse_step());
    for (int n = 0; n < samples; ++n) {
      stepper_->step(apart);
      sum += energy();
    }
    return sum / samples / start_ - 1.0;
  }

 private:
  static constexpr double k_radius = 3e-4;
  static constexpr double k_edge = 1e-2;

  double energy() {
    return energy_of_gas(*dem_, k_edge, 50e6 / (1.0 - 0.09) / 2.0,
                         [](std::int64_t, std::int64_t, double) {});
  }

  std::unique_ptr<dust::particles::Dem> dem_;
  std::unique_ptr<Stepper> stepper_;
  double start_ = 0.0;
};

}  // namespace

TEST_CASE("an elastic frictionless gas shall keep its energy, to second order in the step") {
  // V-INV-4. A collision takes some 40 us; each grain has one about every millisecond.
  {
    Gas gas(2.5e-7);
    CHECK(std::abs(gas.change(100000, 50)) < 1e-5);
  }
  // A quarter of the step, a sixteenth of the error; it is a sum over 10,000 collisions of chance,
  // hence the factor 2 either way.
  const double coarse = Gas(2e-6).change(4000, 50);
  const double fine = Gas(5e-7).change(16000, 50);
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(std::abs(coarse / fine) > 8.0);
  CHECK(std::abs(coarse / fine) < 32.0);
}
