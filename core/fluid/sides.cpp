// SPDX-License-Identifier: Apache-2.0
#include "fluid/sides.hpp"

#include "dust/sdk/error.hpp"
#include "fluid/parallel.hpp"
#include "setup/setup.hpp"

#include <algorithm>
#include <string>

namespace dust::fluid {
namespace {

using sdk::SideRule;

constexpr int k_pressure = 3;  ///< "component" of the pressure in evaluate_at

/// Calls body(a, b, offset) for a padded plane across `direction`: offset is the index of the
/// plane's cell with 0 along `direction`; a, b count the other two directions, halos included.
/// The inner loop runs along x where it can. What is written for one (a, b) no other one reads.
template <class Body>
void for_plane(const Grid& g, int direction, const Body& body) {
  const int e = direction == 0 ? 1 : 0;
  const int f = direction == 2 ? 1 : 2;
  const int low = -Grid::k_halo;
  const int n_e = g.count[e] + 2 * Grid::k_halo;
  const int n_f = g.count[f] + 2 * Grid::k_halo;
  for_rows(n_e * 4, n_f, 1, [&](int q, int) {
    const int b = q + low;
    const std::ptrdiff_t o = g.index(0, 0, 0) + b * g.stride[f];
    if (e == 0) {
#pragma GCC ivdep
      for (int a = low; a < low + n_e; ++a) body(a, b, o + a);
    } else {
      for (int a = low; a < low + n_e; ++a) body(a, b, o + a * g.stride[e]);
    }
  });
}

void check(const sdk::SideRules& r, int side) {
  if (sdk::can_be_solved(r)) return;
  throw sdk::ParameterError(
      std::string("the boundary model of side ") + scenario::k_side_names[side] +
      " asks for a combination that cannot be solved: a given normal velocity goes with a zero "
      "pressure gradient, a given pressure with a zero velocity gradient");
}

}  // namespace

Sides::Sides(const Grid& grid, const std::array<const sdk::BoundaryCondition*, 6>& conditions)
    : grid_(grid) {
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2;
    values_[side].condition = conditions[side];
    if (conditions[side] == nullptr) {
      if (!grid.is_periodic[d]) {
        throw sdk::ParameterError(std::string("side ") + scenario::k_side_names[side] +
                                  " has no boundary model and is not periodic");
      }
      kinds_.is_periodic[d] = true;
      kinds_.rules[side] = {SideRule::periodic, SideRule::periodic, SideRule::periodic};
      continue;
    }
    if (grid.is_periodic[d]) {
      throw sdk::ParameterError(std::string("side ") + scenario::k_side_names[side] +
                                " is periodic and has a boundary model; it can have only one");
    }
    kinds_.rules[side] = conditions[side]->rules();
    values_[side].needs_flow = conditions[side]->needs_flow();
    check(kinds_.rules[side], side);
    const auto& r = kinds_.rules[side];
    for (int c = 0; c < 3; ++c) {
      const auto rule = c == d ? r.normal_velocity : r.tangential_velocity;
      if (rule == SideRule::fixed) set_places(side, c);
    }
    if (r.pressure != SideRule::gradient) set_places(side, k_pressure);
  }
  for (int d = 0; d < 3; ++d) is_idle_[d] = find_idle(d);
}

bool Sides::is_any_periodic() const {
  return kinds_.is_periodic[0] || kinds_.is_periodic[1] || kinds_.is_periodic[2];
}

std::array<int, 2> Sides::plane_size(int side, int component) const {
  const int d = side / 2;
  const int e = d == 0 ? 1 : 0;
  const int f = d == 2 ? 1 : 2;
  return {grid_.count[e] + (component == e ? 1 : 0), grid_.count[f] + (component == f ? 1 : 0)};
}

void Sides::set_places(int side, int component) {
  const int d = side / 2;
  const int e = d == 0 ? 1 : 0;
  const int f = d == 2 ? 1 : 2;
  const auto size = plane_size(side, component);
  const std::size_t count = static_cast<std::size_t>(size[0]) * size[1];
  Values& v = values_[side];
  auto& place = v.place[component];
  for (auto& p : place) p.resize(count);
  (component == k_pressure ? v.pressure : v.velocity[component]).assign(count, 0.0);
  for (auto& u : v.unused) u.resize(std::max(u.size(), count));
  for (int b = 0; b < size[1]; ++b) {
    for (int a = 0; a < size[0]; ++a) {
      const std::size_t n = static_cast<std::size_t>(b) * size[0] + a;
      place[d][n] = grid_.origin[d] + (side % 2 ? grid_.count[d] * grid_.spacing[d] : 0.0);
      place[e][n] = grid_.origin[e] + (a + (component == e ? 0.0 : 0.5)) * grid_.spacing[e];
      place[f][n] = grid_.origin[f] + (b + (component == f ? 0.0 : 0.5)) * grid_.spacing[f];
    }
  }
}

void Sides::set_flow_data(const FaceField& open_area, const Properties& properties) {
  for (int side = 0; side < 6; ++side) {
    Values& v = values_[side];
    if (!v.needs_flow) continue;
    const int d = side / 2;
    const int e = d == 0 ? 1 : 0;
    const int f = d == 2 ? 1 : 2;
    const auto size = plane_size(side, d);
    const std::ptrdiff_t first =
        grid_.index(0, 0, 0) + (side % 2 ? grid_.count[d] * grid_.stride[d] : 0);
    v.area.clear();
    v.density.clear();
    for (int b = 0; b < size[1]; ++b) {
      for (int a = 0; a < size[0]; ++a) {
        v.area.push_back(grid_.spacing[e] * grid_.spacing[f] *
                         open_area.component[d][first + a * grid_.stride[e] + b * grid_.stride[f]]);
        std::array<int, 3> cell{};
        cell[d] = side % 2 ? grid_.count[d] - 1 : 0;
        cell[e] = a;
        cell[f] = b;
        v.density.push_back(properties.at(grid_.centre(cell[0], cell[1], cell[2])).density);
      }
    }
  }
}

/// Void fractions in the cells inside the side; points between two cells take the upper one's.
void Sides::read_void_fraction(int side, int component, const CellField& eps) {
  const int d = side / 2;
  const int e = d == 0 ? 1 : 0;
  const int f = d == 2 ? 1 : 2;
  const auto size = plane_size(side, component);
  const std::ptrdiff_t first =
      grid_.index(0, 0, 0) + (side % 2 ? (grid_.count[d] - 1) * grid_.stride[d] : 0);
  auto& out = values_[side].void_fraction;
  out.clear();
  for (int b = 0; b < size[1]; ++b) {
    for (int a = 0; a < size[0]; ++a) {
      out.push_back(eps[first + std::min(a, grid_.count[e] - 1) * grid_.stride[e] +
                        std::min(b, grid_.count[f] - 1) * grid_.stride[f]]);
    }
  }
}

void Sides::evaluate_at(int side, int component, double time, const CellField* eps) {
  Values& v = values_[side];
  const auto& place = v.place[component];
  if (place[0].empty()) return;
  sdk::SideBatch batch;
  batch.count = place[0].size();
  batch.time = time;
  batch.normal[side / 2] = side % 2 ? 1.0 : -1.0;
  batch.position.x = place[0].data();
  batch.position.y = place[1].data();
  batch.position.z = place[2].data();
  batch.velocity.x = v.unused[0].data();
  batch.velocity.y = v.unused[1].data();
  batch.velocity.z = v.unused[2].data();
  batch.pressure = v.unused[0].data();
  if (component == 0) batch.velocity.x = v.velocity[0].data();
  if (component == 1) batch.velocity.y = v.velocity[1].data();
  if (component == 2) batch.velocity.z = v.velocity[2].data();
  if (component == k_pressure) batch.pressure = v.pressure.data();
  const int d = side / 2;
  batch.low = grid_.origin;
  batch.spacing = grid_.spacing;
  for (int e = 0; e < 3; ++e) batch.high[e] = grid_.origin[e] + grid_.count[e] * grid_.spacing[e];
  (side % 2 ? batch.low : batch.high)[d] = side % 2 ? batch.high[d] : batch.low[d];
  if (v.needs_flow && eps != nullptr) {
    read_void_fraction(side, component, *eps);
    batch.void_fraction = v.void_fraction.data();
    if (component == d) {
      batch.density = v.density.data();
      batch.area = v.area.data();
    }
  }
  v.condition->evaluate(batch);
}

void Sides::evaluate_velocity(double time, const CellField& eps) {
  for (int side = 0; side < 6; ++side) {
    for (int c = 0; c < 3; ++c) evaluate_at(side, c, time, &eps);
  }
  had_inflow_ = has_inflow_;
  for (int d = 0; d < 3; ++d) {
    if (!is_idle_[d]) continue;
    has_inflow_[d] = false;
    for (int side = 2 * d; side < 2 * d + 2; ++side) {
      for (const double v : values_[side].velocity[d]) has_inflow_[d] = has_inflow_[d] || v != 0.0;
    }
  }
}

void Sides::evaluate_pressure(double time) {
  for (int side = 0; side < 6; ++side) evaluate_at(side, k_pressure, time, nullptr);
}

bool Sides::Inflow::is_empty() const {
  return std::all_of(velocity.begin(), velocity.end(), [](const auto& v) { return v.empty(); });
}

Sides::Inflow Sides::mean_inflow(Interval over, const CellField& eps) {
  Inflow mean;
  mean.passes_idle = has_inflow_;
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2;
    std::vector<double>& given = values_[side].velocity[d];
    if (given.empty()) continue;
    const std::vector<double> present = given;
    const auto varying = time_mean(over, [&](double time) {
      evaluate_at(side, d, time, &eps);
      return given;
    });
    given = present;
    if (!varying) continue;
    mean.velocity[side] = *varying;
    mean.passes_idle[d] = true;
  }
  return mean;
}

void Sides::swap_inflow(Inflow& other) {
  for (int side = 0; side < 6; ++side) {
    if (!other.velocity[side].empty()) values_[side].velocity[side / 2].swap(other.velocity[side]);
  }
  has_inflow_.swap(other.passes_idle);
}

namespace {

/// Where numbers along a side stand, from one on its first face.
struct AlongSide {
  std::ptrdiff_t edge = 0, second = 0;  ///< first and second inside
  std::ptrdiff_t out = 0;               ///< from one to the next, outwards
};

/// A velocity along a side beyond it: mirrored about what the side gives; for sweeps that itself.
void continue_along(double* at, double given, const AlongSide& place, bool for_sweeps) {
  const auto& [edge, second, out] = place;
  at[edge + out] = for_sweeps ? given : 2.0 * given - at[edge];
  if (!for_sweeps) at[edge + 2 * out] = 2.0 * given - at[second];
}

}  // namespace

void Sides::fill_component(std::vector<double>& v, int d, int direction, bool for_sweeps) const {
  const std::ptrdiff_t s = grid_.stride[direction];
  const int n = grid_.count[direction];
  if (kinds_.is_periodic[direction]) {
    const std::ptrdiff_t last = (n - 1) * s;
    const std::ptrdiff_t second = n > 1 ? s : 0;
    for_plane(grid_, direction, [p = v.data(), s, last, second](int, int, std::ptrdiff_t o) {
      p[o - s] = p[o + last];
      p[o - 2 * s] = p[o + last - second];
      p[o + last + s] = p[o];
      p[o + last + 2 * s] = p[o + second];
    });
    return;
  }
  for (int high = 0; high < 2; ++high) {
    const int side = 2 * direction + high;
    const auto size = plane_size(side, d);
    const GhostRule ghost_rule = dust::fluid::ghost_rule(kinds_, d, direction, high);
    const std::ptrdiff_t out = high ? s : -s;
    // First number outside for tangential components, the side's own face for the normal one.
    const std::ptrdiff_t edge = d == direction ? (high ? n * s : 0) : (high ? (n - 1) * s : 0);
    const std::ptrdiff_t second = n > 1 || d == direction ? edge - out : edge;
    const std::ptrdiff_t third = n > 1 ? edge - 2 * out : second;
    // In y and z the halo has no room for a second face beyond the last one.
    const std::ptrdiff_t further = d == direction && high && d != 0 ? edge + out : edge + 2 * out;
    if (ghost_rule == GhostRule::gradient) {
      const std::ptrdiff_t mirrored = d == direction ? edge : second;
      for_plane(grid_, direction,
                [p = v.data(), edge, out, further, mirrored](int, int, std::ptrdiff_t o) {
                  p[o + further] = p[o + mirrored];
                  p[o + edge + out] = p[o + edge];
                });
      continue;
    }
    const auto& given = values_[side].velocity[d];
    for_plane(grid_, direction, [&](int a, int b, std::ptrdiff_t o) {
      double* at = &v[o];
      const int p = std::clamp(a, 0, size[0] - 1);
      const int q = std::clamp(b, 0, size[1] - 1);
      const double wall = given[static_cast<std::size_t>(q) * size[0] + p];
      if (d == direction) {
        at[edge] = wall;
        at[further] = 2.0 * wall - at[third];
        at[edge + out] = 2.0 * wall - at[second];
      } else {
        continue_along(at, wall, {edge, second, out}, for_sweeps);
      }
    });
  }
}

/// Beyond a side that gives the velocity along itself, the velocity that the side beside it gives
/// on its own faces is mirrored like that of the faces next to them. Sides are filled axis by axis:
/// where the side beside it comes later it has overwritten these numbers.
void Sides::fill_corners(FaceField& u, bool for_sweeps) const {
  for (int side = 0; side < 6; ++side) {
    const int direction = side / 2;
    if (kinds_.is_periodic[direction]) continue;
    for (int d = direction + 1; d < 3; ++d) {
      if (kinds_.is_periodic[d] || ghost_rule(kinds_, d, direction, side % 2) != GhostRule::fixed) {
        continue;
      }
      for (int high = 0; high < 2; ++high) {
        if (!is_pressure_side(kinds_, d, high))
          fill_corner(u.component[d], side, d, high, for_sweeps);
      }
    }
  }
}

void Sides::fill_corner(std::vector<double>& v, int side, int d, int high, bool for_sweeps) const {
  const int direction = side / 2;
  const int along = 3 - d - direction;
  const auto size = plane_size(side, d);
  const int face = high ? grid_.count[d] : 0;
  const std::ptrdiff_t s = grid_.stride[direction];
  const std::ptrdiff_t out = side % 2 ? s : -s;
  const std::ptrdiff_t edge = side % 2 ? (grid_.count[direction] - 1) * s : 0;
  const std::ptrdiff_t second = grid_.count[direction] > 1 ? edge - out : edge;
  const auto& given = values_[side].velocity[d];
  for (int n = -Grid::k_halo; n < grid_.count[along] + Grid::k_halo; ++n) {
    // As plane_size() has the axes of the side's plane: ascending.
    const int p = std::clamp(along < d ? n : face, 0, size[0] - 1);
    const int q = std::clamp(along < d ? face : n, 0, size[1] - 1);
    const double wall = given[static_cast<std::size_t>(q) * size[0] + p];
    double* at = &v[grid_.index(0, 0, 0) + n * grid_.stride[along] + face * grid_.stride[d]];
    continue_along(at, wall, {edge, second, out}, for_sweeps);
  }
}

void Sides::fill_velocity(FaceField& u) const {
  for (int direction = 0; direction < 3; ++direction) {
    for (int d = 0; d < 3; ++d) fill_component(u.component[d], d, direction, false);
  }
  fill_corners(u, false);
}

bool Sides::find_idle(int direction) const {
  if (grid_.count[direction] > 1 || kinds_.is_periodic[direction]) return false;
  for (int high = 0; high < 2; ++high) {
    if (is_pressure_side(kinds_, direction, high)) return false;
    if (ghost_rule(kinds_, (direction + 1) % 3, direction, high) != GhostRule::gradient)
      return false;
  }
  return true;
}

void Sides::fill_varying(FaceField& u) const {
  for (int direction = 0; direction < 3; ++direction) {
    for (int d = 0; d < 3; ++d) {
      if (d == direction ? !is_still(direction) : !is_idle(direction)) {
        fill_component(u.component[d], d, direction, false);
      }
    }
  }
  fill_corners(u, false);
}

void Sides::fill_for_sweeps(FaceField& u) const {
  for (int direction = 0; direction < 3; ++direction) {
    for (int d = 0; d < 3; ++d) {
      if (d == direction ? !is_still(direction) : !is_idle(direction)) {
        fill_component(u.component[d], d, direction, true);
      }
    }
  }
  fill_corners(u, true);
}

void Sides::wrap(std::vector<double>& component, int d) const {
  for (int direction = 0; direction < 3; ++direction) {
    if (kinds_.is_periodic[direction]) fill_component(component, d, direction, true);
  }
}

void Sides::fill_cells(CellField& values) const {
  for (int direction = 0; direction < 3; ++direction) {
    const std::ptrdiff_t s = grid_.stride[direction];
    const int n = grid_.count[direction];
    const std::ptrdiff_t last = (n - 1) * s;
    const std::ptrdiff_t inner = n > 1 ? s : 0;
    // What the first and the second cell beyond either end take.
    const bool is_periodic = kinds_.is_periodic[direction];
    const std::array<std::ptrdiff_t, 2> low{is_periodic ? last : 0, is_periodic ? last - inner : 0};
    const std::array<std::ptrdiff_t, 2> high{is_periodic ? 0 : last, is_periodic ? inner : last};
    for_plane(grid_, direction,
              [p = values.data(), s, last, low, high](int, int, std::ptrdiff_t o) {
                p[o - s] = p[o + low[0]];
                p[o - 2 * s] = p[o + low[1]];
                p[o + last + s] = p[o + high[0]];
                p[o + last + 2 * s] = p[o + high[1]];
              });
  }
}

void Sides::fill_pressure(CellField& p, bool is_increment) const {
  fill_cells(p);
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2;
    if (!is_pressure_side(kinds_, d, side % 2)) continue;
    const auto size = plane_size(side, k_pressure);
    const std::ptrdiff_t edge = side % 2 ? (grid_.count[d] - 1) * grid_.stride[d] : 0;
    const std::ptrdiff_t out = side % 2 ? grid_.stride[d] : -grid_.stride[d];
    for_plane(grid_, d, [&](int a, int b, std::ptrdiff_t o) {
      const int m = std::clamp(a, 0, size[0] - 1);
      const int q = std::clamp(b, 0, size[1] - 1);
      const double given =
          is_increment ? 0.0 : values_[side].pressure[static_cast<std::size_t>(q) * size[0] + m];
      p[o + edge + out] = 2.0 * given - p[o + edge];
    });
  }
}

}  // namespace dust::fluid
