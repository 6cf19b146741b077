// SPDX-License-Identifier: Apache-2.0
#include "run/run_checks.hpp"

#include "base/finite.hpp"
#include "base/text.hpp"
#include "dust/sdk/error.hpp"

#include <cmath>
#include <string>

namespace dust::run {
namespace {

/// Overlaps over the radius from which on contacts are not those of grains, and from which on the
/// centre of a grain is behind the surface that it lies on: it leaves on the other side.
constexpr double k_deep = 0.3;
constexpr double k_through = 1.0;

/// What lets grains overlap so far.
std::string causes(double expected_speed) {
  return "likely causes: a young_modulus or stiffness that is too low (engine check tells the "
         "overlap of an impact; is an MPa missing?), grains faster than time.expected_speed, " +
         base::digits_text(expected_speed, 3) +
         " m/s, grains that came in inside others or walls, or a nip that they were drawn into, "
         "such as "
         "that inside a belt at its pulley";
}

}  // namespace

void check_finite(const sdk::GrainColumns& c) {
  for (std::size_t n = 0; n < c.id.size(); ++n) {
    if (!base::is_finite({c.x[n], c.y[n], c.z[n]}) ||
        !base::is_finite({c.velocity_x[n], c.velocity_y[n], c.velocity_z[n]}) ||
        !base::is_finite(
            {c.angular_velocity_x[n], c.angular_velocity_y[n], c.angular_velocity_z[n]})) {
      throw sdk::ModelError("grain " + std::to_string(c.id[n]) +
                            " has a position or velocity that is not a number; likely causes: a "
                            "time step too long for the stiffness, or an overlap at entry");
    }
  }
}

std::string overlap_warning(const particles::DemReport& report, double expected_speed) {
  const auto times = [](double overlap) { return base::plain_text(overlap, 3); };
  if (report.largest_coarse_overlap > k_through) {
    return "grains went through each other or through walls: the largest overlap is " +
           times(report.largest_coarse_overlap) +
           " of the radius, and forces, flows and what left the domain are not to be trusted; " +
           causes(expected_speed);
  }
  if (report.largest_coarse_overlap > k_deep) {
    return "the largest overlap of grains is " + times(report.largest_coarse_overlap) +
           " of the radius, where contact laws hold for small ones (below 0.05); " +
           causes(expected_speed);
  }
  // Known of the method: docs/theory/grains.md, "Several rates".
  if (report.largest_fine_overlap > k_deep) {
    return "fine grains were crushed between coarse ones: the largest overlap is " +
           times(report.largest_fine_overlap) +
           " of their radius; the report tells what that does (time.rates: single has none of it)";
  }
  return {};
}

std::string energy_warning(const particles::EnergyBalance& balance) {
  constexpr double k_open = 0.1;
  const double error = balance.relative_error();
  if (std::abs(error) < k_open) return {};
  const std::string joules = base::plain_text(std::abs(balance.error()), 3) + " J, " +
                             base::plain_text(100.0 * std::abs(error), 3) +
                             " % of all that was turned over, ";
  return "the energy of the grains does not add up: " + joules +
         (error < 0.0 ? "came out of nothing" : "went without a trace") +
         "; likely causes: steps too long for the stiffness or the speeds (time.expected_speed), "
         "overlaps at entry, or grains caught in a round hole that is narrower than they are";
}

}  // namespace dust::run
