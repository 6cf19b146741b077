// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/layers.hpp"
#include "airborne/surface_routes.hpp"

#include <cstddef>
#include <vector>

namespace dust::airborne {

/// Carries what lies on surfaces along with them, first order and upwind from piece to piece:
///   dm/dt = sum_in r m_upstream - sum_out r m,   r = v_e l/A
/// with v_e the speed of the surface across the edge, l the edge's length, A the piece's area;
/// docs/theory/dust.md, section 7. Nothing is lost and no layer falls below zero, whatever the
/// step.
class SurfaceTransport {
 public:
  /// After the pieces of walls have been found anew: their rows, and where a surface has gone to
  /// other places what lies on it.
  void prepare(const fluid::Grid& grid, const Flow& flow, Layers& layers);
  /// Over `step` [s]. Adds what leaves the domain, by class and surface [kg].
  void advance(const Flow& flow, double step, Layers& layers,
               std::vector<std::vector<double>>& carried_out);

 private:
  void find_rates(const Flow& flow);
  [[nodiscard]] double largest_rate(const Flow& flow) const;
  void make_step(double step, std::size_t classes, const Flow& flow, Layers& layers,
                 std::vector<std::vector<double>>& carried_out);

  SurfaceRoutes routes_;
  double shortest_ = 0.0;      ///< [m] edge of a cell
  std::vector<double> rate_;   ///< [1/s] by edge
  std::vector<double> whole_;  ///< [1/s] by piece of the routes
  std::vector<double> before_;
};

}  // namespace dust::airborne
