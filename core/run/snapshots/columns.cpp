// SPDX-License-Identifier: Apache-2.0
#include "run/snapshots/columns.hpp"

#include "base/periodic.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace dust::run {
namespace {

enum Column {
  k_x,
  k_y,
  k_z,
  k_x_before,
  k_y_before,
  k_z_before,
  k_velocity_x,
  k_velocity_y,
  k_velocity_z,
  k_rotation_x,
  k_rotation_y,
  k_rotation_z,
  k_force_x,
  k_force_y,
  k_force_z,
  k_diameter,
  k_mass,
  k_weight,
  k_x_in_domain,
  k_y_in_domain,
  k_z_in_domain
};

}  // namespace

GrainTable::GrainTable(const scenario::DomainSpec& domain) : min_(domain.min) {
  for (int d = 0; d < 3; ++d) {
    const auto& side = domain.sides[static_cast<std::size_t>(2 * d)];
    if (side.grains == scenario::GrainSide::periodic) period_[d] = domain.max[d] - domain.min[d];
  }
}

double GrainTable::in_domain(double x, int d) const {
  if (!(period_[d] > 0.0)) return x;
  if (x < min_[d]) return x + period_[d];
  return x >= min_[d] + period_[d] ? x - period_[d] : x;
}

void GrainTable::note_insertions(const particles::GrainRows& rows) {
  insertions_.clear();
  const std::int64_t newest = before_.empty() ? -1 : before_.back().id;
  for (std::size_t n = 0; n < rows.count; ++n) {
    // Ids grow with time of entry, so an id beyond the newest of the last sample came in since.
    if (rows.id[n] > newest) {
      const sdk::Vec3 x = rows.centre(n);
      insertions_.push_back({rows.id[n], x.x, x.y, x.z});
    }
  }
  const auto by_id = [](const Place& a, const Place& b) { return a.id < b.id; };
  std::sort(insertions_.begin(), insertions_.end(), by_id);
}

void GrainTable::find_order(const particles::GrainRows& rows) {
  const auto by_id = [&](std::size_t a, std::size_t b) { return rows.id[a] < rows.id[b]; };
  // From step to step rows seldom change places.
  if (order_.size() == rows.count && std::is_sorted(order_.begin(), order_.end(), by_id)) return;
  order_.resize(rows.count);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(), by_id);
}

void GrainTable::publish(const particles::GrainRows& rows, std::span<const double> force) {
  const std::size_t count = rows.count;
  find_order(rows);
  id_.resize(count);
  material_.resize(count);
  for (auto& column : number_) column.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t row = order_[n];
    id_[n] = rows.id[row];
    material_[n] = rows.material[row];
    for (int d = 0; d < 3; ++d) {
      const std::size_t at = 4 * row + static_cast<std::size_t>(d);
      number_[k_x + d][n] = rows.position[at];
      number_[k_x_in_domain + d][n] = in_domain(rows.position[at], d);
      number_[k_velocity_x + d][n] = rows.velocity_of(row)[d];
      number_[k_rotation_x + d][n] = rows.rotation_of(row)[d];
      number_[k_force_x + d][n] = at < force.size() ? force[at] : 0.0;
    }
    number_[k_diameter][n] = rows.diameter(row);
    number_[k_mass][n] = rows.mass(row);
    number_[k_weight][n] = rows.weight[row];
  }
  take_places_before();
}

void GrainTable::take_places_before() {
  const std::size_t count = id_.size();
  auto known = before_.begin();
  auto born = insertions_.begin();
  for (std::size_t n = 0; n < count; ++n) {
    while (known != before_.end() && known->id < id_[n]) ++known;
    while (born != insertions_.end() && born->id < id_[n]) ++born;
    Place from{id_[n], number_[k_x][n], number_[k_y][n], number_[k_z][n]};
    if (known != before_.end() && known->id == id_[n]) {
      from = *known;
    } else if (born != insertions_.end() && born->id == id_[n]) {
      from = *born;
    }
    const sdk::Vec3 before{from.x, from.y, from.z};
    for (int d = 0; d < 3; ++d) {
      const double now = number_[k_x_in_domain + d][n];
      number_[k_x_before + d][n] =
          period_[d] > 0.0 ? now - base::nearest_image_of_any(now - before[d], period_[d])
                           : before[d];
    }
  }
  before_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    before_[n] = {id_[n], number_[k_x][n], number_[k_y][n], number_[k_z][n]};
  }
  insertions_.clear();
}

sdk::GrainColumns GrainTable::columns() const {
  sdk::GrainColumns c = columns_of_solver();
  c.x = number_[k_x_in_domain];
  c.y = number_[k_y_in_domain];
  c.z = number_[k_z_in_domain];
  return c;
}

sdk::GrainColumns GrainTable::columns_of_solver() const {
  sdk::GrainColumns c;
  c.id = id_;
  c.material = material_;
  c.x = number_[k_x];
  c.y = number_[k_y];
  c.z = number_[k_z];
  c.x_before = number_[k_x_before];
  c.y_before = number_[k_y_before];
  c.z_before = number_[k_z_before];
  c.velocity_x = number_[k_velocity_x];
  c.velocity_y = number_[k_velocity_y];
  c.velocity_z = number_[k_velocity_z];
  c.angular_velocity_x = number_[k_rotation_x];
  c.angular_velocity_y = number_[k_rotation_y];
  c.angular_velocity_z = number_[k_rotation_z];
  c.force_x = number_[k_force_x];
  c.force_y = number_[k_force_y];
  c.force_z = number_[k_force_z];
  c.diameter = number_[k_diameter];
  c.mass = number_[k_mass];
  c.weight = number_[k_weight];
  return c;
}

void GrainTable::save(sdk::ArchiveWriter& archive) const {
  std::vector<std::int64_t> ids;
  std::vector<double> places;
  for (const Place& p : before_) {
    ids.push_back(p.id);
    places.insert(places.end(), {p.x, p.y, p.z});
  }
  archive.integers("ids", ids);
  archive.numbers("places", places);
}

void GrainTable::load(sdk::ArchiveReader& archive) {
  const auto ids = archive.integers("ids");
  const auto places = archive.numbers("places");
  before_.clear();
  for (std::size_t n = 0; n < ids.size(); ++n) {
    before_.push_back({ids[n], places[3 * n], places[3 * n + 1], places[3 * n + 2]});
  }
}

FluidTable::FluidTable(const fluid::Grid& grid, const scenario::FluidSpec& fluid,
                       const fluid::CellField& open_fraction)
    : grid_(grid), density_(fluid.density), viscosity_(fluid.viscosity) {
  const std::size_t cells = static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2];
  for (auto& v : velocity_) v.resize(cells);
  pressure_.resize(cells);
  void_fraction_.resize(cells);
  open_fraction_.resize(cells);
  set_open_fraction(open_fraction);
}

void FluidTable::set_open_fraction(const fluid::CellField& open_fraction) {
  std::size_t n = 0;
  for (int k = 0; k < grid_.count[2]; ++k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        open_fraction_[n++] =
            static_cast<float>(open_fraction[static_cast<std::size_t>(grid_.index(i, j, k))]);
      }
    }
  }
}

std::size_t FluidTable::row_beside(int d, int step, int j, int k) const {
  std::array<int, 3> at{0, j, k};
  const int n = grid_.count[d];
  int next = at[d] + step;
  if (grid_.is_periodic[d]) next = (next + n) % n;
  if (next >= 0 && next < n) at[d] = next;
  return static_cast<std::size_t>(grid_.count[0]) *
         (at[1] + static_cast<std::size_t>(grid_.count[1]) * at[2]);
}

void FluidTable::publish_velocity(const fluid::FluidSolver& solver) {
  const auto& velocity = solver.velocity();
  const int nx = grid_.count[0];
  tbb::parallel_for(0, grid_.count[2], [&](int k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      const std::ptrdiff_t from = grid_.index(0, j, k);
      const std::size_t to = row_beside(0, 0, j, k);
      for (int d = 0; d < 3; ++d) {
        const double* low = velocity.component[d].data() + from;
        const double* high = low + grid_.stride[d];
        const std::size_t below = row_beside(d, -1, j, k);
        const std::size_t above = row_beside(d, 1, j, k);
        for (int i = 0; i < nx; ++i) {
          const auto own = static_cast<std::size_t>(i);
          // Along x the neighbours lie in the same row.
          std::size_t before = own;
          std::size_t after = own;
          if (d == 0) {
            const bool wraps = grid_.is_periodic[0];
            if (i > 0 || wraps) before = static_cast<std::size_t>((i + nx - 1) % nx);
            if (i + 1 < nx || wraps) after = static_cast<std::size_t>((i + 1) % nx);
          }
          const double eps = void_fraction_[to + own];
          const auto face = [&](std::size_t beside) {
            return open_fraction_[beside] > 0.0F ? 0.5 * (eps + void_fraction_[beside]) : eps;
          };
          const double flux = 0.5 * (face(below + before) * low[i] + face(above + after) * high[i]);
          velocity_[d][to + own] = static_cast<float>(flux / eps);
        }
      }
    }
  });
}

void FluidTable::publish(const fluid::FluidSolver& solver, const fluid::CellField& void_fraction) {
  const auto& pressure = solver.pressure();
  const int nx = grid_.count[0];
  tbb::parallel_for(0, grid_.count[2], [&](int k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      const std::ptrdiff_t from = grid_.index(0, j, k);
      const std::size_t to = row_beside(0, 0, j, k);
      const double* p = pressure.data() + from;
      const double* e = void_fraction.data() + from;
      for (int i = 0; i < nx; ++i) {
        pressure_[to + static_cast<std::size_t>(i)] = static_cast<float>(p[i]);
        void_fraction_[to + static_cast<std::size_t>(i)] = static_cast<float>(e[i]);
      }
    }
  });
  publish_velocity(solver);
}

sdk::FluidColumns FluidTable::columns() const {
  sdk::FluidColumns c;
  c.origin = grid_.origin;
  c.spacing = grid_.spacing;
  for (int d = 0; d < 3; ++d) c.count[d] = grid_.count[d];
  c.density = density_;
  c.viscosity = viscosity_;
  c.velocity_x = velocity_[0];
  c.velocity_y = velocity_[1];
  c.velocity_z = velocity_[2];
  c.pressure = pressure_;
  c.void_fraction = void_fraction_;
  c.open_fraction = open_fraction_;
  return c;
}

}  // namespace dust::run
