// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dust::graph {

/// A piece of work with what it reads and writes, by name. Names are free ("grain.position").
struct Node {
  std::string name;
  std::vector<std::string> reads;
  std::vector<std::string> writes;
  std::function<void()> work;
};

/// Time and runs of a node.
struct NodeTiming {
  std::string name;
  double seconds = 0.0;
  std::int64_t runs = 0;
};

/// Nodes run through a oneTBB flow graph of continue_nodes. Program order is the order of adding;
/// two nodes that conflict (one writes what the other reads or writes) keep it, others may overlap.
/// Built once, run many times. A node that reads a name nobody wrote before is an error at build,
/// unless the name was declared as given.
class TaskGraph {
 public:
  explicit TaskGraph(std::string name);
  ~TaskGraph();
  TaskGraph(const TaskGraph&) = delete;
  TaskGraph& operator=(const TaskGraph&) = delete;

  /// Names that exist before the first node runs (state carried over from the last pass).
  void given(std::vector<std::string> names);
  void add(Node node);
  /// Derives the edges; throws std::logic_error on a read of a name that nobody wrote.
  void build();
  /// Runs every node once and waits; rethrows the first exception. After an exception the graph is
  /// not run again.
  void run();

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] std::vector<NodeTiming> timings() const;
  /// Direct edges (from, to) after transitive reduction, as positions in the order of adding.
  [[nodiscard]] std::vector<std::pair<int, int>> edges() const;
  /// A cluster of DOT text; `inner` graphs are drawn inside their node's cluster by the caller.
  [[nodiscard]] std::string dot_cluster(int indent = 2) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dust::graph
