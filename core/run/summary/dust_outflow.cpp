// SPDX-License-Identifier: Apache-2.0
#include "run/summary/dust_outflow.hpp"

#include "report/facts/dust_fractions.hpp"
#include "run/dust/hoods.hpp"
#include "run/summary/plant_begin.hpp"

#include <functional>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;
using Way = PlantBegin::Key::Way;

/// [kg] What a sampler would find of an amount of dust.
struct Sample {
  double whole = 0.0;
  report::DustFractions parts = {};

  void add(double mass, const report::DustFractions& shares) {
    whole += mass;
    parts.inhalable += mass * shares.inhalable;
    parts.thoracic += mass * shares.thoracic;
    parts.respirable += mass * shares.respirable;
  }
};

/// `mass_of`(balance) is what of a class went this way [kg], counted under `way` and `name`.
Json sampled(const Simulation& s, const PlantBegin& begin, Way way, const std::string& name,
             const std::function<double(const airborne::DustBalance&)>& mass_of) {
  constexpr double k_milligrams = 1e6;  // per kg, as grams per tonne
  constexpr double k_hour = 3600.0;     // s
  const airborne::DustField& field = s.dust_stage()->field();
  Sample all, since;
  for (std::size_t n = 0; n < field.classes(); ++n) {
    const double mass = mass_of(field.balance(n));
    const report::DustFractions shares = report::dust_fractions(
        report::aerodynamic_diameter(field.dust_class(n).diameter, s.dust_setup().field->density));
    const std::string& of_class = s.dust_stage()->class_names()[n];
    all.add(mass, shares);
    since.add(mass - begin.mass_of({way, name, of_class}), shares);
  }
  const double time = s.time() - begin.time;
  Json j = {{"kg", all.whole},
            {"kg_per_h", time > 0.0 ? k_hour * since.whole / time : 0.0},
            {"inhalable_kg", all.parts.inhalable},
            {"thoracic_kg", all.parts.thoracic},
            {"respirable_kg", all.parts.respirable}};
  const double material = s.dem().balance().mass_emitted - begin.mass;
  if (material > 0.0) {
    j["g_per_tonne"] = k_milligrams * since.whole / material;
    j["inhalable_mg_per_kg"] = k_milligrams * since.parts.inhalable / material;
    j["thoracic_mg_per_kg"] = k_milligrams * since.parts.thoracic / material;
    j["respirable_mg_per_kg"] = k_milligrams * since.parts.respirable / material;
  }
  return j;
}

}  // namespace

Json dust_outflow_json(const Simulation& s, const RunFacts& facts) {
  const PlantBegin begin = plant_begin(facts);
  const std::vector<particles::Opening>& openings = s.dust_stage()->openings();
  Json j = Json::object();
  for (std::size_t o = 0; o < openings.size(); ++o) {
    j[openings[o].name] =
        sampled(s, begin, Way::outlet, openings[o].name,
                [&](const airborne::DustBalance& balance) { return balance.outlets[o]; });
  }
  for (std::size_t side = 0; side < 6; ++side) {
    if (!s.dust_stage()->lets_dust_out(side)) continue;
    const std::string name = scenario::k_side_names[side];
    j[name] = sampled(s, begin, Way::side, name,
                      [&](const airborne::DustBalance& balance) { return balance.left[side]; });
  }
  return j;
}

}  // namespace dust::run
