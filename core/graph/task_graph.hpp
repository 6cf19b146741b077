// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
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

/// Nodes that every part of the work ("tile") can go through in one task, while its data are in the
/// cache: scheduling, not another algorithm.
struct Fusion {
  std::string part;
  std::vector<std::string> nodes;  ///< added one behind the other
  std::function<void()> work;      ///< does what they do
  /// How the time was shared by the nodes; sums to one.
  std::function<std::vector<double>()> shares;
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
  /// Runs the named nodes as one where they stand one behind the other; where a node was added
  /// between them, each runs by itself. Drawn and timed they are always one by one.
  void fuse(Fusion fusion);
  /// For tests: names with what stands there as a number. The nodes then run one after the other,
  /// none fused, and at one pass in `every` what a node has changed without declaring it is a
  /// std::logic_error.
  using Digests = std::map<std::string, std::function<std::uint64_t()>>;
  void check_writes(Digests digests, int every = 1);
  /// Names that nodes write and that check_writes() was given no digest of.
  [[nodiscard]] std::vector<std::string> unchecked_writes() const;
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
