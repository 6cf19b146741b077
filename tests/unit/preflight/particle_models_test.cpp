// SPDX-License-Identifier: Apache-2.0
#include "preflight/particle_models.hpp"
#include "preflight/reader.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace dust;

TEST_CASE("the shapes of a scenario shall know its largest grain, and sizes that come besides") {
  registry::Registry shipped;
  shipped.load({DUST_TEST_PLUGINS});
  const auto models_with = [&](const std::string& hole_radius) {
    const auto read = preflight::read_scenario(
        std::string(DUST_SOURCE) + "/scenarios/verification/box.yaml",
        {{"bodies.lid",
          "{shape: disc, material: glass, centre: [3, 3, 39 mm], axis: [0, 0, 1], radius: 2 mm, "
          "thickness: 0.5 mm, hole_radius: " +
              hole_radius + "}"}},
        shipped);
    return preflight::make_particle_models(read.setup, shipped);
  };
  // The largest grain has a radius of 0.325 mm.
  CHECK(models_with("0.32 mm").bodies[0].shape->parts() > 1);
  preflight::ParticleModels models = models_with("0.33 mm");
  CHECK(models.bodies[0].shape->parts() == 1);
  preflight::set_class_diameters(models, {1e-3, 0.65e-3, 1e-3});
  CHECK(models.class_diameters == std::vector<double>{0.65e-3, 1e-3});
  CHECK(models.bodies[0].shape->parts() > 1);
}
