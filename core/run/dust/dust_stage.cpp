// SPDX-License-Identifier: Apache-2.0
#include "run/dust/dust_stage.hpp"

#include "dust/sdk/sampling.hpp"
#include "fluid/cells_beside.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::run {
namespace {

using fluid::for_rows;
using fluid::Grid;

std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace

bool has_running_surfaces(const scenario::Setup& setup) {
  return std::any_of(setup.bodies.begin(), setup.bodies.end(),
                     [](const scenario::BodySpec& body) { return !body.motions.empty(); });
}

DustStage::DustStage(const scenario::Setup& setup, const scenario::DustFieldSpec& spec,
                     const Models& models, FluidStage& fluid,
                     std::vector<particles::Opening> openings)
    : setup_(setup),
      models_(models),
      fluid_(fluid),
      openings_(std::move(openings)),
      sides_(setup, models, fluid.grid(), openings_),
      flow_(fluid.grid()),
      walls_(setup, models, fluid, sides_, spec.resuspension || spec.has_smooth_walls),
      field_(fluid.grid(), spec, {setup.fluid->density, setup.fluid->viscosity}, setup.gravity,
             {openings_.size(), 6 + setup.bodies.size(), has_running_surfaces(setup)}),
      weight_(fluid.grid(), setup.gravity, spec.density, setup.fluid->density),
      table_(fluid.grid(), spec.diameters, spec.density) {
  for (const double d : spec.diameters) names_.push_back(sdk::name_of(d * 1e6) + "_um");
  if (spec.scavenging) scavenging_.emplace(setup, fluid.grid().size);
  if (spec.has_smooth_walls) {
    flow_.smooth_wall_viscosity = setup.fluid->viscosity / setup.fluid->density;
  }
  flow_.side_outlet = sides_.outlets();
}

std::vector<std::string> DustStage::surface_names() const {
  std::vector<std::string> names(scenario::k_side_names.begin(), scenario::k_side_names.end());
  for (const scenario::BodySpec& body : setup_.bodies) names.push_back(body.name);
  return names;
}

/// Open share times void fraction.
void DustStage::find_volume(fluid::CellField& volume) const {
  const Grid& grid = fluid_.grid();
  const fluid::CellField& open = fluid_.solver().open_fraction();
  const fluid::CellField& eps = fluid_.void_fraction();
  for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid.index(0, j, k);
    for (int i = 0; i < grid.count[0]; ++i) volume[at(o + i)] = open[at(o + i)] * eps[at(o + i)];
  });
}

void DustStage::find_passage() {
  const Grid& grid = fluid_.grid();
  const fluid::FaceField& open = walls_.passable_area();
  const fluid::CellField& eps = fluid_.void_fraction();
  for (std::size_t d = 0; d < 3; ++d) {
    std::array<int, 3> n = grid.count;
    n[d] += 1;
    const auto is_wall_face = [&](const std::array<int, 3>& cell, int along) {
      if (grid.is_periodic[d]) return false;
      return (along == 0 && sides_.settles_on(2 * d, cell)) ||
             (along == grid.count[d] && sides_.settles_on(2 * d + 1, cell));
    };
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 3> place{i, j, k};
        const int along = place[d];
        const fluid::CellsBeside cells = fluid::cells_beside(grid, d, along);
        const double below = eps[at(o + i + cells.below)];
        const double above = eps[at(o + i + cells.above)];
        flow_.passage.component[d][at(o + i)] =
            is_wall_face(place, along) ? 0.0 : open.component[d][at(o + i)] * 0.5 * (below + above);
      }
    });
  }
}

void DustStage::find_outflows() {
  flow_.sinks.clear();
  fluid_.solver().each_sink([&](std::int32_t cell, double rate, std::int32_t body) {
    for (std::size_t o = 0; o < openings_.size(); ++o) {
      if (openings_[o].side < 0 &&
          openings_[o].name == setup_.bodies[static_cast<std::size_t>(body)].name) {
        flow_.sinks.push_back({cell, rate, static_cast<int>(o)});
      }
    }
  });
}

void DustStage::start() {
  find_volume(flow_.volume_after);
  field_.start(flow_.volume_after);
}

void DustStage::adapt_to_bodies() {
  find_volume(flow_.volume_after);
  field_.leave_covered_cells(flow_.volume_after);
}

void DustStage::advance(double time) {
  const Grid& grid = fluid_.grid();
  flow_.volume_before.swap(flow_.volume_after);
  find_volume(flow_.volume_after);
  fluid_.solver().find_throughflow(flow_.throughflow);
  if (must_find_walls_ || fluid_.solver().has_moving_bodies()) {
    walls_.find(time + setup_.time.fluid_step, must_find_walls_, flow_);
    must_find_walls_ = false;
    flow_.walls_found += 1;
  }
  flow_.void_fraction = fluid_.void_fraction();
  find_passage();
  find_outflows();
  walls_.fill(time + 0.5 * setup_.time.fluid_step, flow_);
  if (const fluid::CellField* eddies = fluid_.solver().eddy_viscosity()) {
    flow_.eddy_diffusivity.resize(grid.size);
    for (std::size_t n = 0; n < grid.size; ++n) {
      flow_.eddy_diffusivity[n] = (*eddies)[n] / setup_.fluid->density;
    }
  }
  field_.advance(flow_, time, setup_.time.fluid_step);
}

double DustStage::void_fraction_at(sdk::Vec3 place) const {
  const sdk::Vec3 there = inside(fluid_.solver().thin_bodies().on_own_side(place));
  const auto [i, j, k] = fluid_.grid().cell_at(there);
  return fluid_.void_fraction()[static_cast<std::size_t>(fluid_.grid().index(i, j, k))];
}

void DustStage::scavenge(particles::Dem& particles) {
  scavenging_->advance(setup_.time.fluid_step, *this, particles);
}

sdk::Vec3 DustStage::gas_velocity(std::int32_t cell) const {
  const fluid::FaceField& u = fluid_.solver().velocity();
  const auto low = static_cast<std::size_t>(cell);
  sdk::Vec3 mean;
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& faces = u.component[static_cast<std::size_t>(d)];
    const std::ptrdiff_t high = cell + fluid_.grid().stride[static_cast<std::size_t>(d)];
    mean[d] = 0.5 * (faces[low] + faces[at(high)]);
  }
  return mean;
}

double DustStage::gas_volume(std::int32_t cell) const {
  return flow_.volume_after[static_cast<std::size_t>(cell)] * fluid_.grid().cell_volume();
}

std::int32_t DustStage::cell_with_gas(sdk::Vec3 place) const {
  constexpr int k_reach = 2;  // cells
  const Grid& grid = fluid_.grid();
  place = fluid_.solver().thin_bodies().on_own_side(place);
  const std::array<int, 3> at = grid.cell_at(inside(place));
  const std::ptrdiff_t own = grid.index(at[0], at[1], at[2]);
  if (flow_.volume_after[static_cast<std::size_t>(own)] > 0.0) {
    return static_cast<std::int32_t>(own);
  }
  std::int32_t best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = at[2] - k_reach; k <= at[2] + k_reach; ++k) {
    for (int j = at[1] - k_reach; j <= at[1] + k_reach; ++j) {
      for (int i = at[0] - k_reach; i <= at[0] + k_reach; ++i) {
        std::array<int, 3> inside{i, j, k};
        bool is_there = true;
        for (std::size_t d = 0; d < 3; ++d) {
          const int n = grid.count[d];
          if (grid.is_periodic[d]) inside[d] = (inside[d] % n + n) % n;
          is_there = is_there && inside[d] >= 0 && inside[d] < n;
        }
        if (!is_there) continue;
        const std::ptrdiff_t cell = grid.index(inside[0], inside[1], inside[2]);
        const double distance = norm(grid.centre(i, j, k) - place);
        if (!(flow_.volume_after[static_cast<std::size_t>(cell)] > 0.0) || distance >= nearest) {
          continue;
        }
        nearest = distance;
        best = static_cast<std::int32_t>(cell);
      }
    }
  }
  return best;
}

io::SensorField DustStage::cell_field(const std::string& name, const char* unit,
                                      const fluid::CellField& values) const {
  const Grid& grid = fluid_.grid();
  io::SensorField field{"", name, unit, grid.shape(), {}};
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      const auto row = values.begin() + grid.index(0, j, k);
      field.values.insert(field.values.end(), row, row + grid.count[0]);
    }
  }
  return field;
}

std::vector<io::SensorField> DustStage::fields() const {
  std::vector<io::SensorField> fields;
  fluid::CellField concentration(fluid_.grid().size, 0.0);
  for (std::size_t n = 0; n < names_.size(); ++n) {
    field_.concentration(n, flow_.volume_after, concentration);
    fields.push_back(cell_field("dust_" + names_[n], "kg/m3", concentration));
    fields.push_back(cell_field("dust_deposit_" + names_[n], "kg", field_.deposit(n)));
  }
  return fields;
}

void DustStage::add_parts(SaveParts& parts) const {
  parts.emplace_back("dust", [this](sdk::ArchiveWriter& a) {
    field_.save(a);
    a.numbers("volume", flow_.volume_after);
  });
}

void DustStage::add_parts(LoadParts& parts) {
  parts.emplace_back("dust", [this](sdk::ArchiveReader& a) {
    field_.load(a);
    flow_.volume_after = a.numbers("volume");
  });
}

}  // namespace dust::run
