// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary_audit.hpp"

#include "base/text.hpp"

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;
using base::digits_text;
using scenario::Setup;

constexpr double k_logged_share = 5e-4;  // below it a force is not told in the log

ForceKind kind_of(std::size_t n) { return static_cast<ForceKind>(n); }

/// What acts, by model: "contact hertz_mindlin (sand, belt)".
std::vector<std::string> active_models(const Setup& setup) {
  std::vector<std::string> all;
  const auto name_of = [&](int material) {
    return setup.materials[static_cast<std::size_t>(material)].name;
  };
  if (norm(setup.gravity) > 0.0) all.emplace_back("gravity");
  for (const auto& i : setup.interactions) {
    const std::string pair = " (" + name_of(i.material_i) + ", " + name_of(i.material_j) + ")";
    all.push_back("contact " + i.contact.name + pair);
    if (i.rolling) all.push_back("rolling " + i.rolling->name + pair);
    if (i.cohesion) all.push_back("cohesion " + i.cohesion->name + pair);
  }
  if (!setup.fluid) return all;
  if (setup.drag) all.push_back("drag " + setup.drag->name);
  all.push_back("pressure gradient and viscous stress (momentum set " + setup.fluid->momentum_set +
                ")");
  for (const auto& force : setup.fluid_forces) all.push_back("fluid force " + force.name);
  return all;
}

std::string grain_text(const Departures::Grain& g) {
  return "grain " + std::to_string(g.id) + " of " + base::length_text(g.diameter, 3) + " at " +
         base::place_text(g.place) + " in step " + std::to_string(g.step) + " (" +
         digits_text(g.time, 4) + " s)";
}

std::string forces_line(const ForceShares& shares) {
  std::string text;
  for (std::size_t n = 0; n < k_force_kinds; ++n) {
    const double share = shares.share(kind_of(n));
    if (share < k_logged_share) continue;
    text += (text.empty() ? "" : ", ") + std::string(k_force_names[n]) + ' ' +
            digits_text(100.0 * share, 3) + " %";
  }
  return text;
}

}  // namespace

Json departures_json(const Departures& departures) {
  Json sides = Json::object();
  for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
    const Departures::Side& through = departures.through(side);
    if (through.count == 0) continue;
    Json first = Json::array();
    for (const Departures::Grain& g : through.first) {
      first.push_back({{"id", g.id},
                       {"diameter_m", g.diameter},
                       {"place_m", {g.place.x, g.place.y, g.place.z}},
                       {"step", g.step},
                       {"time_s", g.time}});
    }
    sides[scenario::k_side_names[side]] = {
        {"count", through.count}, {"mass_kg", through.mass}, {"first", first}};
  }
  return sides;
}

Json forces_json(const Setup& setup, const ForceShares& shares) {
  Json kinds = Json::object();
  for (std::size_t n = 0; n < k_force_kinds; ++n) {
    kinds[k_force_names[n]] = {{"share", shares.share(kind_of(n))},
                               {"over_weight", shares.over_weight(kind_of(n))}};
  }
  return {{"active", active_models(setup)}, {"samples", shares.samples()}, {"kinds", kinds}};
}

void add_force_table(const ForceShares& shares, Json& tables) {
  if (shares.samples() == 0) return;
  Json columns = Json::array();
  Json row = Json::array();
  for (std::size_t n = 0; n < k_force_kinds; ++n) {
    std::string name = k_force_names[n];
    for (char& c : name) c = c == '_' ? ' ' : c;
    columns.push_back(name + " [%]");
    row.push_back(100.0 * shares.share(kind_of(n)));
  }
  tables.push_back({{"sensor", "forces"},
                    {"title", "Forces on the grains, mean shares"},
                    {"columns", columns},
                    {"rows", Json::array({row})}});
}

std::vector<std::string> audit_lines(const Simulation& s, const ForceShares& shares) {
  std::vector<std::string> lines;
  std::string active;
  for (const std::string& model : active_models(s.setup())) {
    active += (active.empty() ? "" : ", ") + model;
  }
  lines.push_back("forces that act: " + active);
  if (const std::string kinds = forces_line(shares); !kinds.empty()) {
    lines.push_back("forces on grains, mean of " + std::to_string(shares.samples()) +
                    " frames: " + kinds);
  }
  for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
    const Departures::Side& through = s.insertion().departures().through(side);
    if (through.count == 0) continue;
    lines.push_back(
        "left by the side '" + std::string(scenario::k_side_names[side]) +
        "': " + std::to_string(through.count) + (through.count == 1 ? " grain, " : " grains, ") +
        base::mass_text(through.mass) + "; the first: " + grain_text(through.first.front()));
  }
  return lines;
}

}  // namespace dust::run
