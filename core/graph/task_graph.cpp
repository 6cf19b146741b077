// SPDX-License-Identifier: Apache-2.0
#include "graph/task_graph.hpp"

#include <oneapi/tbb/flow_graph.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <sstream>
#include <stdexcept>

namespace dust::graph {
namespace {

using Clock = std::chrono::steady_clock;
using FlowNode = tbb::flow::continue_node<tbb::flow::continue_msg>;
// Runs its body on the thread of its predecessor, without a task of its own.
using LightNode = tbb::flow::continue_node<tbb::flow::continue_msg, tbb::flow::lightweight>;
using Receiver = tbb::flow::receiver<tbb::flow::continue_msg>;
using Sender = tbb::flow::sender<tbb::flow::continue_msg>;

bool share_a_name(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&](const std::string& name) {
    return std::find(b.begin(), b.end(), name) != b.end();
  });
}

bool conflict(const Node& first, const Node& second) {
  return share_a_name(first.writes, second.reads) || share_a_name(first.reads, second.writes) ||
         share_a_name(first.writes, second.writes);
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

struct TaskGraph::Impl {
  struct Entry {
    Node node;
    double seconds = 0.0;
    std::int64_t runs = 0;
    std::unique_ptr<tbb::flow::graph_node> flow;
    Receiver* in = nullptr;
    Sender* out = nullptr;
  };

  std::string name;
  std::set<std::string> known;
  std::vector<Entry> entries;
  std::vector<std::pair<int, int>> edges;
  tbb::flow::graph flow;
  std::unique_ptr<tbb::flow::broadcast_node<tbb::flow::continue_msg>> start;
  std::int64_t passes = 0;

  void derive_edges() {
    const int count = static_cast<int>(entries.size());
    // reach[a][b]: a must finish before b starts, through any chain.
    std::vector<std::vector<bool>> reach(entries.size(), std::vector<bool>(entries.size(), false));
    for (int to = 0; to < count; ++to) {
      // Nearest predecessors first: a farther one already reached through a nearer one adds no
      // edge.
      for (int from = to - 1; from >= 0; --from) {
        if (!conflict(entries[from].node, entries[to].node) || reach[from][to]) continue;
        edges.emplace_back(from, to);
        reach[from][to] = true;
        for (int before = 0; before < from; ++before) {
          if (reach[before][from]) reach[before][to] = true;
        }
      }
    }
    std::sort(edges.begin(), edges.end());
  }

  /// Every node waits for the one before it: nothing could overlap.
  [[nodiscard]] bool is_chain() const {
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const int from = static_cast<int>(n);
      if (edges[n] != std::pair{from, from + 1}) return false;
    }
    return edges.size() + 1 == entries.size();
  }

  template <class FlowKind>
  void make_node(Entry& entry) {
    auto node = std::make_unique<FlowKind>(flow, [&entry](const tbb::flow::continue_msg&) {
      const auto begin = Clock::now();
      entry.node.work();
      entry.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
      ++entry.runs;
    });
    entry.in = node.get();
    entry.out = node.get();
    entry.flow = std::move(node);
  }
};

TaskGraph::TaskGraph(std::string name) : impl_(std::make_unique<Impl>()) {
  impl_->name = std::move(name);
}
TaskGraph::~TaskGraph() = default;

void TaskGraph::given(std::vector<std::string> names) {
  impl_->known.insert(names.begin(), names.end());
}

void TaskGraph::add(Node node) {
  impl_->entries.push_back({});
  impl_->entries.back().node = std::move(node);
}

void TaskGraph::build() {
  Impl& g = *impl_;
  std::set<std::string> known = g.known;
  for (const auto& entry : g.entries) {
    for (const std::string& name : entry.node.reads) {
      if (!known.contains(name)) {
        throw std::logic_error("graph '" + g.name + "': node '" + entry.node.name + "' reads '" +
                               name + "', which no node before it writes");
      }
    }
    known.insert(entry.node.writes.begin(), entry.node.writes.end());
  }
  g.derive_edges();

  g.start = std::make_unique<tbb::flow::broadcast_node<tbb::flow::continue_msg>>(g.flow);
  // In a chain run inside another graph's node, a task per node moves the work from thread to
  // thread and leaves the parallel loops in it without helpers: measured, two threads were no
  // faster than one (docs/decisions/0005_light_nodes_for_chains.md). The light kind keeps a chain
  // on one thread.
  const bool is_chain = g.is_chain();
  for (auto& entry : g.entries) {
    if (is_chain) {
      g.make_node<LightNode>(entry);
    } else {
      g.make_node<FlowNode>(entry);
    }
  }
  for (std::size_t n = 0; n < g.entries.size(); ++n) {
    const bool is_first = std::none_of(g.edges.begin(), g.edges.end(), [&](const auto& edge) {
      return edge.second == static_cast<int>(n);
    });
    if (is_first) tbb::flow::make_edge(*g.start, *g.entries[n].in);
  }
  for (const auto& [from, to] : g.edges) {
    tbb::flow::make_edge(*g.entries[static_cast<std::size_t>(from)].out,
                         *g.entries[static_cast<std::size_t>(to)].in);
  }
}

void TaskGraph::run() {
  Impl& g = *impl_;
  g.start->try_put(tbb::flow::continue_msg{});
  g.flow.wait_for_all();
  ++g.passes;
  // A node that misses a predecessor's signal never runs and raises nothing: hence the count.
  for (const auto& entry : g.entries) {
    if (entry.runs != g.passes) {
      throw std::logic_error("graph '" + g.name + "': node '" + entry.node.name + "' ran " +
                             std::to_string(entry.runs) + " times in " + std::to_string(g.passes) +
                             " passes");
    }
  }
}

const std::string& TaskGraph::name() const { return impl_->name; }

std::vector<NodeTiming> TaskGraph::timings() const {
  std::vector<NodeTiming> rows;
  for (const auto& e : impl_->entries) rows.push_back({e.node.name, e.seconds, e.runs});
  return rows;
}

std::vector<std::pair<int, int>> TaskGraph::edges() const { return impl_->edges; }

std::string TaskGraph::dot_cluster(int indent) const {
  const Impl& g = *impl_;
  const std::string pad(static_cast<std::size_t>(indent), ' ');
  std::ostringstream out;
  out << pad << "subgraph \"cluster_" << g.name << "\" {\n"
      << pad << "  label=\"" << g.name << "\";\n";
  for (const auto& e : g.entries) {
    out << pad << "  \"" << g.name << '.' << e.node.name << "\" [label=\"" << e.node.name;
    if (e.runs > 0) {
      out.precision(3);
      out << "\\n" << e.runs << " runs, " << e.seconds << " s";
    }
    out << "\", tooltip=\"reads: " << list(e.node.reads) << "\\nwrites: " << list(e.node.writes)
        << "\"];\n";
  }
  for (const auto& [from, to] : g.edges) {
    out << pad << "  \"" << g.name << '.' << g.entries[static_cast<std::size_t>(from)].node.name
        << "\" -> \"" << g.name << '.' << g.entries[static_cast<std::size_t>(to)].node.name
        << "\";\n";
  }
  out << pad << "}\n";
  return out.str();
}

}  // namespace dust::graph
