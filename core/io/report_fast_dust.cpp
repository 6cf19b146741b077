// SPDX-License-Identifier: Apache-2.0
#include "io/report_fast_dust.hpp"

#include "io/report_pictures.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>

namespace dust::io {

namespace {

/// Dust may be as fast as what carries it; beyond that it was thrown.
constexpr double k_room = 1.2;
/// Speed of a fine grain set free by the elastic energy of coarse ones of the softness that such
/// runs are made with [m/s]: the order of magnitude that core/particles/dem_step.cpp tells of.
constexpr double k_thrown = 10.0;

}  // namespace

FastDust fast_dust_of(const H5Source& source, double air_speed) {
  FastDust found;
  std::vector<double> dust;
  double carried = air_speed;
  for (const std::string& name : source.frames("/particles")) {
    const std::string path = "/particles/" + name;
    const auto velocity = source.floats(path + "/velocity");
    const auto diameter = source.floats(path + "/diameter");
    for (std::size_t k = 0; 3 * k + 2 < velocity.size() && k < diameter.size(); ++k) {
      const double speed = std::hypot(velocity[3 * k], velocity[3 * k + 1], velocity[3 * k + 2]);
      if (!std::isfinite(speed)) continue;
      if (diameter[k] < k_dust_diameter) {
        dust.push_back(speed);
      } else {
        carried = std::max(carried, speed);
      }
    }
  }
  found.limit = k_room * carried;
  found.all = dust.size();
  found.fast = static_cast<std::size_t>(
      std::count_if(dust.begin(), dust.end(), [&](double speed) { return speed > found.limit; }));
  return found;
}

std::string crushed_dust_html(double overlap, const FastDust& fast, double diameter, double density,
                              double viscosity) {
  std::string text =
      "<strong>What an overlap of " + number_html(overlap, 2) +
      " radii means.</strong> Coarse grains are softer here than real ones and sink into each "
      "other "
      "by microns when they collide. A fine grain that is caught between them finds no room: it is "
      "pressed in by more than contact laws hold for, and comes off with the elastic energy stored "
      "in it, at up to some " +
      number_html(k_thrown, 2) + "\u202fm/s.";
  if (diameter > 0.0 && density > 0.0 && viscosity > 0.0) {
    // v rho d^2 / (18 mu): Stokes' drag is the weakest, so the true path is shorter.
    const double path = k_thrown * density * diameter * diameter / (18.0 * viscosity);
    text += " Air stops grains of " + quantity_html(diameter, -1.0, "m") + " within " +
            quantity_html(path, -1.0, "m") + ".";
  }
  text +=
      " <strong>What it does to the dust figures:</strong> dust is loosened from between colliding "
      "grains more readily than from stiff ones, so amounts read high rather than low, and the "
      "place where it parts from the load is blurred by that distance. Dust that rides on a "
      "surface "
      "or hangs in the air is not touched.";
  if (fast.all > 0) {
    text += " In the frames of this run " + count_html(static_cast<double>(fast.fast)) + " of " +
            count_html(static_cast<double>(fast.all)) +
            " dust grains are faster than anything that carries them (" +
            number_html(fast.limit, 2) + "\u202fm/s).";
  }
  return text +
         " How far a figure depends on it is seen from a second run with ten times the "
         "<code>young_modulus</code> (its steps are a third as long) beside this one: <code>engine "
         "compare</code>.";
}

}  // namespace dust::io
