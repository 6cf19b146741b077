// SPDX-License-Identifier: Apache-2.0
#include "graph/task_graph.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <stdexcept>

using dust::graph::TaskGraph;
using dust::test::approx;
using Edges = std::vector<std::pair<int, int>>;

namespace {

struct Recorder {
  std::mutex mutex;
  std::vector<std::string> order;
  std::function<void()> note(std::string name) {
    return [this, name] {
      const std::lock_guard lock(mutex);
      order.push_back(name);
    };
  }
};

}  // namespace

TEST_CASE("edges shall follow from what nodes read and write, without redundant ones") {
  TaskGraph g("step");
  g.given({"position"});
  g.add({"contact", {"position"}, {"force"}, [] {}});
  g.add({"drag", {"position"}, {"drag"}, [] {}});
  g.add({"integrate", {"force", "drag"}, {"position"}, [] {}});
  g.add({"sensor", {"position", "force"}, {"figures"}, [] {}});
  g.build();
  // contact and drag are free to overlap; the sensor waits for integrate only, which already
  // waited for contact.
  CHECK(g.edges() == Edges{{0, 2}, {1, 2}, {2, 3}});
}

TEST_CASE("conflicting nodes shall run in program order, every node once a pass") {
  TaskGraph g("order");
  Recorder r;
  g.add({"a", {}, {"x"}, r.note("a")});
  g.add({"b", {"x"}, {"x"}, r.note("b")});
  g.add({"c", {"x"}, {"y"}, r.note("c")});
  g.build();
  for (int pass = 0; pass < 50; ++pass) g.run();
  REQUIRE(r.order.size() == 150);
  for (std::size_t n = 0; n < r.order.size(); n += 3) {
    CHECK(r.order[n] == "a");
    CHECK(r.order[n + 1] == "b");
    CHECK(r.order[n + 2] == "c");
  }
  for (const auto& t : g.timings()) CHECK(t.runs == 50);
}

TEST_CASE("reading what nobody wrote shall be refused when the graph is built") {
  TaskGraph g("broken");
  g.add({"fluid", {"void_fraction"}, {"velocity"}, [] {}});
  CHECK_THROWS_WITH_AS(
      g.build(),
      "graph 'broken': node 'fluid' reads 'void_fraction', which no node before it "
      "writes",
      std::logic_error);
}

TEST_CASE("an exception in a node shall reach the caller with its type") {
  TaskGraph g("failing");
  g.add({"a", {}, {"x"}, [] { throw std::domain_error("beyond"); }});
  g.build();
  CHECK_THROWS_AS(g.run(), std::domain_error);
}

TEST_CASE("the DOT text shall name every node and edge") {
  TaskGraph g("picture");
  g.add({"a", {}, {"x"}, [] {}});
  g.add({"b", {"x"}, {}, [] {}});
  g.build();
  const std::string dot = g.dot_cluster();
  CHECK(dot.find("\"picture.a\" -> \"picture.b\"") != std::string::npos);
  CHECK(dot.find("reads: x") != std::string::npos);
}

namespace {

/// contact, force, integration with a stage in between or without; counts who ran.
struct Tiles {
  TaskGraph graph{"tiles"};
  int fused = 0, contact = 0, stage = 0;
  int position = 0, hidden = 0;

  explicit Tiles(bool has_stage) {
    graph.given({"position"});
    graph.add({"contact", {"position"}, {"force"}, [this] { ++contact; }});
    if (has_stage) graph.add({"stage", {"force"}, {"force"}, [this] { ++stage; }});
    graph.add({"integration", {"force"}, {"position"}, [this] { ++position; }});
    graph.fuse({.part = "tile",
                .nodes = {"contact", "integration"},
                .work = [this] { ++fused, ++position; },
                .shares =
                    [] {
                      return std::vector<double>{0.75, 0.25};
                    }});
  }
};

}  // namespace

TEST_CASE("fused nodes shall run as one, and be timed and drawn one by one") {
  Tiles tiles(false);
  tiles.graph.build();
  for (int pass = 0; pass < 3; ++pass) tiles.graph.run();
  CHECK(tiles.fused == 3);
  CHECK(tiles.contact == 0);
  const auto timings = tiles.graph.timings();
  REQUIRE(timings.size() == 2);
  CHECK(timings[0].name == "contact");
  CHECK(timings[0].runs == 3);
  CHECK(timings[0].seconds == approx(3.0 * timings[1].seconds));
  CHECK(tiles.graph.edges() == Edges{{0, 1}});
  const std::string dot = tiles.graph.dot_cluster();
  CHECK(dot.find("label=\"per tile\"") != std::string::npos);
  CHECK(dot.find("\"tiles.contact\" -> \"tiles.integration\"") != std::string::npos);
}

TEST_CASE("a node added between fused ones shall make them run one by one") {
  Tiles tiles(true);
  tiles.graph.build();
  tiles.graph.run();
  CHECK(tiles.fused == 0);
  CHECK(tiles.contact == 1);
  CHECK(tiles.stage == 1);
  CHECK(tiles.position == 1);
}

TEST_CASE("a node that changes what it does not declare shall be named") {
  Tiles tiles(false);
  tiles.graph.check_writes(
      {{"position", [&] { return static_cast<std::uint64_t>(tiles.position); }},
       {"force", [&] { return static_cast<std::uint64_t>(tiles.contact); }}});
  tiles.graph.build();
  tiles.graph.run();
  CHECK(tiles.fused == 0);

  Tiles lying(false);
  lying.graph.check_writes(
      {{"velocity", [&] { return static_cast<std::uint64_t>(lying.contact); }}});
  CHECK(lying.graph.unchecked_writes() == std::vector<std::string>{"force", "position"});
  lying.graph.build();
  CHECK_THROWS_WITH_AS(lying.graph.run(),
                       "graph 'tiles': node 'contact' has changed 'velocity', which it does not "
                       "declare to write",
                       std::logic_error);
}
