// SPDX-License-Identifier: Apache-2.0
#include "graph/task_graph.hpp"
#include "preflight/reader.hpp"
#include "registry/registry.hpp"
#include "run/models.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using dust::run::Simulation;

namespace {

struct Case {
  std::string file;
  std::vector<dust::scenario::Override> settings;
  int steps = 0;
};

/// All of the engine's ways through a step: air and its overlap with the grains, periodic sides,
/// sorts of the rows, grains of several rates, bodies that are taken away, dust that comes off
/// grains and is caught by them, spheres that the grid resolves.
const std::vector<Case> k_cases = {
    {"scenarios/transfer_point.yaml", {{"fluid.cells", "[33, 3, 35]"}}, 70},
    {"scenarios/studies/small_hopper.yaml", {}, 60},
    {"scenarios/thesis/container_periodic.yaml", {}, 1},
    {"tests/bits/mixer.yaml", {{"emitters.sand.mass", "0.3 g"}}, 10},
    {"tests/bits/mixer.yaml", {{"coupling.overlap", "true"}, {"emitters.sand.mass", "0.3 g"}}, 5},
    {"tests/bits/mixer.yaml",
     {{"bodies.ramp.remove", "{at: 1 ms}"}, {"emitters.sand.mass", "0.3 g"}},
     5},
    {"scenarios/dust/silt_to_plate.yaml", {}, 10},
    {"tests/scenario/rain_through_cloud.yaml", {}, 3},
    {"tests/scenario/resolved_sphere.yaml", {}, 3},
};

std::unique_ptr<Simulation> simulation(const Case& c, int check_every) {
  static dust::registry::Registry registry;
  static const bool is_loaded = (registry.load({DUST_TEST_PLUGINS}), true);
  REQUIRE(is_loaded);
  const auto read =
      dust::preflight::read_scenario(fs::path(DUST_SOURCE) / c.file, c.settings, registry, {});
  return std::make_unique<Simulation>(
      read.setup, dust::run::make_models(read.setup, registry, read.dust), check_every, read.dust);
}

/// Contacts met and sub-steps made by all cases: a check of nodes that do nothing would show
/// nothing.
std::int64_t met = 0, sub_steps = 0;

std::string digest_after(const Case& c, int check_every) {
  const auto s = simulation(c, check_every);
  s->start();
  for (int n = 0; n < c.steps; ++n) s->step();
  const auto report = s->dem().report();
  CHECK(report.particle_steps > 0);
  met += report.contacts;
  sub_steps += report.fine_steps;
  return s->state_digest();
}

}  // namespace

/// One step in so many is looked at: no common factor with what comes round.
constexpr int k_every = 29;

TEST_CASE("a step's nodes shall change what they declare and nothing else") {
  for (const Case& c : k_cases) {
    CAPTURE(c.file);
    // Node by node, each looked at before and after: the same bits as the tiles' fused steps.
    CHECK(digest_after(c, k_every) == digest_after(c, 0));
  }
  CHECK(met > 100);
  CHECK(sub_steps > 100);
}

TEST_CASE(
    "all that nodes of a step write shall be looked at, but for a check that writes nothing") {
  for (const Case& c : k_cases) {
    CAPTURE(c.file);
    const auto s = simulation(c, k_every);
    CHECK(s->dem_graph().unchecked_writes() == std::vector<std::string>{});
    CHECK(s->step_graph().unchecked_writes() == std::vector<std::string>{"health"});
  }
}

TEST_CASE("a declaration that is missing in the graph of a fluid step shall be found") {
  const auto s = simulation(k_cases[3], 0);
  s->start();
  const auto digests = s->step_digests();
  std::vector<std::string> names;
  for (const auto& [name, digest] : digests) names.push_back(name);
  std::set<std::string> found;
  for (const std::string& left_out : names) {
    dust::graph::TaskGraph graph("fluid_step");
    std::vector<std::string> declared = names;
    std::erase(declared, left_out);
    graph.add({"step", {}, declared, [&] { s->step(); }});
    graph.check_writes(digests);
    graph.build();
    try {
      graph.run();
    } catch (const std::logic_error& e) {
      CHECK(std::string(e.what()).find("'" + left_out + "'") != std::string::npos);
      found.insert(left_out);
    }
  }
  // All grains are there at the start, no body goes, and no impulse is left over at the end.
  const std::set<std::string> resting{"body.removal", "emitter.state", "grain.fluid_impulse"};
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK(found.contains(name) == !resting.contains(name));
  }
}

TEST_CASE(
    "engine graph shall draw the phases of a tile, the drag before and the fine level behind") {
  const auto s = simulation(k_cases[3], 0);
  const std::string dot = dust::run::graph_dot(*s);
  const auto tile = dot.find("label=\"per tile\"");
  REQUIRE(tile != std::string::npos);
  const std::string part = dot.substr(tile, dot.find('}', tile) - tile);
  for (const char* node : {"contact", "force", "integration"}) {
    CHECK(part.find(std::string("\"dem_step.") + node + "\" [") != std::string::npos);
  }
  for (const char* edge :
       {"synchronise\" -> \"dem_step.drag", "drag\" -> \"dem_step.neighbour",
        "neighbour\" -> \"dem_step.contact", "contact\" -> \"dem_step.force",
        "force\" -> \"dem_step.integration", "integration\" -> \"dem_step.fine_level"}) {
    CHECK_MESSAGE(dot.find(std::string("\"dem_step.") + edge + '"') != std::string::npos, edge);
  }
}
