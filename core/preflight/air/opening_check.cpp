// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/opening_check.hpp"

#include "base/text.hpp"
#include "fluid/grid.hpp"
#include "preflight/air/side_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace dust::preflight {
namespace {

using scenario::Setup;
using sdk::Vec3;

/// [-] Of a cell: an opening narrower than that is hardly there.
constexpr double k_narrow = 1.5;
/// Cells across an opening that show how air comes to it.
constexpr double k_wanted = 4.0;

class Cells {
 public:
  Cells(const Setup& setup, scenario::Diagnostics& diagnostics)
      : setup_(setup),
        spacing_(
            fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing),
        diagnostics_(diagnostics) {}

  /// `across`: the axis that the opening is looked through along.
  void check(Vec3 min, Vec3 max, int across, const scenario::Mark& where,
             const std::string& path) const {
    int narrowest = -1;
    double ratio = k_narrow;
    for (int d = 0; d < 3; ++d) {
      if (d == across || setup_.fluid->cells[static_cast<std::size_t>(d)] == 1) continue;
      const double edge =
          std::min(max[d], setup_.domain.max[d]) - std::max(min[d], setup_.domain.min[d]);
      if (!(edge > 0.0) || edge / spacing_[d] >= ratio) continue;
      ratio = edge / spacing_[d];
      narrowest = d;
    }
    if (narrowest < 0) return;
    const double edge = ratio * spacing_[narrowest];
    diagnostics_.warning(
        where, path + ": the opening is " + base::length_text(edge, 3) + " wide along " +
                   "xyz"[narrowest] + ", and cells of the fluid are " +
                   base::length_text(spacing_[narrowest], 3) +
                   " there: the flow comes through whole cells, so that neither its speed in the "
                   "opening nor its reach is right; take cells of " +
                   base::length_text(edge / k_wanted, 2) + " (fluid.cells) or a smaller domain");
  }

 private:
  const Setup& setup_;
  Vec3 spacing_;  ///< [m]
  scenario::Diagnostics& diagnostics_;
};

/// The axis along which a box is thinnest.
int thinnest(Vec3 min, Vec3 max) {
  const Vec3 edges = max - min;
  int d = edges.y < edges.x ? 1 : 0;
  if (edges.z < edges[d]) d = 2;
  return d;
}

}  // namespace

void check_opening_cells(const Setup& setup, const std::vector<scenario::SideOpeningSpec>& openings,
                         scenario::Diagnostics& diagnostics) {
  if (!setup.fluid) return;
  const Cells cells(setup, diagnostics);
  for (const scenario::BodySpec& body : setup.bodies) {
    // A body that is turned has its opening along other axes than the grid.
    if (!body.suction || body.frame >= 0) continue;
    const auto& s = *body.suction;
    cells.check(s.min, s.max, thinnest(s.min, s.max), s.where, "bodies." + body.name + ".suction");
  }
  for (const scenario::SideOpeningSpec& opening : openings) {
    const auto n = static_cast<std::size_t>(opening.side);
    const scenario::SideSpec& side = setup.domain.sides[n];
    cells.check(opening.min, opening.max, opening.side / 2, side.air ? side.air->where : side.where,
                path_of_side(n) + ".air");
  }
}

}  // namespace dust::preflight
