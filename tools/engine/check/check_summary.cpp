// SPDX-License-Identifier: Apache-2.0
#include "check/check_summary.hpp"

#include "base/text.hpp"
#include "check/check_bodies.hpp"
#include "check/check_dust.hpp"
#include "coupling/self_disturbance/disturbance_formulas.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>
#include <thread>

namespace dust::engine {
namespace {

using particles::TimeSteps;
using preflight::Derived;
using scenario::DustSetup;
using scenario::Setup;

/// Digits before the point are all shown: 1000, never 1e+03.
std::string digits(double value, int significant = 3) {
  const bool is_long = std::abs(value) >= std::pow(10.0, significant) && std::abs(value) < 1e9;
  return is_long ? base::fixed_text(value, 0) : base::digits_text(value, significant);
}

/// Number with a prefix that leaves one to three digits before the point: "1.2 us".
std::string engineering(double value, const char* unit) {
  if (value == 0.0 || !std::isfinite(value)) return digits(value) + " " + unit;
  struct Prefix {
    double factor;
    const char* name;
  };
  constexpr std::array k_prefixes = {Prefix{1e9, "G"},  Prefix{1e6, "M"},  Prefix{1e3, "k"},
                                     Prefix{1.0, ""},   Prefix{1e-3, "m"}, Prefix{1e-6, "u"},
                                     Prefix{1e-9, "n"}, Prefix{1e-12, "p"}};
  for (const Prefix& p : k_prefixes) {
    if (std::abs(value) >= 0.9995 * p.factor) {
      return digits(value / p.factor) + " " + p.name + unit;
    }
  }
  return digits(value) + " " + unit;
}

/// [m] Longest edge of the domain: what units suit it.
double extent_of(const Setup& setup) {
  const sdk::Vec3 edges = setup.domain.max - setup.domain.min;
  return std::max({edges.x, edges.y, edges.z});
}

/// "12,345"
std::string counted(double value) {
  std::string text = base::fixed_text(value, 0);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), ",");
  }
  return text;
}

const std::string& material_name(const Setup& setup, int material) {
  return setup.materials[static_cast<std::size_t>(material)].name;
}

void print_domain(std::ostream& out, const Setup& setup, const Derived& derived) {
  const auto& domain = setup.domain;
  const sdk::Vec3 edges = domain.max - domain.min;
  out << "  domain     " << base::extent_text({edges.x, edges.y, edges.z}) << ", gravity "
      << digits(norm(setup.gravity)) << " m/s2\n";
  for (std::size_t n = 0; n < 6; ++n) {
    const auto& side = domain.sides[n];
    out << (n == 0 ? "  sides      " : "             ") << scenario::k_side_names[n] << ": ";
    switch (side.grains) {
      case scenario::GrainSide::open:
        out << "open";
        break;
      case scenario::GrainSide::periodic:
        out << "periodic";
        break;
      case scenario::GrainSide::wall:
        out << "wall of " << material_name(setup, side.material);
        break;
    }
    if (side.air) out << ", air: " << side.air->name;
    const double flow = derived.side_flows[n];
    if (flow != 0.0)
      out << ", " << base::volume_flow_text(std::abs(flow)) << (flow > 0.0 ? " in" : " out");
    out << '\n';
  }
}

std::string moved_by(const scenario::BodySpec& body) {
  std::string text;
  for (const auto& motion : body.motions)
    text += (text.empty() ? ", moved by " : ", ") + motion.name;
  if (text.empty()) text = ", at rest";
  if (body.removal) text += ", taken away later";
  if (body.suction) {
    const double flow = body.suction->flow;
    text += (flow < 0.0 ? ", blows " : ", sucks ") + base::volume_flow_text(std::abs(flow));
  }
  return text;
}

void print_things(std::ostream& out, const Setup& setup, const Derived& derived) {
  const char* head = "  bodies     ";
  for (const auto& body : setup.bodies) {
    out << head << body.name << ": " << body.shape.name << " of "
        << material_name(setup, body.material) << moved_by(body) << '\n';
    head = "             ";
  }
  head = "  emitters   ";
  for (std::size_t n = 0; n < setup.emitters.size(); ++n) {
    const auto& e = derived.emissions[n];
    out << head << e.emitter << ": " << material_name(setup, setup.emitters[n].material);
    if (e.mass_flow > 0.0) out << ", " << base::mass_flow_text(e.mass_flow, extent_of(setup));
    if (e.at_once > 0.0) {
      out << ", " << counted(e.at_once) << " grains at once";
    } else {
      out << ", about " << counted(e.computed_per_second) << " grains per second";
    }
    if (std::abs(e.real_per_second - e.computed_per_second) > 0.5) {
      out << " (standing for " << counted(e.real_per_second) << ")";
    }
    const auto& spec = setup.emitters[n];
    const double l = setup.materials[static_cast<std::size_t>(spec.material)].coarse_graining;
    if (setup.fluid && l != 1.0) {
      out << ", each for " << digits(l * l * l) << " of 1/" << digits(l)
          << " of its size in the fluid";
    }
    out << '\n';
    head = "             ";
  }
  head = "  sensors    ";
  for (const auto& sensor : setup.sensors) {
    out << head << sensor.name << ": " << sensor.model.name << '\n';
    head = "             ";
  }
}

void print_fluid(std::ostream& out, const Setup& setup, const Derived& derived) {
  if (!setup.fluid) {
    out << "  fluid      none: grains alone\n";
    return;
  }
  const auto& n = setup.fluid->cells;
  out << "  fluid      " << n[0] << " x " << n[1] << " x " << n[2] << " = "
      << counted(static_cast<double>(n[0]) * n[1] * n[2]) << " cells, the smallest edge "
      << engineering(derived.smallest_spacing, "m") << "; momentum set "
      << setup.fluid->momentum_set << (setup.fluid->is_one_way ? ", one-way coupling" : "")
      << (setup.fluid->overlaps_grains ? ", solved while the grains move" : "")
      << (setup.turbulence ? ", turbulence " + setup.turbulence->name : "") << '\n';
  out << "             Courant number " << digits(derived.courant_number) << " at "
      << digits(derived.expected_speed) << " m/s (sub-steps keep it below "
      << digits(setup.fluid->largest_cfl) << ")";
  if (setup.drag) out << "; drag " << setup.drag->name;
  for (const auto& force : setup.fluid_forces) out << ", " << force.name;
  if (setup.voidage) out << "; voidage " << setup.voidage->name;
  out << '\n';
}

void add_resolved(std::ostream& out, const Derived& derived) {
  const char* head = "  resolved   ";
  for (const auto& r : derived.resolved) {
    out << head << r.emitter << ": spheres of " << engineering(r.diameter, "m") << " are "
        << digits(r.cells) << " cells across, " << counted(r.markers)
        << " markers each, without a drag law\n";
    head = "             ";
  }
}

/// Whether fine grains may be stepped more often than the others.
bool has_two_steps(const TimeSteps& steps) { return !steps.is_coarse(steps.classes.front()); }

/// What a size has to do with the steps.
std::string step_note(const TimeSteps& steps, const particles::ClassStep& size) {
  if (&size == steps.coarse_deciding()) {
    return has_two_steps(steps)
               ? "<- sets the step from " + engineering(steps.coarse_limit, "m") + " on"
               : "<- sets the step";
  }
  return &size == steps.deciding() ? "<- sets the smallest step" : "";
}

/// Whose collision is the shortest: "steel", or "sand on steel" where several kinds of grains come.
std::string partners(const Setup& setup, const particles::ClassStep& size) {
  if (size.partner < 0) return "nobody";
  const bool is_one_kind = std::all_of(
      setup.emitters.begin(), setup.emitters.end(), [&](const scenario::EmitterSpec& e) {
        return e.material == size.material && e.more_materials.empty();
      });
  const std::string& partner = material_name(setup, size.partner);
  return is_one_kind ? partner : material_name(setup, size.material) + " on " + partner;
}

/// Where the own disturbance of grains up to `coarsest` [m] is not taken off; limits of
/// docs/theory/own_disturbance.md.
void print_uncorrected(std::ostream& out, const Setup& setup, double coarsest,
                       const Derived& derived) {
  namespace disturbance = coupling::self_disturbance;
  if (!setup.bodies.empty()) {
    const double felt = std::min(disturbance::most_of_slip(coarsest, derived.mean_spacing), 1.0);
    out << ",\n             but felt within 2.5 cells of edges, thin sheets and moving bodies: up "
           "to "
        << digits(100.0 * felt) << " % of a lone one's slip";
  }
}

/// Which sizes of grains do not feel what they do to the fluid by themselves.
void print_disturbance_correction(std::ostream& out, const Setup& setup, const Derived& derived) {
  const auto& classes = derived.steps.classes;
  if (!setup.fluid || setup.fluid->is_one_way || classes.empty()) return;
  namespace disturbance = coupling::self_disturbance;
  double finest = 0.0;
  double coarsest = 0.0;
  const double largest = derived.largest_unresolved;
  for (const auto& size : classes) {
    if (size.diameter > largest) break;
    if (!is_self_disturbance_corrected(setup, derived, size.diameter)) continue;
    if (finest == 0.0) finest = size.diameter;
    coarsest = size.diameter;
  }
  if (coarsest > 0.0) {
    out << ",\n             own disturbance taken off for lone grains of "
        << engineering(finest, "m");
    if (coarsest > finest) out << " to " << engineering(coarsest, "m");
    print_uncorrected(out, setup, coarsest, derived);
  }
  const double felt = disturbance::most_of_slip(largest, derived.mean_spacing);
  if (coarsest < largest && felt > disturbance::k_worth) {
    out << ",\n             own disturbance felt by grains of " << engineering(largest, "m")
        << ": up to " << digits(100.0 * std::min(felt, 1.0)) << " % of a lone one's slip";
  }
}

/// The step of those at the coarse rate and, where there are finer grains, theirs.
void print_step(std::ostream& out, const Setup& setup, const TimeSteps& steps) {
  if (setup.time.dem_step > 0.0) {
    const auto& deciding = *steps.deciding();
    out << "             one fixed step of " << engineering(steps.coarse_step, "s") << " = "
        << digits(100.0 * steps.coarse_step / deciding.rayleigh_time)
        << " % of the smallest Rayleigh time, " << digits(deciding.hertz_time / steps.coarse_step)
        << " steps per collision";
    if (steps.coarse_step > deciding.stable_step) out << " (longer than the stable step)";
  } else {
    out << "             " << (has_two_steps(steps) ? "step " : "one step for all: ")
        << engineering(steps.coarse_step, "s");
  }
  if (has_two_steps(steps)) {
    out << "; grains below " << engineering(steps.coarse_limit, "m") << " step down to "
        << engineering(steps.finest_step(), "s") << " where they meet others";
  }
  out << '\n';
}

/// How far grains give way in a collision: what tells a stiffness in the wrong unit.
void print_impact(std::ostream& out, const Setup& setup, const Derived& derived) {
  const preflight::ImpactOverlap& impact = derived.impact;
  if (!(impact.ratio > 0.0)) return;
  const auto& pair = setup.interactions[impact.interaction];
  out << "             largest overlap of an impact at " << preflight::impact_speed_text(impact)
      << ": " << digits(100.0 * impact.ratio) << " % of the radius ("
      << material_name(setup, pair.material_i) << " on " << material_name(setup, pair.material_j)
      << ")";
  if (impact.ratio > preflight::k_soft_overlap) {
    out << ";\n             soft: for " << digits(100.0 * preflight::k_soft_overlap) << " % "
        << stiffness_advice(setup, impact);
  }
  if (impact.is_of_fall && impact.steps > 0.0 && impact.steps < preflight::k_accurate_steps) {
    out << ";\n             it lasts some " << digits(impact.steps)
        << " steps, which costs some per cent of its restitution: time.expected_speed: "
        << digits(impact.speed) << " m/s makes shorter ones";
  }
  // A given speed holds; that something has to break the fall is not seen from it.
  if (!impact.is_of_fall && impact.fall.speed > 1.05 * impact.speed) {
    out << ";\n             time.expected_speed is below the " << digits(impact.fall.speed)
        << " m/s of a free fall of " << base::length_text(impact.fall.height, 3);
  }
  out << '\n';
}

void print_steps(std::ostream& out, const Setup& setup, const Derived& derived) {
  const TimeSteps& steps = derived.steps;
  if (steps.classes.empty()) return;
  const auto print_row = [&](const char* head, const std::array<std::string, 6>& cells) {
    std::array<char, 240> row{};
    std::snprintf(row.data(), row.size(), "%-13s%-11s%-12s%-26s%-14s%-10s%s", head,
                  cells[0].c_str(), cells[1].c_str(), cells[2].c_str(), cells[3].c_str(),
                  cells[4].c_str(), cells[5].c_str());
    std::string text = row.data();
    text.erase(text.find_last_not_of(' ') + 1);
    out << text << '\n';
  };
  print_row("  grains",
            {"diameter", "Rayleigh", "Hertz at " + digits(steps.expected_speed) + " m/s",
             "stable step", "step", ""});
  for (const auto& size : steps.classes) {
    print_row("", {engineering(size.diameter, "m"), engineering(size.rayleigh_time, "s"),
                   engineering(size.hertz_time, "s") + " (" + partners(setup, size) + ")",
                   engineering(size.stable_step, "s"), engineering(steps.step_of(size), "s"),
                   step_note(steps, size)});
  }
  print_step(out, setup, steps);
  print_impact(out, setup, derived);
  out << "             narrowest extent / largest grain W/D = "
      << digits(derived.width_over_diameter);
  if (derived.diameter_over_spacing > 0.0) {
    out << ", largest grain / smallest cell edge D/dx = " << digits(derived.diameter_over_spacing);
  }
  print_disturbance_correction(out, setup, derived);
  // A bed has no wake that walls could hold up; a lone grain has.
  constexpr double k_wake = 10.0;
  if (derived.diameter_over_spacing > 0.0 && derived.width_over_diameter < k_wake) {
    out << "\n             (the wake of a lone grain in the fluid needs W/D above 10)";
  }
  out << '\n';
}

/// What the times rest on.
std::string basis_text(const preflight::LearntCosts::Expected& cost) {
  if (cost.runs == 0) return "rough: no run on this machine yet to learn from";
  return "learnt from " + std::to_string(cost.runs) + (cost.runs == 1 ? " run" : " runs") +
         (cost.is_of_scenario ? " of it" : " of others") + " on this machine";
}

/// What most of the time goes to, largest first.
std::string share_text(const preflight::RunCost& cost) {
  constexpr double k_min_share = 0.05;
  constexpr std::array<const char*, preflight::k_cost_terms> k_words = {
      "steps of grains",         "finer steps of grains", "fluid",
      "exchange with the fluid", "dust in the air",       "files",
      "sensors and checks"};
  std::array<std::size_t, preflight::k_cost_terms> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return cost.terms[a].seconds > cost.terms[b].seconds;
  });
  std::string text;
  for (const std::size_t n : order) {
    const double share = cost.terms[n].seconds / cost.terms.seconds();
    if (!(share >= k_min_share)) continue;
    text += (text.empty() ? "" : ", ") + base::fixed_text(100.0 * share, 0) + " % " + k_words[n];
  }
  return text;
}

void print_cost(std::ostream& out, const Derived& derived,
                const preflight::LearntCosts::Expected& expected) {
  constexpr double k_megabyte = 1e6;
  // Measured on two cores: 95 % of the time of both is used.
  constexpr double k_shared = 0.95;
  const preflight::RunCost& cost = expected.cost;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  out << "  cost       about " << counted(derived.grains_in_domain)
      << " grains at a time (each stays about " << engineering(derived.residence_time, "s") << "), "
      << counted(cost.memory_bytes / k_megabyte) << " MB of memory, "
      << counted(cost.disk_bytes / k_megabyte) << " MB on disk\n             "
      << base::estimated_duration_text(cost.terms.seconds()) << " on one core";
  if (cores > 1) {
    out << ", " << base::estimated_duration_text(cost.terms.seconds() / (k_shared * cores))
        << " on the " << cores << " of this machine";
  }
  out << " (" << basis_text(expected) << "),\n             of that " << share_text(cost) << '\n';
}

nlohmann::ordered_json terms_json(const preflight::RunCost& cost) {
  nlohmann::ordered_json terms = nlohmann::ordered_json::object();
  for (std::size_t n = 0; n < preflight::k_cost_terms; ++n) {
    terms[preflight::k_cost_term_texts[n].name] = {{"amount", cost.terms[n].amount},
                                                   {"of", preflight::k_cost_term_texts[n].counts},
                                                   {"core_s", cost.terms[n].seconds}};
  }
  return terms;
}

}  // namespace

std::string check_json(const Setup& setup, const DustSetup& dust, const Derived& derived,
                       const preflight::BodySurvey& survey,
                       const preflight::LearntCosts::Expected& cost) {
  nlohmann::ordered_json j;
  j["name"] = setup.name;
  j["end_s"] = setup.time.end;
  j["fluid_step_s"] = setup.time.fluid_step;
  j["smallest_step_s"] = derived.steps.finest_step();
  j["largest_step_s"] = derived.steps.coarse_step;
  // As in summary.json.
  j["size_classes"] = nlohmann::ordered_json::array();
  for (const auto& c : derived.steps.classes) {
    j["size_classes"].push_back({{"diameter_m", c.diameter},
                                 {"rayleigh_time_s", c.rayleigh_time},
                                 {"hertz_time_s", c.hertz_time},
                                 {"stable_step_s", c.stable_step},
                                 {"level", c.level}});
  }
  j["impact_overlap_over_radius"] = derived.impact.ratio;
  j["diameter_over_spacing"] = derived.diameter_over_spacing;
  if (!derived.resolved.empty()) {
    j["resolved"] = nlohmann::ordered_json::array();
    for (const auto& r : derived.resolved) {
      j["resolved"].push_back({{"emitter", r.emitter},
                               {"diameter_m", r.diameter},
                               {"cells_per_diameter", r.cells},
                               {"markers", r.markers}});
    }
  }
  add_bodies_json(survey, j);
  add_dust_json(setup, dust, derived.emissions, j);
  j["width_over_diameter"] = derived.width_over_diameter;
  j["courant_number"] = derived.courant_number;
  j["grains"] = derived.grains_in_domain;
  j["memory_bytes"] = cost.cost.memory_bytes;
  j["disk_bytes"] = cost.cost.disk_bytes;
  j["core_s"] = cost.cost.terms.seconds();
  j["core_s_basis"] = basis_text(cost);
  j["core_s_terms"] = terms_json(cost.cost);
  return j.dump(2) + "\n";
}

std::string check_summary(const Setup& setup, const DustSetup& dust, const Derived& derived,
                          const preflight::BodySurvey& survey,
                          const preflight::LearntCosts::Expected& cost) {
  std::ostringstream out;
  const auto& time = setup.time;
  out << setup.name << ": the scenario is valid\n";
  out << "  time       " << engineering(time.end, "s") << " in "
      << counted(std::ceil(time.end / time.fluid_step - 1e-9)) << " steps of "
      << engineering(time.fluid_step, "s") << ", a frame every "
      << engineering(time.output_every, "s") << '\n';
  print_domain(out, setup, derived);
  print_things(out, setup, derived);
  out << bodies_text(survey);
  print_fluid(out, setup, derived);
  out << dust_text(setup, dust, derived.emissions);
  add_resolved(out, derived);
  print_steps(out, setup, derived);
  print_cost(out, derived, cost);
  return out.str();
}

}  // namespace dust::engine
