// SPDX-License-Identifier: Apache-2.0
#include "new_scenario/new_scenario.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace dust::engine {
namespace {

constexpr double k_density = 2650.0;
constexpr double k_poisson = 0.3;
/// Solids in the opening of a feed; 0.35 is the most that can be placed.
constexpr double k_solids = 0.12;
/// Solids in a load that lies on a belt.
constexpr double k_load_solids = 0.55;

/// [m] as millimetres without a unit, rounded to a hundredth.
std::string mm(double metres) { return base::digits_text(std::round(1e5 * metres) / 100.0, 8); }

/// [s] The largest of 1, 0.5, 0.2 and 0.1 ms that is not above `limit`.
double round_step(double limit) {
  for (const double step : {1e-3, 5e-4, 2e-4}) {
    if (step <= limit) return step;
  }
  return 1e-4;
}

/// Throws base::UserError where sizes do not go together.
void require(bool do_fit, const std::string& problem) {
  if (!do_fit) throw base::UserError("engine new: error: " + problem);
}

std::string head_of(const FileNames& names, double end, double fluid_step, const char* what) {
  std::ostringstream out;
  out << "# " << what << "\n# Change what is yours, then: engine check " << names.file
      << "; engine run " << names.file << "\nname: " << names.scenario
      << "\ntime: {end: " << base::digits_text(end, 3)
      << " s, fluid_step: " << base::digits_text(1e3 * fluid_step, 3)
      << " ms, output_every: " << base::digits_text(20.0 * fluid_step * 1e3, 3)
      << " ms}\ngravity: [0, 0, -9.81]   # m/s2\n\n";
  return out.str();
}

/// [Pa] With which an impact at `speed` [m/s] of a grain on a wall of its own material makes them
/// overlap by `ratio` of its radius: Hertz, \f$ \delta / R = (5 \pi \rho v^2 / (4 E^*))^{2/5} \f$.
double modulus_of(double speed, double ratio) {
  const double effective =
      1.25 * std::numbers::pi * k_density * speed * speed / std::pow(ratio, 2.5);
  return 2.0 * (1.0 - k_poisson * k_poisson) * effective;
}

/// Materials for grains that fall by `height` [m] and come in with `speed` [m/s]: as soft as their
/// trajectories bear, and the file says what that means.
std::string materials_of(double height, double speed) {
  constexpr double k_min_modulus = 5e6;  // Pa
  constexpr double k_max_overlap = 0.2;  // of the radius; `engine check` warns from 0.3 on
  constexpr double k_small_overlap = 0.05;
  const double impact = std::hypot(speed, std::sqrt(2.0 * 9.81 * height));
  const double modulus =
      std::max(k_min_modulus, 1e6 * std::ceil(modulus_of(impact, k_max_overlap) / 1e6));
  const double stiff = modulus_of(impact, k_small_overlap);
  const double overlap = k_max_overlap * std::pow(modulus_of(impact, k_max_overlap) / modulus, 0.4);
  const auto digits = [](double value) { return base::plain_text(value, 2); };
  const std::string mega =
      digits(modulus / 1e6) + " MPa, poisson_ratio: " + digits(k_poisson) + "}\n";
  std::ostringstream out;
  out << "# Far softer than sand and steel, so that a run takes minutes: after a fall of "
      << mm(std::round(1e3 * height) / 1e3) << " mm grains\n# overlap by up to "
      << digits(100.0 * overlap)
      << " % of their radius, and `engine check` calls them soft. Paths and flows hardly\n# depend "
         "on it; how long contacts last, forces on walls and what impacts set free do.\n"
         "# For some 5 %: young_modulus: "
      << digits(std::ceil(stiff / 1e6)) << " MPa for both, with "
      << digits(std::pow(stiff / modulus, 0.4)) << " times as many steps.\n"
      << "materials:\n  sand: {density: 2650 kg/m3, young_modulus: " << mega
      << "  wall: {density: 7850 kg/m3, young_modulus: " << mega << "\n"
      << "interactions:\n"
         "  - between: [sand, sand]\n"
         "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.5}\n"
         "    rolling: {model: epsd2, friction: 0.2}\n"
         "  - {between: [sand, wall], like: [sand, sand]}\n\n";
  return out.str();
}

/// `load` [m]: how high it lies on the slice.
void check_slice(double width, double grain, double load) {
  constexpr double k_highest_load = 0.5;  // m
  require(grain <= 0.5 * width, "--grain " + base::length_text(grain) + " in a slice of --width " +
                                    base::length_text(width) +
                                    ": the slice has to be two grains wide; give a wider one");
  require(load <= k_highest_load,
          "--flow is that of the slice, " + base::length_text(width) +
              " wide: the load would lie " + base::length_text(load, 3) +
              " high on it; give the belt's flow times --width over the width of its load");
}

/// Sizes: speed, drop, flow, width, grain.
std::string write_transfer(const FileNames& names, const std::vector<double>& s) {
  const double speed = s[0];
  const double drop = s[1];
  const double flow = s[2];
  const double width = s[3];
  const double grain = s[4];
  const double margin = 0.1;
  // The feed stands clear of the load, which it gives the belt's speed: what slides first piles up.
  const double load = flow / (k_density * k_load_solids * speed * width);
  check_slice(width, grain, load);
  const double gap = 4.0 * grain + 1.5 * load;
  const double fall = 0.5;  // [m/s] of the feed
  const double inset = 0.25 * grain;
  const double length =
      std::max(3.0 * grain, flow / (k_density * k_solids * fall * (width - 2.0 * inset)));
  const double head = margin + length + 0.15;
  const double radius = 0.06;
  const double top = std::max(drop, 2.0 * radius) + 0.02;
  const double flight = speed * std::sqrt(2.0 * top / 9.81);
  const double x = head + flight + margin;
  const double z = top + gap + margin;
  const double cell = 2.5 * grain;
  const double end = 2.0 * (head / speed + std::sqrt(2.0 * top / 9.81));
  const double step = round_step(0.5 * grain / std::max(speed, 2.0));
  const auto cells = [cell](double extent) {
    return std::to_string(std::max(1, static_cast<int>(extent / cell)));
  };
  std::ostringstream out;
  out << head_of(names, std::max(end, 40.0 * step), step,
                 "A slice of a belt that hands over its load, and the air around it.")
      << "domain:\n  min: [0, 0, 0]\n  max: [" << mm(x) << ", " << mm(width) << ", " << mm(z)
      << " mm]\n  boundaries:           # x: left, right; y: front, back; z: bottom, top\n"
      << "    left: {grains: open, air: {model: total_pressure, pressure: 0 Pa}}\n"
      << "    right: {grains: open, air: {model: total_pressure, pressure: 0 Pa}}\n"
      << "    front: {grains: periodic, air: periodic}\n"
      << "    back: {grains: periodic, air: periodic}\n"
      << "    bottom: {grains: open, air: {model: no_slip}}\n"
      << "    top: {grains: open, air: {model: slip}}\n\n"
      << materials_of(gap + 0.5 * grain + radius, std::hypot(speed, fall))
      << "bodies:\n  belt:\n    shape: conveyor\n    material: wall\n    head: [" << mm(head)
      << ", 0, " << mm(top - radius) << " mm]\n    tail: [-1000, 0, " << mm(top - radius)
      << " mm]\n    radius: " << mm(radius)
      << " mm\n    motion: belt\n    speed: " << base::digits_text(speed, 6)
      << " m/s\n\nemitters:\n  feed:\n    model: feed\n    material: sand\n    mass_flow: "
      << base::digits_text(flow, 6) << " kg/s\n    min: [" << mm(margin) << ", " << mm(inset)
      << ", " << mm(top + gap) << " mm]\n    max: [" << mm(margin + length) << ", "
      << mm(width - inset) << ", " << mm(top + gap) << " mm]\n    velocity: ["
      << base::digits_text(speed, 6) << ", 0, -" << base::digits_text(fall, 3)
      << " m/s]\n    diameters: [" << mm(grain)
      << " mm]\n    number_fractions: [1]\n\nfluid: {cells: [" << cells(x) << ", " << cells(width)
      << ", " << cells(z) << "], density: 1.2 kg/m3, viscosity: 1.8e-5 Pa s, momentum_set: I}\n"
      << "drag: {model: gidaspow}\nvoidage: {model: divided}\n\nsensors:\n"
      << "  stream: {model: trajectory, from: [" << mm(head) << ", 0, " << mm(top)
      << " mm], drops: [" << mm(0.5 * drop)
      << " mm], steady_after: " << base::digits_text(0.6 * end, 3) << " s}\n";
  return out.str();
}

/// Sizes: outlet, diameter, mass, grain.
std::string write_hopper(const FileNames& names, const std::vector<double>& s) {
  const double hole = 0.5 * s[0];
  const double radius = 0.5 * s[1];
  const double mass = s[2];
  const double grain = s[3];
  require(s[0] + 2.0 * grain <= s[1], "--outlet " + base::length_text(s[0]) +
                                          " in a hopper of --diameter " + base::length_text(s[1]) +
                                          ": it has to be two grains wider; give a wider one");
  const double wall = std::max(1e-3, grain);
  const double loose = mass / (k_density * 0.25 * std::numbers::pi * radius * radius);
  const double height = loose + 4.0 * grain;
  const double below = 2.0 * s[0] + 0.02;
  const double side = radius + wall + 2.0 * grain;
  const double settled = 1.5 * std::sqrt(2.0 * height / 9.81);
  std::ostringstream out;
  out << head_of(names, settled + 1.0, 1e-3,
                 "A hopper with a level bottom: it is filled, and the outlet opens once the grains "
                 "lie.")
      << "domain:\n  min: [" << mm(-side) << ", " << mm(-side) << ", " << mm(-below)
      << " mm]\n  max: [" << mm(side) << ", " << mm(side) << ", " << mm(height)
      << " mm]\n  boundaries:\n";
  for (const char* boundary : {"left", "right", "front", "back", "bottom", "top"}) {
    out << "    " << boundary << ": {grains: open}\n";
  }
  out << '\n'
      << materials_of(height + wall, 0.0)
      << "bodies:\n  tube: {shape: cylinder, material: wall, base: [0, 0, " << mm(-wall)
      << " mm], axis: [0, 0, 1], length: " << mm(height + wall) << " mm, radius: " << mm(radius)
      << " mm, thickness: " << mm(wall)
      << " mm}\n  bottom: {shape: disc, material: wall, centre: [0, 0, " << mm(-wall)
      << " mm], axis: [0, 0, 1], radius: " << mm(radius + wall) << " mm, hole_radius: " << mm(hole)
      << " mm, thickness: " << mm(wall)
      << " mm}\n  plug: {shape: disc, material: wall, centre: [0, 0, " << mm(-wall)
      << " mm], axis: [0, 0, 1], radius: " << mm(hole) << " mm, thickness: " << mm(wall)
      << " mm, remove: {at: " << base::digits_text(settled, 3)
      << " s}}\n\nemitters:\n  filling:\n    model: fill\n    material: sand\n"
      << "    region: cylinder\n    from: [0, 0, " << mm(grain) << " mm]\n    to: [0, 0, "
      << mm(height - grain) << " mm]\n    radius: " << mm(radius)
      << " mm\n    mass: " << base::digits_text(1e3 * mass, 6) << " g\n    diameters: ["
      << mm(grain)
      << " mm]\n\nfluid: none\n\nsensors:\n  outlet: {model: discharge, centre: [0, 0, 0], hole: "
      << mm(2.0 * hole) << " mm, opened_at: " << base::digits_text(settled, 3) << " s}\n";
  return out.str();
}

}  // namespace

const std::vector<Starter>& starters() {
  static const std::vector<Starter> all = {
      {"transfer",
       "a slice of a belt that hands over its load, with the air around it",
       {{"speed", "Speed of the belt", "m/s", "1 m/s"},
        {"drop", "Height that the load falls", "m", "200 mm"},
        {"flow", "Mass flow of the slice", "kg/s", "0.1 kg/s"},
        {"width", "Width of the slice", "m", "20 mm"},
        {"grain", "Diameter of the grains", "m", "2 mm"}},
       write_transfer},
      {"hopper",
       "a hopper with a level bottom that empties through its outlet",
       {{"outlet", "Diameter of the outlet", "m", "20 mm"},
        {"diameter", "Diameter of the hopper", "m", "60 mm"},
        {"mass", "Mass filled in", "kg", "150 g"},
        {"grain", "Diameter of the grains", "m", "2 mm"}},
       write_hopper}};
  return all;
}

}  // namespace dust::engine
