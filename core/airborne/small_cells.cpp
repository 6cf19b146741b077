// SPDX-License-Identifier: Apache-2.0
#include "airborne/small_cells.hpp"

#include <algorithm>
#include <map>

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
  // A sliver may lie beside another: hosts of hosts, by the lowest of each chain.
  std::map<std::ptrdiff_t, std::ptrdiff_t> host;
  for (const std::ptrdiff_t cell : small) {
    const std::ptrdiff_t found = searcher.host_of(cell);
    if (found >= 0) host[cell] = found;
  }
  const auto root_of = [&](std::ptrdiff_t cell) {
    std::ptrdiff_t lowest = cell;
    for (std::size_t n = 0; n <= host.size(); ++n) {
      const auto next = host.find(cell);
      if (next == host.end()) return cell;
      cell = next->second;
      lowest = n == 0 ? cell : std::min(lowest, cell);
    }
    return lowest;  // a ring of slivers
  };
  std::map<std::ptrdiff_t, std::vector<std::ptrdiff_t>> groups;
  for (const auto& [cell, next] : host) {
    const std::ptrdiff_t root = root_of(cell);
    if (root != cell) groups[root].push_back(cell);
  }
  for (const auto& [root, members] : groups) {
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
