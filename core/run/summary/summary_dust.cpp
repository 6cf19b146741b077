// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary_dust.hpp"

#include "particles/store/balance_ledger.hpp"
#include "run/summary/plant_begin.hpp"
#include "run/summary/practice_rules.hpp"
#include "setup/dust_rule.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;
using Way = PlantBegin::Key::Way;

struct SizeClass {
  double represented = 0.0;
  bool is_dust = false;
};

/// Each diameter that emitters release; where one is dust in some materials only, it counts as
/// dust, of the size it has in these.
std::map<double, SizeClass> size_classes(const Simulation& s, const scenario::DustRule& rule) {
  std::map<double, SizeClass> classes;
  for (std::size_t e = 0; e < s.setup().emitters.size(); ++e) {
    const scenario::EmitterSpec& spec = s.setup().emitters[e];
    std::vector<int> materials = spec.more_materials;
    materials.push_back(spec.material);
    for (const double diameter : s.models().emitters[e]->diameters()) {
      for (const int material : materials) {
        const auto [at, is_new] = classes.try_emplace(diameter);
        const bool is_dust = rule.is_dust(diameter, material);
        if (!is_new && (at->second.is_dust || !is_dust)) continue;
        at->second = {rule.represented(diameter, material), is_dust};
      }
    }
  }
  return classes;
}

/// [m] mean by mass of all that was released, of the grains that computed ones stand for; 0: none.
double mean_size(const Simulation& s, const scenario::DustRule& rule) {
  double mass = 0.0, moment = 0.0;
  for (const auto& p : s.dem().ledger().populations()) {
    const double released = static_cast<double>(p.emitted) * p.weight * p.mass;
    mass += released;
    moment += released * rule.represented(p.diameter, p.material);
  }
  return mass > 0.0 ? moment / mass : 0.0;
}

/// Anderson's rule for the stream of this run, with what went into it; empty where something that
/// it takes is not known.
Json induced_air_json(const Simulation& s) {
  constexpr double k_tonne = 1e3;  // kg
  if (!s.dust_setup().given || s.stream_indices() == nullptr) return Json::object();
  const scenario::DustSpec& spec = *s.dust_setup().given;
  const double load = s.stream_indices()->load();
  const double size = mean_size(s, s.dust_setup().rule());
  if (!(spec.open_area > 0.0 && spec.fall_height > 0.0 && load > 0.0 && size > 0.0)) {
    return Json::object();
  }
  const double air = induced_air(load, spec.fall_height, size, spec.open_area);
  return {{"load_kg_per_s", load}, {"fall_height_m", spec.fall_height},
          {"mean_size_m", size},   {"open_area_m2", spec.open_area},
          {"air_m3_per_s", air},   {"air_m3_per_tonne", k_tonne * air / load}};
}

}  // namespace

Json dust_rule_json(const Simulation& s) {
  if (!s.dust_setup().given) return Json::object();
  const scenario::DustSpec& spec = *s.dust_setup().given;
  const scenario::DustRule rule = s.dust_setup().rule();
  Json j;
  if (std::isfinite(spec.finer_than)) j["finer_than_m"] = spec.finer_than;
  j["classes_m"] = spec.classes;
  j["materials"] = spec.materials;
  j["material_names"] = Json::array();
  for (const int material : spec.materials) {
    j["material_names"].push_back(s.setup().materials[static_cast<std::size_t>(material)].name);
  }
  j["coarse_graining"] =
      std::vector<double>(rule.coarse_graining().begin(), rule.coarse_graining().end());
  j["hoods"] = spec.hoods;
  j["size_classes"] = Json::array();
  for (const auto& [diameter, entry] : size_classes(s, rule)) {
    j["size_classes"].push_back({{"diameter_m", diameter},
                                 {"represented_diameter_m", entry.represented},
                                 {"is_dust", entry.is_dust}});
  }
  return j;
}

Drawn drawn_by(const Simulation& s, std::size_t opening) {
  const scenario::DustRule rule = s.dust_setup().rule();
  const particles::BalanceLedger& ledger = s.dem().ledger();
  const auto counts = ledger.extracted(opening);
  Drawn drawn;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    const auto& population = ledger.populations()[n];
    const auto count = static_cast<double>(counts[n]);
    const double mass = count * population.weight * population.mass;
    drawn.particles += count;
    drawn.mass += mass;
    if (rule.is_dust(population.diameter, population.material)) drawn.dust += mass;
  }
  if (const DustStage* stage = s.dust_stage()) {
    for (std::size_t n = 0; n < stage->field().classes(); ++n) {
      drawn.field_dust += stage->field().gone(n).outlets[opening];
    }
  }
  drawn.dust += drawn.field_dust;
  return drawn;
}

double dust_so_far(const Simulation& s) {
  const scenario::DustRule rule = s.dust_setup().rule();
  double dust = 0.0;
  for (const auto& population : s.dem().ledger().populations()) {
    if (!rule.is_dust(population.diameter, population.material)) continue;
    dust += static_cast<double>(population.emitted) * population.weight * population.mass;
  }
  if (const DustStage* stage = s.dust_stage()) {
    for (std::size_t n = 0; n < stage->field().classes(); ++n) {
      dust += stage->field().gone(n).released;
    }
  }
  return dust;
}

Json hoods_json(const Simulation& s, const RunFacts& facts) {
  constexpr double k_grams_per_tonne = 1e6;
  constexpr double k_hour = 3600.0;  // s
  const PlantBegin begin = plant_begin(facts);
  const double load = s.dem().balance().mass_emitted - begin.mass;
  const double dust = dust_so_far(s) - begin.dust;
  const auto over = [](double amount, double whole) {
    return whole > 0.0 ? Json(amount / whole) : Json(nullptr);
  };
  Json j = Json::object();
  for (std::size_t o = 0; o < s.dem().openings().size(); ++o) {
    const Drawn drawn = drawn_by(s, o);
    const std::string& name = s.dem().openings()[o].name;
    const double since = drawn.dust - begin.mass_of({Way::hood, name});
    j[name] = {{"particles", static_cast<std::int64_t>(drawn.particles)},
               {"mass_kg", drawn.mass},
               {"dust_kg", drawn.dust},
               {"dust_g_per_tonne", over(k_grams_per_tonne * since, load)},
               {"dust_kg_per_h", over(k_hour * since, s.time() - begin.time)},
               {"share_of_dust", over(since, dust)}};
    if (s.dust_stage() != nullptr) j[name]["field_dust_kg"] = drawn.field_dust;
  }
  return j;
}

Json dust_field_json(const Simulation& s) {
  const DustStage& stage = *s.dust_stage();
  const std::vector<std::string> surfaces = stage.surface_names();
  Json classes = Json::object();
  for (std::size_t n = 0; n < stage.field().classes(); ++n) {
    const airborne::DustBalance balance = stage.field().balance(n);
    Json deposited = Json::object(), left = Json::object(), hoods = Json::object();
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      if (balance.surfaces[k] > 0.0) deposited[surfaces[k]] = balance.surfaces[k];
    }
    for (std::size_t side = 0; side < 6; ++side) {
      if (balance.left[side] > 0.0) left[scenario::k_side_names[side]] = balance.left[side];
    }
    for (std::size_t o = 0; o < stage.openings().size(); ++o) {
      hoods[stage.openings()[o].name] = balance.outlets[o];
    }
    const airborne::DustClass& dust = stage.field().dust_class(n);
    classes[stage.class_names()[n]] = {{"diameter_m", dust.diameter},
                                       {"settling_velocity_m_per_s", norm(dust.drift)},
                                       {"released_kg", balance.released},
                                       {"airborne_kg", balance.airborne},
                                       {"deposited_kg", deposited},
                                       {"left_kg", left},
                                       {"hoods_kg", hoods},
                                       {"balance_error", balance.error()}};
    if (stage.field().has_running_surfaces()) {
      Json carried = Json::object();
      for (std::size_t k = 0; k < surfaces.size(); ++k) {
        if (balance.carried_out[k] > 0.0) carried[surfaces[k]] = balance.carried_out[k];
      }
      classes[stage.class_names()[n]]["carried_out_kg"] = carried;
    }
    if (stage.field().has_inertia()) {
      classes[stage.class_names()[n]]["inertia_limited_share"] = stage.field().limited_share(n);
    }
    if (stage.field().has_scavenging()) {
      classes[stage.class_names()[n]]["caught_by_grains_kg"] = balance.caught;
    }
    if (stage.field().has_resuspension()) {
      classes[stage.class_names()[n]]["resuspended_kg"] = balance.resuspended;
    }
  }
  return {{"classes", classes}, {"sub_steps", stage.field().sub_steps()}};
}

Json dust_on_grains_json(const Simulation& s, const RunFacts& facts) {
  constexpr double k_grams_per_tonne = 1e6;
  constexpr double k_hour = 3600.0;  // s
  const LiberationStage& stage = *s.liberation();
  const std::vector<std::string>& classes = s.dust_stage()->class_names();
  const PlantBegin begin = plant_begin(facts);
  const double load = s.dem().balance().mass_emitted - begin.mass;
  const double time = s.time() - begin.time;
  Json j = Json::object();
  for (std::size_t n = 0; n < classes.size(); ++n) {
    const particles::DustLoads::Balance balance = s.dem().dust_balance(n);
    Json causes = Json::object();
    for (std::size_t c = 0; c < stage.causes().size(); ++c) {
      const double mass = stage.set_free(c, n);
      if (!(mass > 0.0)) continue;
      const std::string& cause = stage.causes()[c];
      const double since = mass - begin.mass_of({Way::cause, cause, classes[n]});
      causes[cause] = {{"kg", mass},
                       {"kg_per_h", k_hour * since / time},
                       {"g_per_tonne", k_grams_per_tonne * since / load}};
    }
    j[classes[n]] = {
        {"entered_kg", balance.entered},       {"on_grains_kg", balance.on_grains},
        {"set_free_kg", balance.set_free},     {"set_free_by", causes},
        {"left_with_grains_kg", balance.left}, {"drawn_out_with_grains_kg", balance.drawn_out},
        {"balance_error", balance.error()}};
    if (s.dust_stage()->has_scavenging()) j[classes[n]]["caught_kg"] = balance.caught;
  }
  return {{"classes", j}, {"kept_back_kg", stage.kept_back()}};
}

Json dust_estimates_json(const Simulation& s) {
  constexpr double k_calm = 0.6, k_windy = 6.7;  // m/s
  Json by_material = Json::object();
  for (std::size_t m = 0; m < s.dust_setup().loads.size(); ++m) {
    const scenario::DustLoadSpec& load = s.dust_setup().loads[m];
    if (load.share.empty() || !(load.moisture > 0.0)) continue;
    by_material[s.setup().materials[m].name] = {
        {"moisture", load.moisture},
        {"least_g_per_tonne", drop_emission(k_calm, load.moisture)},
        {"most_g_per_tonne", drop_emission(k_windy, load.moisture)}};
  }
  Json estimates{{"ap42_drop", by_material}};
  if (s.dust_setup().given && s.dust_setup().given->fall_height > 0.0) {
    const double height = s.dust_setup().given->fall_height;
    estimates["vdi_3790_3"] = {{"fall_height_m", height}, {"over_2_m", drop_height_factor(height)}};
  }
  const Json air = induced_air_json(s);
  if (!air.empty()) estimates["induced_air"] = air;
  return estimates;
}

void add_liberation_table(const Simulation& s, const RunFacts& facts, Json& tables) {
  if (s.liberation() == nullptr) return;
  constexpr double k_grams_per_tonne = 1e6;
  const LiberationStage& stage = *s.liberation();
  const std::vector<std::string>& classes = s.dust_stage()->class_names();
  const PlantBegin begin = plant_begin(facts);
  const double load = s.dem().balance().mass_emitted - begin.mass;
  std::vector<std::string> columns{"set free by"};
  for (const std::string& name : classes) columns.push_back(name + " [g per tonne]");
  Json rows = Json::array();
  for (std::size_t c = 0; c < stage.causes().size(); ++c) {
    Json cells = Json::array({stage.causes()[c]});
    double whole = 0.0;
    for (std::size_t n = 0; n < classes.size(); ++n) {
      const double before = begin.mass_of({Way::cause, stage.causes()[c], classes[n]});
      whole += stage.set_free(c, n);
      cells.push_back(k_grams_per_tonne * (stage.set_free(c, n) - before) / load);
    }
    if (whole > 0.0) rows.push_back(cells);
  }
  if (rows.empty()) return;
  tables.push_back({{"sensor", "dust_on_grains"},
                    {"title", "Dust set free from grains, start-up included"},
                    {"columns", columns},
                    {"rows", rows}});
}

void add_hood_tables(const Simulation& s, Json& tables) {
  const particles::BalanceLedger& ledger = s.dem().ledger();
  for (std::size_t o = 0; o < s.dem().openings().size(); ++o) {
    std::map<double, std::pair<double, double>> sizes;  // by diameter: particles, mass
    const auto counts = ledger.extracted(o);
    for (std::size_t n = 0; n < counts.size(); ++n) {
      if (counts[n] == 0) continue;
      const auto& population = ledger.populations()[n];
      const auto count = static_cast<double>(counts[n]);
      auto& [particles, mass] = sizes[population.diameter];
      particles += count;
      mass += count * population.weight * population.mass;
    }
    Json rows = Json::array();
    for (const auto& [diameter, sums] : sizes) {
      rows.push_back({1e6 * diameter, sums.first, 1e3 * sums.second});
    }
    if (rows.empty()) continue;
    tables.push_back({{"sensor", s.dem().openings()[o].name},
                      {"title", "Drawn out by the hood"},
                      {"columns", {"diameter [um]", "computed grains", "mass [g]"}},
                      {"rows", rows}});
  }
}

}  // namespace dust::run
