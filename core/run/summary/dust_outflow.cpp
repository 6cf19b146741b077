// SPDX-License-Identifier: Apache-2.0
#include "run/summary/dust_outflow.hpp"

#include "report/facts/dust_fractions.hpp"
#include "run/dust/hoods.hpp"
#include "run/summary/summary_dust.hpp"

#include <functional>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;

/// `mass_of`(balance) is what of a class went this way [kg].
Json sampled(const Simulation& s, const CountedSince& since,
             const std::function<double(const airborne::DustBalance&)>& mass_of) {
  constexpr double k_milligrams = 1e6;  // per kg, as grams per tonne
  constexpr double k_hour = 3600.0;     // s
  const airborne::DustField& field = s.dust_stage()->field();
  double whole = 0.0;
  report::DustFractions parts;
  for (std::size_t n = 0; n < field.classes(); ++n) {
    const double mass = mass_of(field.balance(n));
    const report::DustFractions shares = report::dust_fractions(
        report::aerodynamic_diameter(field.dust_class(n).diameter, s.dust_setup().field->density));
    whole += mass;
    parts.inhalable += mass * shares.inhalable;
    parts.thoracic += mass * shares.thoracic;
    parts.respirable += mass * shares.respirable;
  }
  const double time = s.time() - since.time;
  Json j = {{"kg", whole},
            {"kg_per_h", time > 0.0 ? k_hour * whole / time : 0.0},
            {"inhalable_kg", parts.inhalable},
            {"thoracic_kg", parts.thoracic},
            {"respirable_kg", parts.respirable}};
  const double material = s.dem().balance().mass_emitted - since.mass;
  if (material > 0.0) {
    j["g_per_tonne"] = k_milligrams * whole / material;
    j["inhalable_mg_per_kg"] = k_milligrams * parts.inhalable / material;
    j["thoracic_mg_per_kg"] = k_milligrams * parts.thoracic / material;
    j["respirable_mg_per_kg"] = k_milligrams * parts.respirable / material;
  }
  return j;
}

}  // namespace

Json dust_outflow_json(const Simulation& s, const RunFacts& facts) {
  const CountedSince field = facts.start ? facts.start->before.field : CountedSince{};
  const std::vector<particles::Opening>& openings = s.dust_stage()->openings();
  Json j = Json::object();
  for (std::size_t o = 0; o < openings.size(); ++o) {
    const CountedSince hood = hood_since(facts, openings[o].name);
    j[openings[o].name] =
        sampled(s, hood.time > field.time ? hood : field,
                [&](const airborne::DustBalance& balance) { return balance.outlets[o]; });
  }
  for (std::size_t side = 0; side < 6; ++side) {
    if (!s.dust_stage()->lets_dust_out(side)) continue;
    const std::string name = scenario::k_side_names[side];
    j[j.contains(name) ? name + k_beside_hood : name] =
        sampled(s, field, [&](const airborne::DustBalance& balance) { return balance.left[side]; });
  }
  return j;
}

}  // namespace dust::run
