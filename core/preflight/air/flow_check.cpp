// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/flow_check.hpp"

#include "base/text.hpp"
#include "dust/sdk/error.hpp"
#include "fluid/sides.hpp"
#include "preflight/air/driven_speed.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <string>

namespace dust::preflight {
namespace {

using scenario::BodySpec;
using scenario::Diagnostics;
using scenario::k_side_names;
using scenario::Mark;
using scenario::number_text;
using scenario::Setup;
using scenario::SideSpec;
using sdk::SideRule;

/// Net flow over the sum of the flows that counts as none.
constexpr double k_balance = 1e-6;
/// Ratio of the edges of a cell from which it is called far from cubic.
constexpr double k_far_from_cubic = 4.0;

/// Three digits, as in "0.0012 m3/s".
std::string flow_text(double flow) { return base::digits_text(flow, 3) + " m3/s"; }

void check_cells(const Setup& setup, Diagnostics& diagnostics) {
  double least = 0.0;
  double largest = 0.0;
  for (int d = 0; d < 3; ++d) {
    const int n = setup.fluid->cells[static_cast<std::size_t>(d)];
    if (n == 1) continue;  // nothing varies along it
    const double h = (setup.domain.max[d] - setup.domain.min[d]) / n;
    least = least == 0.0 ? h : std::min(least, h);
    largest = std::max(largest, h);
  }
  if (least == 0.0 || largest < k_far_from_cubic * least) return;
  diagnostics.warning(setup.fluid->where,
                      "fluid.cells: the cells are far from cubic, " +
                          number_text(std::round(10.0 * largest / least) / 10.0) +
                          " times as long one way as another: the long way sets what is resolved, "
                          "the short one the time step");
}

using AllFaces = std::array<std::unique_ptr<SideFaces>, 6>;

/// Inflow of each side at `time`; false after a model's refusal, which is told.
bool find_flows(const Setup& setup, const SideModels& sides, AllFaces& all, double time,
                std::array<double, 6>& flows, Diagnostics& diagnostics) {
  bool is_good = true;
  for (std::size_t n = 0; n < 6; ++n) {
    flows[n] = 0.0;
    if (sides[n] == nullptr) continue;
    if (!all[n]) all[n] = std::make_unique<SideFaces>(setup, n);
    SideFaces& faces = *all[n];
    try {
      faces.ask(*sides[n], time);
    } catch (const std::exception& e) {
      const SideSpec& side = setup.domain.sides[n];
      diagnostics.error(side.air ? side.air->where : side.where,
                        path_of_side(n) + ".air: " + e.what());
      is_good = false;
      continue;
    }
    if (sides[n]->rules().normal_velocity == SideRule::fixed) flows[n] = faces.inflow();
  }
  return is_good;
}

/// Tells a side whose rules the solver cannot do with; false after one.
bool check_rules(const Setup& setup, const SideModels& sides, Diagnostics& diagnostics) {
  for (std::size_t n = 0; n < 6; ++n) {
    if (sides[n] == nullptr || sdk::can_be_solved(sides[n]->rules())) continue;
    diagnostics.error(setup.domain.sides[n].where,
                      path_of_side(n) +
                          ".air: a given normal velocity goes with a zero pressure "
                          "gradient, a given pressure with a zero velocity gradient; "
                          "this model asks for another combination");
    return false;
  }
  return true;
}

/// Whether the velocity through some side follows from the pressure.
bool gives_way(const SideModels& sides) {
  return std::any_of(sides.begin(), sides.end(), [](const sdk::BoundaryCondition* side) {
    return side != nullptr && side->rules().normal_velocity != SideRule::fixed;
  });
}

/// Flow [m3/s] into the domain through sides and openings of bodies, and the sum of its parts.
struct Balance {
  double net = 0.0;
  double gross = 0.0;
};

Balance balance_of(const Setup& setup, const std::array<double, 6>& flows, double time) {
  Balance b;
  for (const double flow : flows) {
    b.net += flow;
    b.gross += std::abs(flow);
  }
  for (const BodySpec& body : setup.bodies) {
    if (!body.suction) continue;
    const double flow = suction_at(*body.suction, time);
    b.net -= flow;
    b.gross += std::abs(flow);
  }
  return b;
}

/// Names every flow at the place of the first that is not none.
void report_imbalance(const Setup& setup, const std::array<double, 6>& flows, double time,
                      double net, Diagnostics& diagnostics) {
  std::string which;
  std::size_t first = 6;
  for (std::size_t n = 0; n < 6; ++n) {
    if (flows[n] == 0.0) continue;
    first = std::min(first, n);
    which += (which.empty() ? "" : ", ") + std::string(k_side_names[n]) + " " + flow_text(flows[n]);
  }
  Mark where = first < 6 ? setup.domain.sides[first].where : setup.domain.sides[0].where;
  for (const BodySpec& body : setup.bodies) {
    if (!body.suction) continue;
    if (which.empty()) where = body.where;
    which +=
        (which.empty() ? "" : ", ") + body.name + " " + flow_text(-suction_at(*body.suction, time));
  }
  diagnostics.error(where, "domain.boundaries: at t = " + number_text(time) + " s the sides let " +
                               flow_text(std::abs(net)) + " more fluid " +
                               (net > 0 ? "in than out" : "out than in") + " (" + which +
                               ") and none of them gives way; make one "
                               "a total_pressure, static_pressure or zero_gradient side");
}

}  // namespace

void check_flow(const Setup& setup, const SideModels& sides, Diagnostics& diagnostics) {
  if (!setup.fluid || diagnostics.has_errors()) return;
  check_cells(setup, diagnostics);
  if (!check_rules(setup, sides, diagnostics)) return;
  for (std::size_t n = 0; n < 6; ++n) {
    if (sides[n] != nullptr && is_too_large(setup, n)) return;
  }
  const bool is_open = gives_way(sides);
  AllFaces all;
  std::array<double, 6> flows{};
  for (const double time : instants(setup, sides)) {
    if (!find_flows(setup, sides, all, time, flows, diagnostics)) return;
    if (is_open) continue;
    const Balance b = balance_of(setup, flows, time);
    const bool is_certain = setup.bodies.empty() || std::abs(b.net) >= b.gross * (1.0 - k_balance);
    if (!is_certain || std::abs(b.net) <= k_balance * b.gross) continue;
    report_imbalance(setup, flows, time, b.net, diagnostics);
    return;
  }
}

}  // namespace dust::preflight
