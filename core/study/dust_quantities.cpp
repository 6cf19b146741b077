// SPDX-License-Identifier: Apache-2.0
#include "study/dust_quantities.hpp"

#include "dust/sdk/liberation_law.hpp"
#include "preflight/air/air_passage.hpp"
#include "run/dust/dust_stage.hpp"
#include "run/dust/hoods.hpp"
#include "setup/draws_out.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace dust::study {
namespace {

struct DustName {
  const char* name;
  const char* unit;
};

/// Of each way that dust has out of the air; in mg per kg of the material that was brought in.
constexpr DustName k_of_outflow[] = {
    {"kg", "kg"},
    {"kg_per_h", "kg/h"},
    {"g_per_tonne", "g/t"},
    {"inhalable_kg", "kg"},
    {"thoracic_kg", "kg"},
    {"respirable_kg", "kg"},
    {"inhalable_mg_per_kg", "mg/kg"},
    {"thoracic_mg_per_kg", "mg/kg"},
    {"respirable_mg_per_kg", "mg/kg"},
};

/// Of each way of the dust in the steady stream (run::DustRates).
constexpr DustName k_of_rate[] = {{"rate", "kg/h"}, {"per_load", "g/t"}};

/// Of the stream of grains that falls through the air, and of what its impacts turn to heat.
constexpr DustName k_of_stream[] = {
    {"entrained_air.flow", "m3/s"},
    {"entrained_air.per_load", "m3/t"},
    {"entrained_air.height", "m"},
    {"looseness.void_fraction", "1"},
    {"looseness.densest_void_fraction", "1"},
    {"looseness.expansion", "1"},
    {"looseness.height", "m"},
};
constexpr DustName k_of_impacts[] = {{"power", "W"}, {"per_load", "J/kg"}};

/// Of each hood and opening, whether there is a field of dust or not.
constexpr DustName k_of_hood[] = {
    {"particles", "1"},          {"mass_kg", "kg"},         {"dust_kg", "kg"},
    {"dust_g_per_tonne", "g/t"}, {"dust_kg_per_h", "kg/h"}, {"share_of_dust", "1"},
};

/// Of each size class of the dust in the air.
constexpr DustName k_of_field[] = {
    {"diameter_m", "m"},    {"settling_velocity_m_per_s", "m/s"},
    {"released_kg", "kg"},  {"airborne_kg", "kg"},
    {"balance_error", "1"},
};

/// Of each size class of the dust that grains bring along, and of each thing that frees it.
constexpr DustName k_of_load[] = {
    {"entered_kg", "kg"},          {"on_grains_kg", "kg"}, {"set_free_kg", "kg"},
    {"left_with_grains_kg", "kg"}, {"balance_error", "1"}, {"drawn_out_with_grains_kg", "kg"},
};
constexpr DustName k_of_cause[] = {{"kg", "kg"}, {"kg_per_h", "kg/h"}, {"g_per_tonne", "g/t"}};

bool has_hood(const scenario::DustSetup& dust, std::size_t side) {
  return std::any_of(dust.openings.begin(), dust.openings.end(),
                     [&](const auto& opening) { return opening.side == static_cast<int>(side); });
}

class DustQuantities {
 public:
  DustQuantities(const scenario::Setup& setup, const scenario::DustSetup& dust,
                 const registry::Registry& registry)
      : setup_(setup), dust_(dust), sides_(setup, registry) {
    if (dust.field) {
      for (const double d : dust.field->diameters) {
        classes_.push_back(sdk::name_of(d * 1e6) + "_um");
      }
    }
    if (dust.liberation) {
      const auto law = registry.create_as<sdk::LiberationLaw>(*dust.liberation);
      needs_wind_ = law->needs_wind();
    }
    for (const auto& opening : run::openings_of(setup, dust)) hoods_.push_back(opening.name);
    for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
      if (setup.domain.sides[side].grains == scenario::GrainSide::wall) {
        surfaces_.emplace_back(scenario::k_side_names[side]);
      }
    }
    for (const scenario::BodySpec& body : setup.bodies) surfaces_.push_back(body.name);
  }

  std::vector<Quantity> find() {
    for (const std::string& hood : hoods_) add_hood(hood);
    if (!dust_.field || !setup_.fluid) return all_;
    for (const std::string& name : classes_) add_class("dust_field.classes." + name + ".");
    add("dust_field.sub_steps", "1");
    for (const std::string& way : ways_out()) add_all(k_of_outflow, "dust_outflow." + way + ".");
    for (const std::string& side : closed_sides()) {
      add_all(k_of_outflow, "dust_outflow." + side + ".", "dust_field.sub_steps");
    }
    add_rates();
    add_indices();
    if (dust_.liberation) {
      for (const std::string& name : classes_) add_load("dust_on_grains.classes." + name + ".");
      add("dust_on_grains.kept_back_kg", "kg");
    }
    return all_;
  }

 private:
  void add(const std::string& path, const char* unit, const std::string& zero_beside = {}) {
    all_.push_back({path, unit, false, zero_beside});
  }
  template <class Names>
  void add_all(const Names& names, const std::string& prefix, const std::string& zero_beside = {}) {
    for (const DustName& n : names) add(prefix + n.name, n.unit, zero_beside);
  }

  void add_hood(const std::string& hood) {
    add_all(k_of_hood, "hoods." + hood + ".");
    if (dust_.field && setup_.fluid) add("hoods." + hood + ".field_dust_kg", "kg");
  }

  void add_class(const std::string& of) {
    add_all(k_of_field, of);
    const std::string beside = of + "released_kg";
    for (const std::string& surface : settled_on()) {
      add(of + "deposited_kg." + surface, "kg", beside);
    }
    for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
      if (is_periodic(side)) continue;
      add(of + "left_kg." + scenario::k_side_names[side], "kg", beside);
    }
    for (const std::string& hood : hoods_) add(of + "hoods_kg." + hood, "kg");
    for (const std::string& body : running_bodies()) {
      add(of + "carried_out_kg." + body, "kg", beside);
    }
    if (dust_.field->inertia) add(of + "inertia_limited_share", "1");
    if (dust_.field->scavenging) add(of + "caught_by_grains_kg", "kg");
    if (dust_.field->resuspension) add(of + "resuspended_kg", "kg");
  }

  void add_load(const std::string& of) {
    add_all(k_of_load, of);
    if (dust_.field->scavenging) add(of + "caught_kg", "kg");
    for (const std::string& cause : causes()) {
      add_all(k_of_cause, of + "set_free_by." + cause + ".", of + "set_free_kg");
    }
  }

  /// Of a way all of it, and each of its parts; parts without dust may be left out.
  void add_way(const std::string& way, const std::vector<std::string>& parts, bool is_way_out) {
    for (const DustName& n : k_of_rate) {
      all_.push_back({"dust_rates." + way + ".all." + n.name, n.unit, true, {}});
    }
    add_parts(way, parts, is_way_out);
  }

  void add_parts(const std::string& way, const std::vector<std::string>& parts, bool is_way_out) {
    const std::string of = "dust_rates." + way + ".";
    for (const DustName& n : k_of_rate) {
      const std::string all = of + "all." + n.name;
      for (const std::string& part : parts) {
        all_.push_back({of + part + "." + n.name, n.unit, true, is_way_out ? std::string() : all});
      }
    }
  }

  void add_rates() {
    std::vector<std::string> open;
    for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
      if (lets_dust_out(side)) open.emplace_back(scenario::k_side_names[side]);
    }
    if (!open.empty()) {
      add_way("left", open, true);
      add_parts("left", closed_sides(), false);
    }
    if (!hoods_.empty()) add_way("drawn_out", hoods_, true);
    add_way("deposited", settled_on(), false);
    if (dust_.liberation) {
      add_way("set_free", causes(), false);
    }
    if (!dust_.liberation || !dust_.field->sources.empty()) {
      add_way("released", {"sources"}, false);
    }
    if (!running_bodies().empty()) add_way("carried_out", running_bodies(), false);
    if (dust_.field->scavenging) add_way("caught", {"grains"}, false);
  }

  /// As run::StreamIndices tells them.
  void add_indices() {
    const std::string of = "stream_indices.";
    for (const DustName& n : k_of_stream) {
      all_.push_back({of + n.name, n.unit, std::string_view(n.name).ends_with("flow"), {}});
    }
    if (!dust_.liberation) return;
    for (const DustName& n : k_of_impacts) {
      const std::string all = of + "impact.all." + n.name;
      add(all, n.unit);
      for (const std::string& cause : bodies_of_impacts()) {
        all_.push_back({of + "impact." + cause + "." + n.name, n.unit, true, all});
      }
    }
  }

  [[nodiscard]] bool is_periodic(std::size_t side) const {
    return setup_.domain.sides[side].grains == scenario::GrainSide::periodic;
  }

  /// Sides that let none out, where another point of a study may: its wind comes from elsewhere.
  [[nodiscard]] std::vector<std::string> closed_sides() const {
    std::vector<std::string> names;
    for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
      if (is_periodic(side) || has_hood(dust_, side) || lets_dust_out(side)) continue;
      names.emplace_back(scenario::k_side_names[side]);
    }
    return names;
  }

  /// As run::DustStage::lets_dust_out.
  [[nodiscard]] bool lets_dust_out(std::size_t side) const {
    return !has_hood(dust_, side) && preflight::passes_air(setup_, side, sides_.models());
  }

  /// Sides that dust settles on, whether they hold grains or not, and bodies.
  [[nodiscard]] std::vector<std::string> settled_on() const {
    std::vector<std::string> names;
    for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
      const scenario::GrainSide grains = setup_.domain.sides[side].grains;
      const bool is_open = grains == scenario::GrainSide::open && lets_dust_out(side);
      if (grains == scenario::GrainSide::periodic || is_open) continue;
      names.emplace_back(scenario::k_side_names[side]);
    }
    for (const scenario::BodySpec& body : setup_.bodies) names.push_back(body.name);
    return names;
  }

  /// Hoods, and sides that dust gets out of.
  [[nodiscard]] std::vector<std::string> ways_out() const {
    std::vector<std::string> ways;
    for (const scenario::BodySpec& body : setup_.bodies) {
      if (body.suction && scenario::draws_out(*body.suction)) ways.push_back(body.name);
    }
    for (std::size_t side = 0; side < scenario::k_side_names.size(); ++side) {
      if (has_hood(dust_, side) || lets_dust_out(side)) {
        ways.emplace_back(scenario::k_side_names[side]);
      }
    }
    return ways;
  }

  [[nodiscard]] std::vector<std::string> running_bodies() const {
    std::vector<std::string> names;
    for (const scenario::BodySpec& body : setup_.bodies) {
      if (!body.motions.empty()) names.push_back(body.name);
    }
    return names;
  }

  [[nodiscard]] std::vector<std::string> bodies_of_impacts() const {
    std::vector<std::string> all{"grains"};
    all.insert(all.end(), surfaces_.begin(), surfaces_.end());
    return all;
  }
  /// As run::LiberationStage tells them.
  [[nodiscard]] std::vector<std::string> causes() const {
    std::vector<std::string> all = bodies_of_impacts();
    if (needs_wind_) all.emplace_back("wind");
    return all;
  }

  const scenario::Setup& setup_;
  const scenario::DustSetup& dust_;
  preflight::SideModelSet sides_;
  std::vector<std::string> classes_;
  std::vector<std::string> hoods_;
  std::vector<std::string> surfaces_;  ///< walls that are sides, and bodies
  bool needs_wind_ = false;
  std::vector<Quantity> all_;
};

}  // namespace

std::vector<Quantity> dust_quantities(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                      const registry::Registry& registry) {
  return DustQuantities(setup, dust, registry).find();
}

}  // namespace dust::study
