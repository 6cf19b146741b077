// SPDX-License-Identifier: Apache-2.0
#include "airborne/cells/small_cells.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace dust::airborne {
namespace {

struct Searcher {
  const fluid::Grid& grid;
  const Flow& flow;

  [[nodiscard]] double share(std::ptrdiff_t cell) const {
    return std::min(flow.volume_before[static_cast<std::size_t>(cell)],
                    flow.volume_after[static_cast<std::size_t>(cell)]);
  }
  /// The neighbour that most gas fills beyond an open face. Of a cell that a body had closed before
  /// the end of the step, with all its faces, that which most of its gas has gone to. -1 where
  /// there is none.
  [[nodiscard]] std::ptrdiff_t host_of(std::ptrdiff_t cell) const {
    const std::ptrdiff_t open =
        best_neighbour(cell, [&](std::size_t d, std::ptrdiff_t face, double /*outward*/) {
          return flow.passage.component[d][static_cast<std::size_t>(face)];
        });
    if (open >= 0) return open;
    return best_neighbour(cell, [&](std::size_t d, std::ptrdiff_t face, double outward) {
      return outward * flow.throughflow.component[d][static_cast<std::size_t>(face)];
    });
  }
  /// That for which `weight` of the face between, times its gas, is largest and above 0.
  template <class Weight>
  [[nodiscard]] std::ptrdiff_t best_neighbour(std::ptrdiff_t cell, const Weight& weight) const {
    std::ptrdiff_t best = -1;
    double most = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      const std::ptrdiff_t s = grid.stride[d];
      const auto look = [&](std::ptrdiff_t face, std::ptrdiff_t neighbour, double outward) {
        const double value = weight(d, face, outward) * share(neighbour);
        // Halo cells hold no gas of their own.
        if (value > most && is_inside_[static_cast<std::size_t>(neighbour)] != 0) {
          most = value;
          best = neighbour;
        }
      };
      look(cell, cell - s, -1.0);
      look(cell + s, cell + s, 1.0);
    }
    return best;
  }
  explicit Searcher(const fluid::Grid& g, const Flow& f) : grid(g), flow(f), is_inside_(g.size, 0) {
    for (int k = 0; k < g.count[2]; ++k) {
      for (int j = 0; j < g.count[1]; ++j) {
        std::fill_n(is_inside_.begin() + g.index(0, j, k), g.count[0], char{1});
      }
    }
  }

 private:
  std::vector<char> is_inside_;
};

/// Slivers by the neighbours that they are most open to, which may be slivers themselves.
class Chains {
 public:
  Chains(const Searcher& searcher, const std::vector<std::ptrdiff_t>& slivers) {
    for (const std::ptrdiff_t cell : slivers) {
      if (const std::ptrdiff_t found = searcher.host_of(cell); found >= 0) host_[cell] = found;
    }
    for (const std::ptrdiff_t cell : slivers) open_ring(cell);
    std::vector<std::pair<int, std::ptrdiff_t>> by_links;
    by_links.reserve(host_.size());
    for (const auto& [cell, host] : host_) by_links.emplace_back(links(cell), cell);
    std::sort(by_links.begin(), by_links.end());
    for (const auto& [links, cell] : by_links) order_.push_back(cell);
  }
  /// Of each sliver that has one; from the cells that all chains end at outwards.
  [[nodiscard]] const std::vector<std::ptrdiff_t>& order() const { return order_; }
  [[nodiscard]] std::ptrdiff_t host(std::ptrdiff_t cell) const { return host_.at(cell); }
  [[nodiscard]] bool has_host(std::ptrdiff_t cell) const { return host_.count(cell) > 0; }

 private:
  /// Slivers that are each other's hosts all round: the lowest of them is theirs.
  void open_ring(std::ptrdiff_t cell) {
    std::vector<std::ptrdiff_t> way;
    for (; has_host(cell) && !is_open_.contains(cell); cell = host(cell)) {
      const auto seen = std::find(way.begin(), way.end(), cell);
      if (seen != way.end()) {
        host_.erase(*std::min_element(seen, way.end()));
        break;
      }
      way.push_back(cell);
    }
    is_open_.insert(way.begin(), way.end());
  }
  [[nodiscard]] int links(std::ptrdiff_t cell) const {
    int count = 0;
    for (; has_host(cell); cell = host(cell)) ++count;
    return count;
  }

  std::map<std::ptrdiff_t, std::ptrdiff_t> host_;
  std::set<std::ptrdiff_t> is_open_;  ///< their chains end
  std::vector<std::ptrdiff_t> order_;
};

/// Groups of cells that are one volume to dust: each sliver with its host, as far as a group has
/// less volume than makes a cell none. So a slot is several groups along it.
class Groups {
 public:
  Groups(const Searcher& searcher, const Chains& chains) : searcher_(searcher) {
    for (const std::ptrdiff_t cell : chains.order()) {
      const std::size_t group = group_of(chains.host(cell));
      const bool is_host_open = searcher.share(chains.host(cell)) >= SmallCells::k_small_share;
      if (is_host_open || all_[group].volume < SmallCells::k_small_share) {
        join(cell, group);
      } else {
        group_of(cell);
      }
    }
    // What is left at the ends of chains goes to the group before.
    for (std::size_t n = all_.size(); n-- > 0;) {
      const std::ptrdiff_t first = all_[n].cells.front();
      if (all_[n].volume >= SmallCells::k_small_share || !chains.has_host(first)) continue;
      const std::size_t before = group_of(chains.host(first));
      const std::vector<std::ptrdiff_t> cells = std::move(all_[n].cells);
      all_[n].cells.clear();
      for (const std::ptrdiff_t cell : cells) join(cell, before);
    }
  }
  /// The host first, then the others ascending; by their hosts.
  [[nodiscard]] std::map<std::ptrdiff_t, std::vector<std::ptrdiff_t>> by_host() const {
    std::map<std::ptrdiff_t, std::vector<std::ptrdiff_t>> found;
    for (const Group& group : all_) {
      if (group.cells.size() < 2) continue;
      std::vector<std::ptrdiff_t> others(group.cells.begin() + 1, group.cells.end());
      std::sort(others.begin(), others.end());
      found[group.cells.front()] = std::move(others);
    }
    return found;
  }

 private:
  struct Group {
    std::vector<std::ptrdiff_t> cells;
    double volume = 0.0;  ///< [-] of a whole cell
  };
  void join(std::ptrdiff_t cell, std::size_t group) {
    all_[group].cells.push_back(cell);
    all_[group].volume += searcher_.share(cell);
    group_[cell] = group;
  }
  /// That of a cell, which may be a new one.
  std::size_t group_of(std::ptrdiff_t cell) {
    const auto [at, is_new] = group_.try_emplace(cell, all_.size());
    if (is_new) {
      all_.emplace_back();
      join(cell, all_.size() - 1);
    }
    return group_.at(cell);
  }

  const Searcher& searcher_;
  std::vector<Group> all_;
  std::map<std::ptrdiff_t, std::size_t> group_;
};

}  // namespace

void SmallCells::find(const fluid::Grid& grid, const Flow& flow) {
  cell_.clear();
  begin_.clear();
  std::vector<std::ptrdiff_t> small;
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) {
        const auto at = static_cast<std::size_t>(o + i);
        const double share = std::min(flow.volume_before[at], flow.volume_after[at]);
        const bool has_gas = flow.volume_before[at] > 0.0 || flow.volume_after[at] > 0.0;
        if (has_gas && share < k_small_share) small.push_back(o + i);
      }
    }
  }
  if (small.empty()) return;
  const Searcher searcher(grid, flow);
  const Groups groups(searcher, Chains(searcher, small));
  for (const auto& [root, members] : groups.by_host()) {
    begin_.push_back(static_cast<std::int32_t>(cell_.size()));
    cell_.push_back(static_cast<std::int32_t>(root));
    for (const std::ptrdiff_t cell : members) cell_.push_back(static_cast<std::int32_t>(cell));
  }
  begin_.push_back(static_cast<std::int32_t>(cell_.size()));
}

double SmallCells::sum(const fluid::CellField& field, std::size_t group) const {
  double all = 0.0;
  for (std::int32_t n = begin_[group]; n < begin_[group + 1]; ++n) {
    all += field[static_cast<std::size_t>(cell_[static_cast<std::size_t>(n)])];
  }
  return all;
}

void SmallCells::mix(fluid::CellField& mass, const fluid::CellField& volume) const {
  for (std::size_t g = 0; g < groups(); ++g) {
    const double all = sum(mass, g);
    const double room = sum(volume, g);
    if (!(room > 0.0)) continue;
    // The host takes what rounding leaves over.
    double rest = all;
    for (std::int32_t n = begin_[g + 1] - 1; n > begin_[g]; --n) {
      const auto cell = static_cast<std::size_t>(cell_[static_cast<std::size_t>(n)]);
      mass[cell] = all * (volume[cell] / room);
      rest -= mass[cell];
    }
    mass[static_cast<std::size_t>(cell_[static_cast<std::size_t>(begin_[g])])] =
        std::max(rest, 0.0);
  }
}

void SmallCells::join_rates(fluid::CellField& outflow, fluid::CellField& volume) const {
  for (std::size_t g = 0; g < groups(); ++g) {
    const double all = sum(outflow, g);
    const double room = sum(volume, g);
    for (std::int32_t n = begin_[g]; n < begin_[g + 1]; ++n) {
      const auto cell = static_cast<std::size_t>(cell_[static_cast<std::size_t>(n)]);
      outflow[cell] = all;
      volume[cell] = room;
    }
  }
}

}  // namespace dust::airborne
