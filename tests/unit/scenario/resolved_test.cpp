// SPDX-License-Identifier: Apache-2.0
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

using namespace dust;
using scenario::ModelChoice;
using scenario::Setup;

namespace {

void check_same(const ModelChoice& a, const ModelChoice& b) {
  CHECK(a.kind == b.kind);
  CHECK(a.name == b.name);
  CHECK(a.path == b.path);
  CHECK(a.values == b.values);
}
void check_same(const std::optional<ModelChoice>& a, const std::optional<ModelChoice>& b) {
  REQUIRE(a.has_value() == b.has_value());
  if (a) check_same(*a, *b);
}

/// Field by field; places in the files differ.
void check_same(const Setup& a, const Setup& b) {
  CHECK(a.name == b.name);
  CHECK(a.seed == b.seed);
  CHECK(a.time.end == b.time.end);
  CHECK(a.time.fluid_step == b.time.fluid_step);
  CHECK(a.time.output_every == b.time.output_every);
  CHECK(a.time.checkpoint_every == b.time.checkpoint_every);
  CHECK(a.time.dem_step == b.time.dem_step);
  CHECK(a.time.expected_speed == b.time.expected_speed);
  CHECK(a.time.rates_single == b.time.rates_single);
  CHECK(a.gravity == b.gravity);
  CHECK(a.domain.min == b.domain.min);
  CHECK(a.domain.max == b.domain.max);
  for (std::size_t n = 0; n < 6; ++n) {
    CHECK(a.domain.sides[n].grains == b.domain.sides[n].grains);
    CHECK(a.domain.sides[n].material == b.domain.sides[n].material);
    check_same(a.domain.sides[n].air, b.domain.sides[n].air);
  }
  REQUIRE(a.materials.size() == b.materials.size());
  for (std::size_t n = 0; n < a.materials.size(); ++n) {
    CHECK(a.materials[n].name == b.materials[n].name);
    CHECK(a.materials[n].properties.density == b.materials[n].properties.density);
    CHECK(a.materials[n].properties.young_modulus == b.materials[n].properties.young_modulus);
    CHECK(a.materials[n].properties.poisson_ratio == b.materials[n].properties.poisson_ratio);
  }
  REQUIRE(a.interactions.size() == b.interactions.size());
  for (std::size_t n = 0; n < a.interactions.size(); ++n) {
    CHECK(a.interactions[n].material_i == b.interactions[n].material_i);
    CHECK(a.interactions[n].material_j == b.interactions[n].material_j);
    check_same(a.interactions[n].contact, b.interactions[n].contact);
    check_same(a.interactions[n].rolling, b.interactions[n].rolling);
  }
  REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t n = 0; n < a.frames.size(); ++n) {
    CHECK(a.frames[n].name == b.frames[n].name);
    CHECK(a.frames[n].origin == b.frames[n].origin);
    CHECK(a.frames[n].axis == b.frames[n].axis);
    CHECK(a.frames[n].angle == b.frames[n].angle);
  }
  REQUIRE(a.bodies.size() == b.bodies.size());
  for (std::size_t n = 0; n < a.bodies.size(); ++n) {
    CHECK(a.bodies[n].name == b.bodies[n].name);
    CHECK(a.bodies[n].material == b.bodies[n].material);
    CHECK(a.bodies[n].frame == b.bodies[n].frame);
    check_same(a.bodies[n].shape, b.bodies[n].shape);
    CHECK(a.bodies[n].group == b.bodies[n].group);
    REQUIRE(a.bodies[n].motions.size() == b.bodies[n].motions.size());
    for (std::size_t m = 0; m < a.bodies[n].motions.size(); ++m) {
      check_same(a.bodies[n].motions[m], b.bodies[n].motions[m]);
    }
    REQUIRE(a.bodies[n].removal.has_value() == b.bodies[n].removal.has_value());
    if (const auto& removal = a.bodies[n].removal) {
      CHECK(removal->at == b.bodies[n].removal->at);
      CHECK(removal->after == b.bodies[n].removal->after);
      CHECK(removal->kinetic_energy_per_grain == b.bodies[n].removal->kinetic_energy_per_grain);
    }
  }
  REQUIRE(a.emitters.size() == b.emitters.size());
  for (std::size_t n = 0; n < a.emitters.size(); ++n) {
    CHECK(a.emitters[n].name == b.emitters[n].name);
    CHECK(a.emitters[n].material == b.emitters[n].material);
    CHECK(a.emitters[n].frame == b.emitters[n].frame);
    check_same(a.emitters[n].model, b.emitters[n].model);
  }
  REQUIRE(a.sensors.size() == b.sensors.size());
  for (std::size_t n = 0; n < a.sensors.size(); ++n) {
    CHECK(a.sensors[n].name == b.sensors[n].name);
    check_same(a.sensors[n].model, b.sensors[n].model);
  }
  REQUIRE(a.fluid.has_value() == b.fluid.has_value());
  if (a.fluid) {
    CHECK(a.fluid->cells == b.fluid->cells);
    CHECK(a.fluid->density == b.fluid->density);
    CHECK(a.fluid->viscosity == b.fluid->viscosity);
    CHECK(a.fluid->momentum_set == b.fluid->momentum_set);
    CHECK(a.fluid->initial_velocity == b.fluid->initial_velocity);
    CHECK(a.fluid->pressure_tolerance == b.fluid->pressure_tolerance);
    CHECK(a.fluid->largest_cfl == b.fluid->largest_cfl);
    CHECK(a.fluid->is_one_way == b.fluid->is_one_way);
    CHECK(a.fluid->disturbance_correction == b.fluid->disturbance_correction);
    CHECK(a.fluid->overlaps_grains == b.fluid->overlaps_grains);
  }
  check_same(a.drag, b.drag);
  check_same(a.voidage, b.voidage);
}

void check_same(const std::vector<scenario::ReferenceSpec>& a,
                const std::vector<scenario::ReferenceSpec>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    CHECK(a[n].sensor == b[n].sensor);
    CHECK(a[n].figure == b[n].figure);
    CHECK(a[n].value == b[n].value);
    CHECK(a[n].unit == b[n].unit);
    CHECK(a[n].uncertainty == b[n].uncertainty);
    CHECK(a[n].source == b[n].source);
  }
}

void check_same(const std::vector<scenario::ReferenceCurve>& a,
                const std::vector<scenario::ReferenceCurve>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    CHECK(a[n].sensor == b[n].sensor);
    CHECK(a[n].axes.title == b[n].axes.title);
    CHECK(a[n].x == b[n].x);
    CHECK(a[n].y == b[n].y);
    CHECK(a[n].source == b[n].source);
  }
}

void check_round_trip(const std::filesystem::path& file,
                      const std::vector<scenario::Override>& set) {
  const Folder folder;
  const auto first = read(file, set);
  const auto second = read(folder.write("scenario.yaml", first.resolved_yaml));
  check_same(first.setup, second.setup);
  check_same(first.references, second.references);
  check_same(first.reference_curves, second.reference_curves);
  CHECK(second.resolved_yaml == first.resolved_yaml);
  CHECK(first.resolved_yaml.starts_with("# "));
}

}  // namespace

TEST_CASE("the resolved scenario shall give the same setup and the same text when read again") {
  check_round_trip(transfer_point(), {});
}

TEST_CASE("a resolved scenario with settings shall give the same setup when read again") {
  check_round_trip(transfer_point(), {{"bodies.plate.enabled", "true"},
                                      {"frames.conveyor.angle", "16 deg"},
                                      {"time.end", "0.1234567890123 s"},
                                      {"time.dem_step", "1.7 us"},
                                      {"coupling.one_way", "true"},
                                      {"coupling.correct_own_disturbance", "true"},
                                      {"coupling.overlap", "true"},
                                      {"gravity", "[0.1, 0.2, -9.7]"}});
}

TEST_CASE("a resolved scenario without fluid shall give the same setup when read again") {
  check_round_trip(transfer_point(), {{"fluid", "none"}});
}

TEST_CASE("a resolved scenario with periodic sides shall give the same setup when read again") {
  const Folder folder;
  check_round_trip(folder.write("small.yaml", k_small), {});
}

TEST_CASE("the resolved scenario shall write defaults out") {
  const auto text = read(transfer_point()).resolved_yaml;
  for (const char* key : {"seed: 1", "rates: several", "pressure_tolerance: 0.0001",
                          "one_way: false", "largest_cfl: 1", "finer_than: .inf"}) {
    CHECK_MESSAGE(text.find(key) != std::string::npos, key);
  }
}

TEST_CASE("a resolved scenario with references shall give the same setup when read again") {
  const Folder folder;
  const std::string references =
      "references:\n"
      "  - {quantity: sensors.stream.angle, value: 41.6 deg, uncertainty: 1.1 deg, source: a: b}\n"
      "  - {quantity: sensors.stream.rate, value: 3 g/s, source: 'c, d'}\n"
      "  - {quantity: sensors.stream.drop_5_mm/class_10_um/median, value: 1.1 mm, source: e}\n"
      "  - {quantity: sensors.stream.count, value: 7, source: f}\n"
      "reference_curves:\n"
      "  - {sensor: stream, x: [0, 10, 25 ms], y: [0, 1.1, 7 deg], source: 'g, h'}\n";
  const std::string colon = "source: a: b";
  std::string text = k_small + references;
  text.replace(text.find(colon), colon.size(), "source: 'a: b'");
  check_round_trip(folder.write("small.yaml", text), {});
}
