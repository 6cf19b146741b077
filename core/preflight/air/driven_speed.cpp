// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/driven_speed.hpp"

#include "base/text.hpp"
#include "dust/sdk/table.hpp"
#include "preflight/air/air_passage.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace dust::preflight {
namespace {

using scenario::BodySpec;
using scenario::Diagnostics;
using scenario::Setup;
using scenario::SideSpec;
using scenario::SuctionSpec;
using sdk::SideRule;

/// How much faster the fluid is at the edges of an opening than in its mean.
constexpr double k_at_edges = 2.5;
/// [m/s] Mach 0.3 in air, where its density changes by 5 %.
constexpr double k_compressible = 100.0;
/// [m/s] More than any hood or duct of a plant draws at.
constexpr double k_unusual = 30.0;

/// [m2] The largest face of the box round an opening, as far as it is in the domain's size.
double area_of(const Setup& setup, const SuctionSpec& suction) {
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  std::array<double, 3> edges{};
  for (int d = 0; d < 3; ++d) {
    edges[static_cast<std::size_t>(d)] = std::min(suction.max[d] - suction.min[d], size[d]);
  }
  std::sort(edges.begin(), edges.end());
  return edges[1] * edges[2];
}

/// [m/s] mean through the opening of a body, where it is largest
double suction_speed(const Setup& setup, const SuctionSpec& suction) {
  const double area = area_of(setup, suction);
  if (!(area > 0.0)) return 0.0;
  double largest = 0.0;
  for (const double time : instants(setup)) {
    largest = std::max(largest, std::abs(suction_at(suction, time)));
  }
  return largest / area;
}

/// [m/s] the largest that a side asks for
double side_speed(const Setup& setup, const SideModels& sides, std::size_t side) {
  if (sides[side] == nullptr || is_too_large(setup, side)) return 0.0;
  if (sides[side]->rules().normal_velocity != SideRule::fixed) return 0.0;
  SideFaces faces(setup, side);
  double largest = 0.0;
  for (const double time : instants(setup, sides)) {
    faces.ask(*sides[side], time);
    largest = std::max(largest, faces.largest_speed());
  }
  return largest;
}

/// [m/s] Mean through the opening of a side, which may be smaller than a face of the grid.
double opening_speed(const Setup& setup, const scenario::SideOpeningSpec& opening, double flow) {
  double area = 1.0;
  for (int d = 0; d < 3; ++d) {
    if (d == opening.side / 2) continue;
    area *= std::min(opening.max[d], setup.domain.max[d]) -
            std::max(opening.min[d], setup.domain.min[d]);
  }
  return area > 0.0 ? std::abs(flow) / area : 0.0;
}

/// What is wrong with openings and sides that drive the fluid as fast as this; empty: nothing.
/// `is_hood`: draws out through an opening.
std::string speed_problem(double speed, bool is_hood) {
  const std::string text = base::digits_text(speed, 3) + " m/s: ";
  if (speed > k_compressible) {
    return text + "the fluid is taken to be incompressible, which air is up to some " +
           base::digits_text(k_compressible, 3) + " m/s; is the unit right, as in flow: 300 m3/h?";
  }
  if (!is_hood || !(speed > k_unusual)) return {};
  return text +
         "hoods draw at 0.5 to 2.5 m/s through their face and ducts at 15 to 25 m/s; is the unit "
         "of the flow right, as in flow: 300 m3/h, and the opening (min, max) as large as it is "
         "built?";
}

void check_suction_speed(const Setup& setup, const BodySpec& body, Diagnostics& diagnostics) {
  const SuctionSpec& suction = *body.suction;
  const std::string problem = speed_problem(suction_speed(setup, suction), suction.flow > 0.0);
  if (problem.empty()) return;
  diagnostics.warning(suction.where,
                      "bodies." + body.name + ".suction: " + base::volume_flow_text(suction.flow) +
                          " through at most " + base::area_text(area_of(setup, suction)) + " are " +
                          problem);
}

}  // namespace

double suction_at(const scenario::SuctionSpec& s, double time) {
  return s.flow * sdk::Table(s.times, s.factors, "times", "factors")(time);
}

double driven_speed(const Setup& setup, const SideModels& sides) {
  if (!setup.fluid) return 0.0;
  double largest = 0.0;
  for (const BodySpec& body : setup.bodies) {
    if (!body.suction) continue;
    largest = std::max(largest, k_at_edges * suction_speed(setup, *body.suction));
  }
  for (std::size_t n = 0; n < 6; ++n) largest = std::max(largest, side_speed(setup, sides, n));
  return largest;
}

std::array<double, 6> side_flows(const Setup& setup, const SideModels& sides) {
  std::array<double, 6> flows{};
  if (!setup.fluid) return flows;
  for (std::size_t n = 0; n < 6; ++n) {
    if (sides[n] == nullptr || is_too_large(setup, n)) continue;
    if (sides[n]->rules().normal_velocity != SideRule::fixed) continue;
    SideFaces faces(setup, n);
    for (const double time : instants(setup, sides)) {
      faces.ask(*sides[n], time);
      const double flow = faces.inflow();
      if (std::abs(flow) > std::abs(flows[n])) flows[n] = flow;
    }
  }
  return flows;
}

void check_driven_speed(const Setup& setup, const SideModels& sides,
                        const std::vector<scenario::SideOpeningSpec>& openings,
                        Diagnostics& diagnostics) {
  if (!setup.fluid) return;
  for (const BodySpec& body : setup.bodies) {
    if (body.suction) check_suction_speed(setup, body, diagnostics);
  }
  const std::array<double, 6> flows = side_flows(setup, sides);
  for (std::size_t n = 0; n < 6; ++n) {
    const SideSpec& side = setup.domain.sides[n];
    double speed = side_speed(setup, sides, n);
    bool is_hood = false;
    for (const scenario::SideOpeningSpec& opening : openings) {
      if (static_cast<std::size_t>(opening.side) != n) continue;
      speed = std::max(speed, opening_speed(setup, opening, flows[n]));
      is_hood = true;  // those that draw out
    }
    const std::string problem = speed_problem(speed, is_hood);
    if (problem.empty()) continue;
    diagnostics.warning(side.air ? side.air->where : side.where,
                        path_of_side(n) + ".air: " + (speed > k_compressible ? "drives" : "draws") +
                            " the fluid at " + problem);
  }
}

double wind_speed(const Setup& setup, const SideModels& sides) {
  if (!setup.fluid) return 0.0;
  double largest = 0.0;
  for (std::size_t n = 0; n < 6; ++n) {
    if (!passes_air_everywhere(setup, n, sides)) continue;
    largest = std::max(largest, side_speed(setup, sides, n));
  }
  return largest;
}

}  // namespace dust::preflight
