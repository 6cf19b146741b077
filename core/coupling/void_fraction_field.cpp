// SPDX-License-Identifier: Apache-2.0
#include "coupling/void_fraction_field.hpp"

#include "dust/sdk/sphere.hpp"

#include <tbb/parallel_for.h>

namespace dust::coupling {
namespace {

constexpr std::size_t k_block = 2048;  ///< grains per task; never a function of the threads
/// Most rows of one call of the rule, so that wide rules do not ask for gigabytes; whole blocks of
/// rules with up to 8 cells per grain.
constexpr std::size_t k_max_rows = 8 * k_block;
constexpr int k_max_sweeps = 32;  ///< cells over which an overfull cell's volume may travel

/// Columns of one block in the form the rule reads and writes.
struct Columns {
  std::vector<double> x, y, z, radius, weight;
  std::vector<int> used, i, j, k;
};

sdk::VoidageBatch batch_of(Columns& c, std::size_t count, int capacity) {
  const std::size_t rows = count * static_cast<std::size_t>(capacity);
  for (auto* column : {&c.x, &c.y, &c.z, &c.radius}) column->resize(count);
  for (auto* column : {&c.i, &c.j, &c.k}) column->resize(rows);
  c.used.resize(count);
  c.weight.resize(rows);
  return {count,         c.x.data(), c.y.data(), c.z.data(), c.radius.data(), capacity,
          c.used.data(), c.i.data(), c.j.data(), c.k.data(), c.weight.data()};
}

}  // namespace

VoidFractionField::VoidFractionField(const Lattice& lattice, const sdk::VoidageRule& rule)
    : lattice_(lattice), rule_(rule) {
  before_.eps.assign(lattice.grid().size, 1.0);
  after_.eps = before_.eps;
  volume_.assign(lattice.grid().size, 0.0);
  offered_ = volume_;
}

void VoidFractionField::spread(const particles::GrainRows& grains, std::size_t first,
                               std::size_t last, std::vector<Share>& shares, Counts& counts) const {
  static thread_local Columns columns;
  const fluid::Grid& grid = lattice_.grid();
  const double least_spacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  double largest_radius = 0.0;
  for (std::size_t row = first; row < last; ++row) {
    const double radius = grains.radius(row);
    if (radius > largest_radius) {
      largest_radius = radius;
      counts.largest_row = row;
    }
  }
  counts.largest_ratio = 2.0 * largest_radius / least_spacing;
  shares.clear();
  const int capacity = rule_.capacity(grid.shape(), largest_radius);
  const std::size_t rows_per_call =
      std::max(std::size_t{1}, k_max_rows / static_cast<std::size_t>(capacity));
  for (std::size_t row = first; row < last; row += rows_per_call) {
    const sdk::VoidageBatch batch =
        batch_of(columns, std::min(rows_per_call, last - row), capacity);
    for (std::size_t g = 0; g < batch.count; ++g) {
      const double* p = grains.position_of(row + g);
      columns.x[g] = p[0];
      columns.y[g] = p[1];
      columns.z[g] = p[2];
      columns.radius[g] = grains.radius(row + g);
    }
    rule_.spread(grid.shape(), batch);
    take_shares(grains, row, batch, shares, counts);
  }
}

/// Moves the rule's shares of the rows from `first` on to open cells.
void VoidFractionField::take_shares(const particles::GrainRows& grains, std::size_t first,
                                    const sdk::VoidageBatch& batch, std::vector<Share>& shares,
                                    Counts& counts) const {
  for (std::size_t g = 0; g < batch.count; ++g) {
    const std::size_t row = first + g;
    const double volume = grains.weight[row] * sdk::sphere_volume(grains.diameter(row));
    const std::size_t begin = g * static_cast<std::size_t>(batch.capacity);
    const std::size_t own = shares.size();
    double open_weight = 0.0;
    int closed = 0;
    for (std::size_t n = begin; n < begin + static_cast<std::size_t>(batch.used[g]); ++n) {
      const std::ptrdiff_t cell =
          lattice_.open_cell(batch.cell_i[n], batch.cell_j[n], batch.cell_k[n]);
      if (cell < 0) {
        ++closed;
        continue;
      }
      open_weight += batch.weight[n];
      shares.push_back({cell, volume * batch.weight[n]});
    }
    if (closed == 0) continue;
    counts.moved_shares += closed;
    if (open_weight > 0.0) {
      // The grain's open cells take the rest in the ratio of their own shares.
      for (std::size_t n = own; n < shares.size(); ++n) shares[n].volume /= open_weight;
      continue;
    }
    shares.resize(own);
    const std::ptrdiff_t cell = lattice_.nearest_open_cell(grains.position_of(row));
    if (cell >= 0) {
      shares.push_back({cell, volume});
    } else {
      ++counts.unplaced_grains;
    }
  }
}

void VoidFractionField::add(std::ptrdiff_t cell, double volume) {
  if (volume_[cell] == 0.0) after_.active.push_back(cell);
  volume_[cell] += volume;
}

/// Room for solids [m3] that a cell still has.
double VoidFractionField::room(std::ptrdiff_t cell) const {
  const double allowed =
      (1.0 - k_smallest_void_fraction) * lattice_.cell_volume() * lattice_.open_fraction(cell);
  return std::max(0.0, allowed - volume_[cell]);
}

/// What each overfull cell would give to which neighbour, by the volumes as they are: all of its
/// excess, in the ratio of the room that its neighbours have, as far as they have any.
bool VoidFractionField::find_transfers() {
  // A cell filled to the limit by a neighbour must not count as overfull for its rounding.
  constexpr double k_rounding = 1e-12;
  const double allowed = (1.0 - k_smallest_void_fraction) * lattice_.cell_volume();
  bool is_any_overfull = false;
  transfers_.clear();
  for (const std::ptrdiff_t cell : after_.active) {
    const double excess = volume_[cell] - allowed * lattice_.open_fraction(cell);
    if (excess <= k_rounding * allowed) continue;
    is_any_overfull = true;
    const auto neighbours = lattice_.open_neighbours(cell);
    double total = 0.0;
    for (const std::ptrdiff_t other : neighbours) total += other < 0 ? 0.0 : room(other);
    if (total <= 0.0) continue;
    for (const std::ptrdiff_t other : neighbours) {
      if (other < 0) continue;
      const double part = std::min(1.0, excess / total) * room(other);
      if (part > 0.0) transfers_.push_back({cell, other, part});
    }
  }
  return is_any_overfull;
}

/// Overfull cells give their excess to open neighbours in the ratio of the room these have. All of
/// them give at once, and a neighbour that is offered more than it has room for takes the same
/// share of each offer: so the field does not depend on the order of the grains. What finds no room
/// within k_max_sweeps cells stays, and shows in the smallest void fraction.
std::int64_t VoidFractionField::redistribute_excess() {
  std::int64_t limited = 0;
  for (int sweep = 0; sweep < k_max_sweeps && find_transfers(); ++sweep) {
    if (transfers_.empty()) break;
    for (const Transfer& t : transfers_) offered_[t.to] += t.volume;
    for (Transfer& t : transfers_) t.volume *= std::min(1.0, room(t.to) / offered_[t.to]);
    std::ptrdiff_t last = -1;
    for (const Transfer& t : transfers_) {
      volume_[t.from] -= t.volume;
      add(t.to, t.volume);
      offered_[t.to] = 0.0;
      limited += t.from == last ? 0 : 1;
      last = t.from;
    }
  }
  return limited;
}

VoidFractionField::Counts VoidFractionField::deposit(const particles::GrainRows& grains) {
  std::swap(before_, after_);
  for (const std::ptrdiff_t cell : after_.active) after_.eps[cell] = 1.0;
  after_.active.clear();

  const std::size_t blocks = (grains.count + k_block - 1) / k_block;
  if (shares_.size() < blocks) shares_.resize(blocks);
  std::vector<Counts> counts(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t c) {
    spread(grains, c * k_block, std::min(grains.count, (c + 1) * k_block), shares_[c], counts[c]);
  });

  Counts total;
  for (std::size_t c = 0; c < blocks; ++c) {
    for (const Share& share : shares_[c]) add(share.cell, share.volume);
    total.moved_shares += counts[c].moved_shares;
    total.unplaced_grains += counts[c].unplaced_grains;
    if (counts[c].largest_ratio > total.largest_ratio) {
      total.largest_ratio = counts[c].largest_ratio;
      total.largest_row = counts[c].largest_row;
    }
  }
  total.limited_cells = redistribute_excess();
  for (const std::ptrdiff_t cell : after_.active) {
    const double eps =
        1.0 - volume_[cell] / (lattice_.open_fraction(cell) * lattice_.cell_volume());
    after_.eps[cell] = eps;
    volume_[cell] = 0.0;
    total.smallest = std::min(total.smallest, eps);
  }
  return total;
}

void VoidFractionField::add_after(std::ptrdiff_t cell, double volume) {
  double& eps = after_.eps[cell];
  if (eps == 1.0) after_.active.push_back(cell);
  // What is taken away again must not leave more than nothing by rounding.
  eps = std::min(1.0, eps - volume / (lattice_.open_fraction(cell) * lattice_.cell_volume()));
}

std::vector<double> VoidFractionField::solids() const {
  std::vector<double> solids;
  solids.reserve(after_.active.size());
  for (const std::ptrdiff_t cell : after_.active) {
    solids.push_back((1.0 - after_.eps[cell]) * lattice_.open_fraction(cell) *
                     lattice_.cell_volume());
  }
  return solids;
}

void VoidFractionField::keep_solids(const std::vector<double>& solids) {
  for (std::size_t n = 0; n < after_.active.size(); ++n) {
    const std::ptrdiff_t cell = after_.active[n];
    const double open = lattice_.open_fraction(cell) * lattice_.cell_volume();
    if (open > 0.0) after_.eps[cell] = 1.0 - solids[n] / open;
  }
}

void VoidFractionField::save(sdk::ArchiveWriter& archive) const {
  const auto save_state = [&](const char* cells, const char* values, const State& state) {
    std::vector<std::int64_t> indices(state.active.begin(), state.active.end());
    std::vector<double> eps;
    eps.reserve(indices.size());
    for (const std::ptrdiff_t cell : state.active) eps.push_back(state.eps[cell]);
    archive.integers(cells, indices);
    archive.numbers(values, eps);
  };
  save_state("cells_before", "void_fraction_before", before_);
  save_state("cells_after", "void_fraction_after", after_);
}

void VoidFractionField::load(sdk::ArchiveReader& archive) {
  const auto load_state = [&](const char* cells, const char* values, State& state) {
    state.eps.assign(lattice_.grid().size, 1.0);
    const std::vector<std::int64_t> indices = archive.integers(cells);
    const std::vector<double> eps = archive.numbers(values);
    state.active.assign(indices.begin(), indices.end());
    for (std::size_t n = 0; n < indices.size(); ++n) state.eps[state.active[n]] = eps[n];
  };
  load_state("cells_before", "void_fraction_before", before_);
  load_state("cells_after", "void_fraction_after", after_);
}

}  // namespace dust::coupling
