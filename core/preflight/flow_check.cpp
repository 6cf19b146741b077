// SPDX-License-Identifier: Apache-2.0
#include "preflight/flow_check.hpp"

#include "base/text.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/side_flow.hpp"
#include "dust/sdk/table.hpp"
#include "fluid/properties.hpp"
#include "fluid/sides.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dust::preflight {
namespace {

using scenario::BodySpec;
using scenario::Diagnostics;
using scenario::k_side_names;
using scenario::Mark;
using scenario::number_text;
using scenario::Setup;
using scenario::SideSpec;
using scenario::SuctionSpec;
using sdk::SideRule;

/// Net flow over the sum of the flows that counts as none.
constexpr double k_balance = 1e-6;
/// Times of the run at which flows are looked at, the end included.
constexpr int k_times = 16;
/// [s] Flows that begin later are no flows of any run.
constexpr double k_latest = 1e6;
/// How much faster the fluid is at the edges of an opening than in its mean.
constexpr double k_at_edges = 2.5;
/// [m/s] Mach 0.3 in air, where its density changes by 5 %.
constexpr double k_compressible = 100.0;
/// Sides with more faces than this are left to the run: a check shall not need its memory.
constexpr std::size_t k_max_faces = 4'000'000;
/// The sensor of the friction on a side.
constexpr std::string_view k_wall_shear = "wall_shear";
/// Ratio of the edges of a cell from which it is called far from cubic.
constexpr double k_far_from_cubic = 4.0;

std::string path_of(std::size_t side) {
  return std::string("domain.boundaries.") + k_side_names[side];
}

/// Three digits, as in "0.0012 m3/s".
std::string flow_text(double flow) { return base::digits_text(flow, 3) + " m3/s"; }

/// The faces of one side as the fluid has them, without bodies and grains.
struct Faces {
  sdk::SideBatch batch;
  std::vector<double> x, y, z, velocity[3], pressure, one, density, area;
  bool is_of_own_fluid = true;  ///< no region of another viscosity lies at the side

  Faces(const Setup& setup, std::size_t side) {
    const int d = static_cast<int>(side / 2);
    const int e = d == 0 ? 1 : 0;
    const int f = d == 2 ? 1 : 2;
    const auto& cells = setup.fluid->cells;
    batch.low = setup.domain.min;
    batch.high = setup.domain.max;
    for (int a = 0; a < 3; ++a) {
      batch.spacing[a] =
          (setup.domain.max[a] - setup.domain.min[a]) / cells[static_cast<std::size_t>(a)];
    }
    (side % 2 ? batch.low : batch.high)[d] = (side % 2 ? batch.high : batch.low)[d];
    batch.normal[d] = side % 2 ? 1.0 : -1.0;
    const fluid::Properties by_place(*setup.fluid);
    for (std::vector<double>* column : {&x, &y, &z, &density}) {
      column->reserve(count_of(setup, side));
    }
    for (int b = 0; b < cells[static_cast<std::size_t>(f)]; ++b) {
      for (int a = 0; a < cells[static_cast<std::size_t>(e)]; ++a) {
        sdk::Vec3 p = batch.low;
        p[e] += (a + 0.5) * batch.spacing[e];
        p[f] += (b + 0.5) * batch.spacing[f];
        x.push_back(p.x);
        y.push_back(p.y);
        z.push_back(p.z);
        p[d] -= 0.5 * batch.normal[d] * batch.spacing[d];  // the cell inside
        density.push_back(by_place.at(p).density);
        is_of_own_fluid = is_of_own_fluid && by_place.at(p).viscosity == by_place.own().viscosity;
      }
    }
    batch.count = x.size();
    clear();
    one.assign(batch.count, 1.0);
    area.assign(batch.count, batch.spacing[e] * batch.spacing[f]);
    batch.position.x = x.data();
    batch.position.y = y.data();
    batch.position.z = z.data();
    batch.velocity.x = velocity[0].data();
    batch.velocity.y = velocity[1].data();
    batch.velocity.z = velocity[2].data();
    batch.pressure = pressure.data();
    batch.void_fraction = one.data();
    batch.density = density.data();
    batch.area = area.data();
  }
  // The batch points into the columns.
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;

  static std::size_t count_of(const Setup& setup, std::size_t side) {
    std::size_t count = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      if (a != side / 2) count *= static_cast<std::size_t>(setup.fluid->cells[a]);
    }
    return count;
  }
  /// Forgets what a model wrote.
  void clear() {
    for (auto& v : velocity) v.assign(batch.count, 0.0);
    pressure.assign(batch.count, 0.0);
  }
  /// Lets a model write what it wants at `time`.
  void ask(const sdk::BoundaryCondition& model, double time) {
    clear();
    batch.time = time;
    model.evaluate(batch);
  }
  /// [m/s] largest component of what a model wrote
  [[nodiscard]] double largest_speed() const {
    double largest = 0.0;
    for (const auto& component : velocity) {
      for (const double v : component) largest = std::max(largest, std::abs(v));
    }
    return largest;
  }
  /// Did a model let fluid pass any face?
  [[nodiscard]] bool is_passed() const {
    const auto& normal = velocity[sdk::axis_of(batch.normal)];
    return std::any_of(normal.begin(), normal.end(), [](double v) { return v != 0.0; });
  }
  [[nodiscard]] bool is_passed_everywhere() const {
    const auto& normal = velocity[sdk::axis_of(batch.normal)];
    return std::all_of(normal.begin(), normal.end(), [](double v) { return v != 0.0; });
  }
  /// [m3/s] into the domain
  [[nodiscard]] double inflow() const {
    const int d = batch.normal.x != 0.0 ? 0 : batch.normal.y != 0.0 ? 1 : 2;
    double sum = 0.0;
    for (std::size_t n = 0; n < batch.count; ++n) {
      sum -= batch.normal[d] * velocity[d][n] * area[n];
    }
    return sum;
  }
};

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

/// [m3/s]
double flow_into(const SuctionSpec& s, double time) {
  return s.flow * sdk::Table(s.times, s.factors, "times", "factors")(time);
}

using AllFaces = std::array<std::unique_ptr<Faces>, 6>;

/// Inflow of each side at `time`; false after a model's refusal, which is told.
bool find_flows(const Setup& setup, const SideModels& sides, AllFaces& all, double time,
                std::array<double, 6>& flows, Diagnostics& diagnostics) {
  bool is_good = true;
  for (std::size_t n = 0; n < 6; ++n) {
    flows[n] = 0.0;
    if (sides[n] == nullptr) continue;
    if (!all[n]) all[n] = std::make_unique<Faces>(setup, n);
    Faces& faces = *all[n];
    try {
      faces.ask(*sides[n], time);
    } catch (const std::exception& e) {
      const SideSpec& side = setup.domain.sides[n];
      diagnostics.error(side.air ? side.air->where : side.where, path_of(n) + ".air: " + e.what());
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
                      path_of(n) +
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
    const double flow = flow_into(*body.suction, time);
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
        (which.empty() ? "" : ", ") + body.name + " " + flow_text(-flow_into(*body.suction, time));
  }
  diagnostics.error(where, "domain.boundaries: at t = " + number_text(time) + " s the sides let " +
                               flow_text(std::abs(net)) + " more fluid " +
                               (net > 0 ? "in than out" : "out than in") + " (" + which +
                               ") and none of them gives way; make one "
                               "a total_pressure, static_pressure or zero_gradient side");
}

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

bool is_too_large(const Setup& setup, std::size_t side) {
  return Faces::count_of(setup, side) > k_max_faces;
}

/// [m/s] mean through the opening of a body, where it is largest
double suction_speed(const Setup& setup, const SuctionSpec& suction) {
  const double area = area_of(setup, suction);
  if (!(area > 0.0)) return 0.0;
  double largest = 0.0;
  for (int step = 0; step <= k_times; ++step) {
    largest = std::max(largest, std::abs(flow_into(suction, setup.time.end * step / k_times)));
  }
  return largest / area;
}

/// [m/s] the largest that a side asks for
double side_speed(const Setup& setup, const SideModels& sides, std::size_t side) {
  if (sides[side] == nullptr || is_too_large(setup, side)) return 0.0;
  if (sides[side]->rules().normal_velocity != SideRule::fixed) return 0.0;
  Faces faces(setup, side);
  double largest = 0.0;
  for (int step = 0; step <= k_times; ++step) {
    faces.ask(*sides[side], setup.time.end * step / k_times);
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

/// The side that a sensor of wall shear is given, as a number; -1 for others.
int side_of(const scenario::SensorSpec& sensor, const registry::Registry& registry) {
  if (sensor.model.name != k_wall_shear) return -1;
  const registry::Entry* entry = registry.find(sensor.model.kind, sensor.model.name);
  if (entry == nullptr) return -1;
  for (std::size_t n = 0; n < sensor.model.values.size(); ++n) {
    const auto* text = std::get_if<std::string>(&sensor.model.values[n]);
    if (text == nullptr || entry->info.parameters[n].name != "side") continue;
    const auto side = std::find(k_side_names.begin(), k_side_names.end(), *text);
    if (side != k_side_names.end()) return static_cast<int>(side - k_side_names.begin());
  }
  return -1;
}

}  // namespace

SideModelSet::SideModelSet(const Setup& setup, const registry::Registry& registry) {
  for (std::size_t n = 0; n < 6; ++n) {
    const auto& air = setup.domain.sides[n].air;
    if (air) made_[n] = registry.create_as<sdk::BoundaryCondition>(*air);
    models_[n] = made_[n].get();
  }
}

bool passes_air(const Setup& setup, std::size_t side, const sdk::BoundaryCondition* model) {
  if (!setup.fluid || model == nullptr) return false;
  if (model->rules().normal_velocity != SideRule::fixed) return true;
  if (is_too_large(setup, side)) return model->needs_flow();
  Faces faces(setup, side);
  const auto is_passed_at = [&](double time) {
    faces.ask(*model, time);
    return faces.is_passed();
  };
  for (int step = 0; step <= k_times; ++step) {
    if (is_passed_at(setup.time.end * step / k_times)) return true;
  }
  // A run that is given a later end is to find the same answer.
  for (double later = setup.time.end; later < k_latest; later *= 10.0) {
    if (is_passed_at(later)) return true;
  }
  return false;
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
    Faces faces(setup, n);
    for (int step = 0; step <= k_times; ++step) {
      faces.ask(*sides[n], setup.time.end * step / k_times);
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
  const auto warn = [&](const Mark& where, const std::string& what, double speed) {
    if (!(speed > k_compressible)) return;
    diagnostics.warning(where, what + " " + base::digits_text(speed, 3) +
                                   " m/s: the fluid is taken to be incompressible, which air is up "
                                   "to some " +
                                   base::digits_text(k_compressible, 3) +
                                   " m/s; is the unit right, as in flow: 300 m3/h?");
  };
  for (const BodySpec& body : setup.bodies) {
    if (!body.suction) continue;
    warn(body.suction->where,
         "bodies." + body.name + ".suction: " + base::volume_flow_text(body.suction->flow) +
             " through at most " + base::area_text(area_of(setup, *body.suction)) + " are",
         suction_speed(setup, *body.suction));
  }
  const std::array<double, 6> flows = side_flows(setup, sides);
  for (std::size_t n = 0; n < 6; ++n) {
    const SideSpec& side = setup.domain.sides[n];
    double speed = side_speed(setup, sides, n);
    for (const scenario::SideOpeningSpec& opening : openings) {
      if (static_cast<std::size_t>(opening.side) != n) continue;
      speed = std::max(speed, opening_speed(setup, opening, flows[n]));
    }
    warn(side.air ? side.air->where : side.where, path_of(n) + ".air: drives the fluid at", speed);
  }
}

namespace {

/// Whether no part of a side is a wall to the air, as is that beside a hood.
bool passes_air_everywhere(const Setup& setup, std::size_t side,
                           const sdk::BoundaryCondition& model) {
  if (model.rules().normal_velocity != SideRule::fixed) return true;
  if (is_too_large(setup, side)) return false;
  Faces faces(setup, side);
  for (int step = 0; step <= k_times; ++step) {
    faces.ask(model, setup.time.end * step / k_times);
    if (faces.is_passed_everywhere()) return true;
  }
  return false;
}

}  // namespace

double wind_speed(const Setup& setup, const SideModels& sides) {
  if (!setup.fluid) return 0.0;
  double largest = 0.0;
  for (std::size_t n = 0; n < 6; ++n) {
    if (sides[n] == nullptr || !passes_air_everywhere(setup, n, *sides[n])) continue;
    largest = std::max(largest, side_speed(setup, sides, n));
  }
  return largest;
}

void check_wall_shear(const Setup& setup, const SideModels& sides,
                      const registry::Registry& registry, Diagnostics& diagnostics) {
  if (!setup.fluid || diagnostics.has_errors()) return;
  for (const scenario::SensorSpec& sensor : setup.sensors) {
    const int number = side_of(sensor, registry);
    if (number < 0) continue;
    const auto side = static_cast<std::size_t>(number);
    const auto refuse = [&](const std::string& why) {
      diagnostics.error(sensor.model.where,
                        "sensors." + sensor.name + ".side: " + k_side_names[side] + why);
    };
    if (sides[side] == nullptr) {
      refuse(" is periodic, no wall that the air could rub; name a side that is one");
    } else if (passes_air_everywhere(setup, side, *sides[side])) {
      refuse(" lets air pass wherever it is, so that there is no wall; name a side that is one");
    } else if (sides[side]->rules().tangential_velocity != SideRule::fixed) {
      refuse(
          " holds no air that goes along it, so that there is no shear; name a side with no_slip "
          "or moving_wall");
    } else if (!is_too_large(setup, side) && !Faces(setup, side).is_of_own_fluid) {
      refuse(
          " has a region of another viscosity beside it, and the sensor knows that of the fluid "
          "alone; name another side, or take the sensor out");
    }
  }
}

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
  for (int step = 0; step <= k_times; ++step) {
    const double time = setup.time.end * step / k_times;
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
