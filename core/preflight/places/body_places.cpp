// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/body_places.hpp"

#include "base/text.hpp"
#include "bodies/survey/surface_in_box.hpp"
#include "fluid/grid.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dust::preflight {
namespace {

bool is_mesh(const scenario::BodySpec& body) { return body.shape.name == "mesh"; }

/// [m] Edges of the box round a mesh, in its own frame.
sdk::Vec3 extent_of_mesh(const bodies::Shape& mesh) {
  constexpr double k_far = std::numeric_limits<double>::max();
  sdk::Vec3 low{k_far, k_far, k_far}, high{-k_far, -k_far, -k_far};
  for (const sdk::Vec3& corner : mesh.triangles({}, {}, 0.0)) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], corner[d]);
      high[d] = std::max(high[d], corner[d]);
    }
  }
  return high - low;
}

/// What a mesh is smaller than: "the smallest grain (7 mm)"; "" where it is large enough.
std::string what_is_larger(double extent, double grain, double cell) {
  if (extent < grain) return "the smallest grain (" + base::length_text(grain) + ")";
  if (extent < cell) return "a cell of the fluid (" + base::length_text(cell) + ")";
  return "";
}

}  // namespace

void check_body_places(const scenario::Setup& setup, const ParticleModels& models,
                       scenario::Diagnostics& diagnostics) {
  const sdk::Vec3 middle = 0.5 * (setup.domain.min + setup.domain.max);
  const sdk::Vec3 half = 0.5 * (setup.domain.max - setup.domain.min);
  constexpr double k_finest = 4e-3;  // of half the domain's diagonal
  const double finest = k_finest * norm(half);
  for (std::size_t n = 0; n < models.bodies.size(); ++n) {
    const bodies::Body& body = models.bodies[n];
    const bool is_moved = std::any_of(body.motions.begin(), body.motions.end(),
                                      [](const auto& m) { return m->moves_body(); });
    if (is_moved) continue;
    const double distance = std::abs(body.nearest(middle).distance);
    if (bodies::may_meet_box(body, body.placement(0.0), middle, half, finest)) continue;
    diagnostics.warning(
        setup.bodies[n].shape.where,
        "bodies." + body.name +
            ": none of its surface is in the domain, the "
            "nearest of it " +
            base::length_text(distance) +
            " from the domain's middle: nothing "
            "meets it; " +
            (is_mesh(setup.bodies[n]) ? "is the unit of its file right (unit: 1 mm)?"
                                      : "are its place and size right?"));
  }
}

void check_mesh_sizes(const scenario::Setup& setup, const ParticleModels& models,
                      scenario::Diagnostics& diagnostics) {
  const double grain = models.class_diameters.empty() ? 0.0 : models.class_diameters.front();
  double cell = 0.0;
  if (setup.fluid) {
    const sdk::Vec3 h =
        fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
    cell = std::min({h.x, h.y, h.z});
  }
  for (std::size_t n = 0; n < models.bodies.size(); ++n) {
    const bodies::Body& body = models.bodies[n];
    if (!is_mesh(setup.bodies[n])) continue;
    const sdk::Vec3 extent = extent_of_mesh(*body.shape);
    const std::string larger =
        what_is_larger(std::max({extent.x, extent.y, extent.z}), grain, cell);
    if (larger.empty()) continue;
    diagnostics.warning(setup.bodies[n].shape.where,
                        "bodies." + body.name + ": the mesh measures " +
                            base::extent_text({extent.x, extent.y, extent.z}) + ", less than " +
                            larger + "; is it drawn in metres? Then give unit: 1 m");
  }
}

void check_removals(const scenario::Setup& setup, scenario::Diagnostics& diagnostics) {
  for (const scenario::BodySpec& body : setup.bodies) {
    if (!body.removal) continue;
    const bool is_by_energy = body.removal->kinetic_energy_per_grain > 0.0;
    const double earliest = is_by_energy ? body.removal->after : body.removal->at;
    if (earliest < setup.time.end) continue;
    diagnostics.warning(
        body.where, "bodies." + body.name + ".remove." + (is_by_energy ? "after" : "at") + ": " +
                        scenario::number_text(earliest) + " s is not before time.end, " +
                        scenario::number_text(setup.time.end) +
                        " s: the body stays for all of the run; give an earlier time or a later "
                        "end");
  }
}

}  // namespace dust::preflight
