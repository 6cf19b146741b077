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

void add_names(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

struct TaskGraph::Impl {
  /// What the flow graph runs: a node, or some that are fused.
  struct Unit {
    std::size_t first = 0;
    std::size_t count = 1;
    std::function<void()> work;
    double seconds = 0.0;
    std::int64_t runs = 0;
    std::unique_ptr<tbb::flow::graph_node> flow;
    Receiver* in = nullptr;
    Sender* out = nullptr;
  };

  std::string name;
  std::set<std::string> known;
  std::vector<Node> nodes;
  std::vector<std::pair<int, int>> edges;
  std::vector<Fusion> fusions;
  Digests digests;
  int checked_every = 1;
  std::vector<std::unique_ptr<Unit>> units;
  tbb::flow::graph flow;
  std::unique_ptr<tbb::flow::broadcast_node<tbb::flow::continue_msg>> start;
  std::int64_t passes = 0;

  void check_reads() const {
    std::set<std::string> there = known;
    for (const Node& node : nodes) {
      for (const std::string& read : node.reads) {
        if (there.contains(read)) continue;
        throw std::logic_error("graph '" + name + "': node '" + node.name + "' reads '" + read +
                               "', which no node before it writes");
      }
      there.insert(node.writes.begin(), node.writes.end());
    }
  }

  /// Edges of nodes in their order: what conflicts keeps it.
  static std::vector<std::pair<int, int>> edges_of(const std::vector<Node>& nodes) {
    const auto count = nodes.size();
    std::vector<std::pair<int, int>> edges;
    // reach[a][b]: a must finish before b starts, through any chain.
    std::vector<std::vector<bool>> reach(count, std::vector<bool>(count, false));
    for (std::size_t to = 0; to < count; ++to) {
      // Nearest predecessors first: a farther one already reached through a nearer one adds no
      // edge.
      for (std::size_t from = to; from-- > 0;) {
        if (!conflict(nodes[from], nodes[to]) || reach[from][to]) continue;
        edges.emplace_back(static_cast<int>(from), static_cast<int>(to));
        reach[from][to] = true;
        for (std::size_t before = 0; before < from; ++before) {
          if (reach[before][from]) reach[before][to] = true;
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  /// The fusion that begins with node n and whose nodes stand one behind the other.
  [[nodiscard]] const Fusion* fusion_at(std::size_t n) const {
    for (const Fusion& f : fusions) {
      if (n + f.nodes.size() > nodes.size()) continue;
      if (std::equal(
              f.nodes.begin(), f.nodes.end(), nodes.begin() + static_cast<std::ptrdiff_t>(n),
              [](const std::string& wanted, const Node& node) { return wanted == node.name; })) {
        return &f;
      }
    }
    return nullptr;
  }

  /// The units, and each as a node with what all of its nodes read and write.
  std::vector<Node> make_units() {
    std::vector<Node> as_nodes;
    for (std::size_t n = 0; n < nodes.size();) {
      const Fusion* fusion = digests.empty() ? fusion_at(n) : nullptr;
      auto unit = std::make_unique<Unit>();
      unit->first = n;
      unit->count = fusion != nullptr ? fusion->nodes.size() : 1;
      unit->work = fusion != nullptr ? fusion->work : nodes[n].work;
      Node all;
      for (std::size_t k = n; k < n + unit->count; ++k) {
        add_names(all.reads, nodes[k].reads);
        add_names(all.writes, nodes[k].writes);
      }
      as_nodes.push_back(std::move(all));
      n += unit->count;
      units.push_back(std::move(unit));
    }
    return as_nodes;
  }

  /// Every unit waits for the one before it: nothing could overlap.
  static bool is_chain(const std::vector<std::pair<int, int>>& edges, std::size_t count) {
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const int from = static_cast<int>(n);
      if (edges[n] != std::pair{from, from + 1}) return false;
    }
    return edges.size() + 1 == count;
  }

  static void run_unit(Unit& unit) {
    const auto begin = Clock::now();
    unit.work();
    unit.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    ++unit.runs;
  }

  template <class FlowKind>
  void make_flow_node(Unit& unit) {
    auto node = std::make_unique<FlowKind>(
        flow, [&unit](const tbb::flow::continue_msg&) { run_unit(unit); });
    unit.in = node.get();
    unit.out = node.get();
    unit.flow = std::move(node);
  }

  /// One node after the other, looking at everything before and after.
  void run_checked() {
    const bool is_looked_at = passes % checked_every == 0;
    const auto look = [&] {
      std::map<std::string, std::uint64_t> found;
      if (!is_looked_at) return found;
      for (const auto& [what, digest] : digests) found[what] = digest();
      return found;
    };
    auto before = look();
    for (const auto& unit : units) {
      run_unit(*unit);
      auto after = look();
      const Node& node = nodes[unit->first];
      for (const auto& [what, value] : after) {
        const bool is_declared =
            std::find(node.writes.begin(), node.writes.end(), what) != node.writes.end();
        if (value == before[what] || is_declared) continue;
        throw std::logic_error("graph '" + name + "': node '" + node.name + "' has changed '" +
                               what + "', which it does not declare to write");
      }
      before = std::move(after);
    }
  }

  /// The unit that runs node n, and the share of its time.
  [[nodiscard]] NodeTiming timing(const Unit& unit, std::size_t n) const {
    double share = 1.0;
    if (unit.count > 1) {
      const auto shares = fusion_at(unit.first)->shares();
      share = shares.at(n - unit.first);
    }
    return {nodes[n].name, share * unit.seconds, unit.runs};
  }
};

TaskGraph::TaskGraph(std::string name) : impl_(std::make_unique<Impl>()) {
  impl_->name = std::move(name);
}
TaskGraph::~TaskGraph() = default;

void TaskGraph::given(std::vector<std::string> names) {
  impl_->known.insert(names.begin(), names.end());
}

void TaskGraph::add(Node node) { impl_->nodes.push_back(std::move(node)); }
void TaskGraph::fuse(Fusion fusion) { impl_->fusions.push_back(std::move(fusion)); }
void TaskGraph::check_writes(Digests digests, int every) {
  impl_->digests = std::move(digests);
  impl_->checked_every = every;
}

std::vector<std::string> TaskGraph::unchecked_writes() const {
  std::set<std::string> names;
  for (const Node& node : impl_->nodes) names.insert(node.writes.begin(), node.writes.end());
  std::erase_if(names, [&](const std::string& name) { return impl_->digests.contains(name); });
  return {names.begin(), names.end()};
}

void TaskGraph::build() {
  Impl& g = *impl_;
  g.check_reads();
  g.edges = Impl::edges_of(g.nodes);
  const auto edges = Impl::edges_of(g.make_units());

  g.start = std::make_unique<tbb::flow::broadcast_node<tbb::flow::continue_msg>>(g.flow);
  // In a chain run inside another graph's node, a task per node moves the work from thread to
  // thread and leaves the parallel loops in it without helpers: measured, two threads were no
  // faster than one (docs/decisions/0005_light_nodes_for_chains.md). The light kind keeps a chain
  // on one thread.
  const bool is_chain = Impl::is_chain(edges, g.units.size());
  for (auto& unit : g.units) {
    if (is_chain) {
      g.make_flow_node<LightNode>(*unit);
    } else {
      g.make_flow_node<FlowNode>(*unit);
    }
  }
  for (std::size_t n = 0; n < g.units.size(); ++n) {
    const bool is_first = std::none_of(edges.begin(), edges.end(), [&](const auto& edge) {
      return edge.second == static_cast<int>(n);
    });
    if (is_first) tbb::flow::make_edge(*g.start, *g.units[n]->in);
  }
  for (const auto& [from, to] : edges) {
    tbb::flow::make_edge(*g.units[static_cast<std::size_t>(from)]->out,
                         *g.units[static_cast<std::size_t>(to)]->in);
  }
}

void TaskGraph::run() {
  Impl& g = *impl_;
  ++g.passes;
  if (!g.digests.empty()) {
    g.run_checked();
    return;
  }
  g.start->try_put(tbb::flow::continue_msg{});
  g.flow.wait_for_all();
  // A node that misses a predecessor's signal never runs and raises nothing: hence the count.
  for (const auto& unit : g.units) {
    if (unit->runs == g.passes) continue;
    throw std::logic_error("graph '" + g.name + "': node '" + g.nodes[unit->first].name + "' ran " +
                           std::to_string(unit->runs) + " times in " + std::to_string(g.passes) +
                           " passes");
  }
}

const std::string& TaskGraph::name() const { return impl_->name; }

std::vector<NodeTiming> TaskGraph::timings() const {
  std::vector<NodeTiming> rows;
  for (const auto& unit : impl_->units) {
    for (std::size_t k = 0; k < unit->count; ++k) {
      rows.push_back(impl_->timing(*unit, unit->first + k));
    }
  }
  return rows;
}

std::vector<std::pair<int, int>> TaskGraph::edges() const { return impl_->edges; }

std::string TaskGraph::dot_cluster(int indent) const {
  const Impl& g = *impl_;
  const std::string pad(static_cast<std::size_t>(indent), ' ');
  std::ostringstream out;
  out << pad << "subgraph \"cluster_" << g.name << "\" {\n"
      << pad << "  label=\"" << g.name << "\";\n";
  for (const auto& unit : g.units) {
    const bool is_fused = unit->count > 1;
    if (is_fused) {
      const Fusion& fusion = *g.fusion_at(unit->first);
      out << pad << "  subgraph \"cluster_" << g.name << '.' << fusion.part << "\" {\n"
          << pad << "  label=\"per " << fusion.part << "\"; style=dashed;\n";
    }
    for (std::size_t n = unit->first; n < unit->first + unit->count; ++n) {
      const Node& node = g.nodes[n];
      out << pad << "  \"" << g.name << '.' << node.name << "\" [label=\"" << node.name;
      if (unit->runs > 0) {
        out.precision(3);
        out << "\\n" << unit->runs << " runs, " << g.timing(*unit, n).seconds << " s";
      }
      out << "\", tooltip=\"reads: " << list(node.reads) << "\\nwrites: " << list(node.writes)
          << "\"];\n";
    }
    if (is_fused) out << pad << "  }\n";
  }
  for (const auto& [from, to] : g.edges) {
    out << pad << "  \"" << g.name << '.' << g.nodes[static_cast<std::size_t>(from)].name
        << "\" -> \"" << g.name << '.' << g.nodes[static_cast<std::size_t>(to)].name << "\";\n";
  }
  out << pad << "}\n";
  return out.str();
}

}  // namespace dust::graph
