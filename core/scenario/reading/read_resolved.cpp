// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dust::scenario {
namespace {

/// To three decimals, for messages; `length` [m].
double rounded_mm(double length) { return std::round(1e6 * length) / 1e3; }

/// Below this the delta function of the markers, three cells wide, is no longer thin.
constexpr double k_min_cells_per_diameter = 8.0;
/// Fluid over grain density from which on the force of a step, which follows the velocity of the
/// step before, would drive the sphere to and fro: docs/theory/resolved.md, section 4.
constexpr double k_lightest = 0.8;
/// viscosity x step / (density cell^2) that is allowed: a sphere beside a wall is driven to and fro
/// with longer steps, from twice as long ones on until the run diverges: docs/theory/resolved.md,
/// section 5.
constexpr double k_longest_way = 1.0;
/// Edges of cells over each other up to which drag is that in cubes within a per cent.
constexpr double k_nearly_cubes = 1.2;

std::vector<int> materials_of(const EmitterSpec& emitter) {
  std::vector<int> all = emitter.more_materials;
  if (all.empty()) all.push_back(emitter.material);
  return all;
}

/// Of the edges of a cell [m].
struct Edges {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;
};
Edges edges_of(const Reading& reading, const FluidSpec& fluid) {
  Edges edges;
  for (int d = 0; d < 3; ++d) {
    const double width = reading.setup.domain.max[d] - reading.setup.domain.min[d];
    const double edge = width / fluid.cells[static_cast<std::size_t>(d)];
    edges.shortest = std::min(edges.shortest, edge);
    edges.longest = std::max(edges.longest, edge);
  }
  return edges;
}

/// The viscous way of a step, in cells squared.
void check_step(Reading& reading, const FluidSpec& fluid, double finest) {
  const double per_second = fluid.viscosity / (fluid.density * finest * finest);
  const double ratio = per_second * reading.setup.time.fluid_step;
  if (!(ratio > (1.0 + 1e-9) * k_longest_way)) return;
  // [ms], three digits, downward.
  const double longest = 1e3 * k_longest_way / per_second;
  const double digits = std::pow(10.0, 2.0 - std::floor(std::log10(longest)));
  reading.error(
      fluid.resolved_where,
      "coupling.resolved: viscosity x time.fluid_step / (density x cell^2) is " +
          number_text(std::round(100 * ratio) / 100) + "; above " + number_text(k_longest_way) +
          " a sphere beside a wall and the fluid drive each other to and fro until the run "
          "diverges: take a time.fluid_step of at most " +
          number_text(std::floor(longest * digits * (1.0 + 1e-9)) / digits) + " ms");
}

}  // namespace

bool is_resolved(const Reading& reading, const EmitterSpec& emitter) {
  const std::vector<int> all = materials_of(emitter);
  return reading.setup.fluid && std::any_of(all.begin(), all.end(), [&](int material) {
           return reading.setup.fluid->resolves(material);
         });
}

void read_resolved(Reading& reading, const CouplingBlock& coupling, const Entry* entry) {
  if (coupling.resolved.empty()) return;
  const Mark where = mark_of(entry->value, "resolved");
  if (!reading.setup.fluid) {
    if (!reading.has_fluid) {
      reading.error(
          where,
          "coupling.resolved: spheres are resolved by the grid of a fluid, and fluid is none: "
          "declare a fluid, or leave resolved out");
    }
    return;
  }
  FluidSpec& fluid = *reading.setup.fluid;
  fluid.resolved_where = where;
  for (const std::string& name : coupling.resolved) {
    fluid.resolved.push_back(reading.names.materials.index(name));
  }
  const auto refuse = [&](bool is_there, const char* what) {
    if (!is_there) return;
    reading.error(where, std::string("coupling.resolved: does not go with ") + what +
                             ": leave one of both out");
  };
  refuse(coupling.one_way, "coupling.one_way, where the fluid does not feel the grains");
  refuse(coupling.overlap, "coupling.overlap, where grains see the fluid of the step before");
  refuse(!fluid.regions.empty(), "fluid.regions: the markers know one density");
  refuse(fluid.momentum_set == "III", "fluid.momentum_set III");
}

namespace {

void check_cells(Reading& reading, const FluidSpec& fluid, const Edges& edges) {
  if (edges.longest <= k_nearly_cubes * edges.shortest) return;
  reading.diagnostics.warning(
      fluid.resolved_where,
      "coupling.resolved: cells are " +
          number_text(std::round(100.0 * edges.longest / edges.shortest) / 100.0) +
          " times as long as wide: the drag of a resolved sphere depends "
          "on its direction by some "
          "per cent then (docs/theory/resolved.md, section 5); take cubes");
}

}  // namespace

/// Sizes and densities of the grains that are to be resolved.
void check_resolved(Reading& reading) {
  if (!reading.setup.fluid || reading.setup.fluid->resolved.empty() ||
      reading.diagnostics.has_errors())
    return;
  const FluidSpec& fluid = *reading.setup.fluid;
  const Edges edges = edges_of(reading, fluid);
  check_step(reading, fluid, edges.shortest);
  check_cells(reading, fluid, edges);
  const double spacing = edges.longest;
  for (const int material : fluid.resolved) {
    const MaterialSpec& m = reading.setup.materials[static_cast<std::size_t>(material)];
    if (m.coarse_graining != 1.0) {
      reading.error(fluid.resolved_where,
                    "coupling.resolved: grains of '" + m.name +
                        "' stand for smaller ones (coarse_graining); a resolved "
                        "sphere is itself: leave one of both out");
    }
    if (m.properties.density < k_lightest * fluid.density) {
      reading.error(
          fluid.resolved_where,
          "coupling.resolved: '" + m.name + "' has " +
              number_text(m.properties.density / fluid.density) +
              " of the fluid's density; below " + number_text(k_lightest) +
              " the sphere and the fluid that it displaces would drive each other to and fro: take "
              "the material out of resolved");
    }
  }
  for (std::size_t n = 0; n < reading.emitters.size(); ++n) {
    const EmitterSpec& emitter = reading.setup.emitters[n];
    if (!is_resolved(reading, emitter)) continue;
    const std::vector<int> all = materials_of(emitter);
    if (!std::all_of(all.begin(), all.end(), [&](int m) { return fluid.resolves(m); })) {
      reading.error(emitter.model.where,
                    emitter.model.path +
                        ": gives grains of materials that are resolved and of others: "
                        "use an emitter for each");
    }
    for (const double d : static_cast<const sdk::Emitter&>(*reading.emitters[n]).diameters()) {
      if (d >= (k_min_cells_per_diameter - 1e-9) * spacing) continue;
      reading.error(fluid.resolved_where,
                    "coupling.resolved: grains of " + number_text(rounded_mm(d)) + " mm from " +
                        emitter.name + " are " + number_text(std::round(100 * d / spacing) / 100) +
                        " cells across, and " + number_text(k_min_cells_per_diameter) +
                        " are the fewest: cells of at most " +
                        number_text(rounded_mm(d / k_min_cells_per_diameter)) +
                        " mm are needed, or take the material out of resolved");
      break;
    }
  }
}

}  // namespace dust::scenario
