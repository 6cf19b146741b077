// SPDX-License-Identifier: Apache-2.0
#include "support/dem_rig.hpp"

#include "dust/sdk/random.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using dust::particles::NewGrain;
using namespace dust::test;

namespace {

std::unique_ptr<dust::particles::Dem> box(DemRig& rig) {
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.5, 0.5, 0.3);
  rig.diameters = {10e-6, 400e-6, 600e-6};
  rig.setup.gravity = {0, 0, -9.81};
  rig.setup.domain.min = {0, 0, 0};
  rig.setup.domain.max = {6e-3, 6e-3, 2e-2};
  for (int s = 2; s < 5; ++s) rig.wall(s, sand);
  rig.periodic(0);
  rig.has_fluid = true;
  return rig.make();
}

std::vector<NewGrain> load(double height) {
  std::vector<NewGrain> grains;
  const dust::sdk::Random random(11, 1);
  for (std::uint64_t n = 0; n < 640; ++n) {
    const bool is_dust = n % 5 == 4;
    grains.push_back(
        {.position = {7e-4 * (static_cast<double>(n % 8) + 0.7 + 0.1 * random.uniform(n, 0)),
                      7e-4 * (static_cast<double>(n / 8 % 8) + 0.7),
                      height + 7e-4 * (static_cast<double>(n / 64) + 0.6)},
         .velocity = {0.2, 0.1 * random.uniform(n, 1), -0.3},
         .diameter = is_dust      ? 10e-6
                     : n % 2 == 0 ? 400e-6
                                  : 600e-6,
         .weight = is_dust ? 0.05 : 1.0});
  }
  return grains;
}

void drag(dust::particles::Dem& dem) {
  const auto rows = dem.rows();
  for (std::size_t n = 0; n < rows.count; ++n) rows.drag_relaxation[4 * n + 3] = 3.0;
  dem.drag_relaxation_changed();
}

std::vector<double> rows_of(dust::particles::Dem& dem) {
  const auto rows = dem.rows();
  std::vector<double> out;
  for (std::size_t n = 0; n < rows.count; ++n) {
    out.push_back(static_cast<double>(rows.id[n]));
    for (std::size_t d = 0; d < 4; ++d) {
      out.insert(out.end(), {rows.position[4 * n + d], rows.velocity_of(n)[d],
                             rows.rotation_of(n)[d], rows.fluid_impulse[4 * n + d]});
    }
  }
  return out;
}

}  // namespace

TEST_CASE("a resumed DEM shall give the same bits as one that went on") {
  // Stops at several places, with and without a pending rebuild, in dense and free states.
  for (const int stop : {1, 37, 400, 902}) {
    DemRig first_rig;
    DemRig second_rig;
    auto first = box(first_rig);
    first->insert(load(0.0));
    drag(*first);
    Stepper stepper(*first);
    stepper.step(stop);
    MemoryArchive archive;
    CHECK_THROWS_AS(first->save(archive), std::logic_error);
    first->synchronise();
    first->save(archive);
    auto second = box(second_rig);
    second->load(archive);
    CHECK(rows_of(*first) == rows_of(*second));
    Stepper other(*second);
    for (Stepper* s : {&stepper, &other}) {
      auto& dem = s == &stepper ? *first : *second;
      s->step(300);
      dem.insert(load(8e-3));
      dem.remove_escaped();
      s->step(200);
    }
    CHECK(first->report().contacts > 0);
    CHECK(rows_of(*first) == rows_of(*second));
    CHECK(first->balance().mass_in_domain == second->balance().mass_in_domain);
    CHECK(first->report().rebuilds == second->report().rebuilds);
  }
}

TEST_CASE("contacts that came from another run shall outlive a checkpoint before the first step") {
  DemRig rigs[3];
  auto first = box(rigs[0]);
  first->insert(load(0.0));
  Stepper stepper(*first);
  stepper.step(8000);
  REQUIRE(first->report().contacts > 100);
  auto second = box(rigs[1]);
  const dust::particles::LawTransfer law{
      .law = 0, .keeps_contact = true, .keeps_rolling = true, .keeps_cohesion = true};
  first->synchronise();
  second->transfer_from(*first, 0.0, std::vector{law});
  MemoryArchive archive;
  second->save(archive);
  auto third = box(rigs[2]);
  third->load(archive);
  for (auto* dem : {second.get(), third.get()}) {
    Stepper on(*dem);
    on.step(50);
    CHECK(dem->report().missed_contact_onsets == 0);
  }
  CHECK(rows_of(*second) == rows_of(*third));
}
