// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace dust::coupling {

/// Closed forms for what a single grain does to the fluid it is coupled to, so that it can be taken
/// off again. Figures and limits: docs/theory/own_disturbance.md, eq. (1), (2), (3), (4), (5), (6).
namespace self_disturbance {

/// Share of the slip from which on what a grain makes by itself is taken off: below it the eight
/// faces next to the grain do, and cost less.
inline constexpr double k_worth = 0.01;

/// Knots of the smooth kernel lie as far apart as the grain is large, and at least so many cells:
/// the answer of the grid to it is then the same within 0.3 % anywhere in a cell.
inline constexpr double k_min_knots = 1.25;
/// Largest D/dx for which a grain has a smooth kernel: it has (4 D/dx)^3 faces per component.
inline constexpr double k_largest_ratio = 4.5;

/// Standard deviation [m] of the Gaussian that the staggered grid of cells `h` [m] answers like, if
/// a force is spread by cubic B-splines of knots `knots` [m] and the velocity is gathered by the
/// same: sigma = b (0.5835 - 0.0403 (h / b)^2), from the sum over the waves of an infinite grid,
/// within 0.3 % for b / h from 1.25 up. 1/sqrt(3) = 0.577 without a grid.
inline double kernel_width(double knots, double cell) {
  const double cells = cell / knots;
  return knots * (0.5835 - 0.0403 * cells * cells);
}

/// Velocity [m/s] at the place of a force of 1 N in slow steady flow, both through a Gaussian whose
/// pair has the standard deviation sqrt(2) sigma: \f$ G_0 = 1 / (6 \pi^{3/2} \mu \sigma) \f$.
inline double still_mobility(double width, double viscosity) {
  return 1.0 / (6.0 * std::numbers::pi * std::sqrt(std::numbers::pi) * viscosity * width);
}

/// The waves that flow is made of in three groups: sigma k of each and its share of G_0. Fitted to
/// the unsteady answer 1 - (1 + nu t / sigma^2)^(-1/2) within 0.024 for t from 0.01 to 1000
/// sigma^2/nu, to the steady answer of Oseen's flow within 1.1 % for w sigma / nu from 0 to 100,
/// and exact in the short run: sum of shares times (sigma k)^2 = 1/2.
inline constexpr std::size_t k_groups = 3;
inline constexpr std::array<double, k_groups> k_waves{0.0543, 0.3427, 1.1277};
inline constexpr std::array<double, k_groups> k_shares{0.1583, 0.4946, 0.3471};

/// What a wave holds of a steady force in a stream [-] over what it holds in fluid at rest, for
/// p = w / (nu k), mean over all directions with Oseen's flow:
/// \f$ \frac34 \int_{-1}^{1} \frac{1 - x^2}{1 + p^2 x^2} dx =
///   \frac{3}{2 p^2} \left( \frac{1 + p^2}{p} \arctan p - 1 \right) \f$.
inline double left_by_stream(double p) {
  constexpr double k_slow = 0.05;  // below, the series; next term 3 p^4 / 35
  if (p < k_slow) return 1.0 - 0.2 * p * p;
  return 1.5 / (p * p) * ((1.0 + p * p) * std::atan(p) / p - 1.0);
}

/// What the sides of the domain are to the flow that a grain makes.
enum class Side { open, wall, slip };
/// A side as a grain has it: `distance` y, `knots` b of the kernel far from sides and `cell` dx,
/// all across the side [m].
struct Beside {
  double distance;
  double knots;
  double cell;
};
/// Part of the way to a wall that counts near it [-], h of eq. (5): the kernel is as wide as the
/// way and does not reach beyond. 1 far away. Fitted to the discrete Stokes flow of the staggered
/// grid between two walls, which tools/validation/wall_mobility.py solves, for D/dx to 2.5.
inline double way_that_counts(const Beside& at, bool is_across) {
  const double reach = at.distance / at.knots;
  const double cells = at.cell / at.knots;
  if (is_across) return 1.0 - 1.3 * std::exp(-0.78 * reach) + 1.6 * cells * std::exp(-1.75 * reach);
  return 1.0 - 0.15 * std::exp(-0.55 * reach) - 0.5 * cells * std::exp(-1.4 * reach);
}
/// Factor [-] on a group of waves of wave number k for a force beside a side, along it or across:
/// \f$ 1 \mp e^{-c h k y} \f$, with c such that far away the flow is that of the image of a point
/// force (Lorentz 1896; Blake 1971, doi:10.1017/S0305004100049902: 9/16 and 9/8 of R/y, beside a
/// plane without friction -3/8 and 3/4), and on the side none or twice as much.
inline double beside_side(Side side, bool is_across, double k, const Beside& at) {
  if (side == Side::open) return 1.0;
  constexpr double k_along_wall = 32.0 / (9.0 * std::numbers::pi);
  constexpr double k_across_wall = 16.0 / (9.0 * std::numbers::pi);
  constexpr double k_along_slip = 16.0 / (3.0 * std::numbers::pi);
  constexpr double k_across_slip = 8.0 / (3.0 * std::numbers::pi);
  const double way = k * at.distance;
  if (side == Side::wall) {
    const double far = is_across ? k_across_wall : k_along_wall;
    return -std::expm1(-far * way_that_counts(at, is_across) * way);
  }
  return is_across ? -std::expm1(-k_across_slip * way) : 1.0 + std::exp(-k_along_slip * way);
}

/// Flow at a grain by its own force, group by group.
struct Response {
  std::array<double, k_groups> mobility;  ///< [s/kg] steady velocity per force
  std::array<double, k_groups> rate;      ///< [1/s] at which it gets there
  double stress = 1.0;  ///< [-] part of the force density that pressure and viscous stress balance
};
/// `width` sigma [m], `slip` [m/s] through the fluid.
inline Response response(double width, double viscosity, double density, double slip) {
  const double kinematic = viscosity / density;
  const double still = still_mobility(width, viscosity);
  Response r;
  double viscous = 0.0;
  for (std::size_t n = 0; n < k_groups; ++n) {
    const double k = k_waves[n] / width;
    const double left = left_by_stream(slip / (kinematic * k));
    r.mobility[n] = still * k_shares[n] * left;
    r.rate[n] = kinematic * k * k / left;
    viscous += 2.0 * k_shares[n] * k_waves[n] * k_waves[n] * left;
  }
  // A third of the force is along its waves and balanced by the pressure, whatever the stream.
  r.stress = (1.0 + 2.0 * viscous) / 3.0;
  return r;
}

/// Steady velocity [m/s] per force [N] that a grain coupled through the eight faces around it makes
/// at its place, on the mean over the places in a cubic cell of edge `cell` [m]: as a ball of
/// 0.7515 cells does in Oseen's flow, \f$ G = [5 \pi \mu a (1 + \frac{1}{3} \rho w a / \mu)]^{-1}
/// \f$. It is 30 % less in the middle of eight faces and twice as much on one of them.
inline double mobility_of_corners(double cell, double viscosity, double density, double slip) {
  const double radius = 0.7515 * cell;
  const double reynolds = density * slip * radius / viscosity;
  return 1.0 / (5.0 * std::numbers::pi * viscosity * radius * (1.0 + reynolds / 3.0));
}

/// The most that a grain of diameter D makes of the fluid in cells of edge dx over its slip [-], in
/// slow flow and as the mean over the places in a cell: 3 pi mu D times mobility_of_corners = 0.80
/// D/dx. Faster flow carries it away.
inline double most_of_slip(double diameter, double cell) {
  return 3.0 * std::numbers::pi * diameter * mobility_of_corners(cell, 1.0, 1.0, 0.0);
}

/// Whether what a grain of diameter D does by itself may be taken off in cells of the edges
/// `least` and, of a cube of their volume, `mean` [m]: a smooth kernel has room for it, and the
/// `part` of it that one real grain does [-] is above `worth`.
inline bool may_be_taken_off(double diameter, double mean, double least, double part,
                             double worth) {
  constexpr double k_rounding = 1e-9;  // of a ratio of two lengths
  return diameter <= k_largest_ratio * least * (1.0 + k_rounding) &&
         most_of_slip(diameter, mean) * part > worth;
}

/// How much more solids than the mean there are around a grain because it is there, over its own
/// volume [-]: 1 for a lone grain, nearly 0 in a packing, where a place that one grain leaves
/// another takes. The compressibility of hard spheres after Carnahan and Starling, J. Chem. Phys.
/// 51 (1969) 635, \f$ S = (1-\phi)^4 / [(1+2\phi)^2 + \phi^3 (\phi - 4)] \f$, `solids` phi of the
/// others [-].
inline double excess_of_one(double solids) {
  if (!(solids > 0.0)) return 1.0;
  const double left = (1.0 - solids) * (1.0 - solids);
  const double packing = 1.0 + 2.0 * solids;
  return left * left / (packing * packing + solids * solids * solids * (solids - 4.0));
}

}  // namespace self_disturbance
}  // namespace dust::coupling
