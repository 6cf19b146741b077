// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <nlohmann/json.hpp>

namespace dust::run {

/// The `dust:` block for the report, with numbers for materials and whether each size class of the
/// emitters is dust: {"finer_than_m", "classes_m", "materials", "material_names",
/// "coarse_graining" by material, "hoods", "size_classes": [{"diameter_m",
/// "represented_diameter_m", "is_dust"}]}. Empty without the block.
nlohmann::ordered_json dust_rule_json(const Simulation& s);

/// What a hood has drawn out so far, computed grains with their weights.
struct Drawn {
  double particles = 0.0;   ///< computed ones
  double mass = 0.0;        ///< [kg] of grains
  double dust = 0.0;        ///< [kg] of dust, as grains and of a field
  double field_dust = 0.0;  ///< [kg] of that, of a field
};
Drawn drawn_by(const Simulation& s, std::size_t opening);
/// [kg] Of dust, emitted as grains and released into the air.
double dust_so_far(const Simulation& s);

/// By hood: {"particles", "mass_kg" of them, "dust_kg" as grains and of a field, "dust_g_per_tonne"
/// of all grains released, "dust_kg_per_h", "share_of_dust" released, with a field
/// "field_dust_kg"}; the rates and the share null where nothing was. Amounts in kg count since
/// t = 0, rates and share since the plant is as it is (PlantBegin).
nlohmann::ordered_json hoods_json(const Simulation& s, const RunFacts& facts);

/// What became of the airborne dust: by class {"released_kg", "airborne_kg", "deposited_kg" by
/// surface, "left_kg" by side, "hoods_kg" by hood, "balance_error", with bodies that move
/// "carried_out_kg" by surface, with the drift by inertia "inertia_limited_share", with scavenging
/// "caught_by_grains_kg", with resuspension "resuspended_kg"} and "sub_steps".
nlohmann::ordered_json dust_field_json(const Simulation& s);

/// What grains carry, what of it came off and by what, for a run with loads: by class
/// {"entered_kg", "on_grains_kg", "set_free_kg", "set_free_by" cause {"kg", "kg_per_h",
/// "g_per_tonne"}, "left_with_grains_kg", "drawn_out_with_grains_kg", "balance_error", with
/// scavenging "caught_kg"}, and "kept_back_kg". Rates as in hoods_json.
nlohmann::ordered_json dust_on_grains_json(const Simulation& s, const RunFacts& facts);

/// What practice expects, orders of magnitude beside ours: by "ap42_drop" and material
/// {"moisture", "least_g_per_tonne", "most_g_per_tonne"} finer than 30 um, over the winds 0.6 to
/// 6.7 m/s of the measurements (AP-42, 13.2.4), materials without a moisture left out; with
/// `dust.fall_height` "vdi_3790_3", how much more than from 2 m; with `dust.open_area` and a load
/// that is fed also "induced_air", Anderson's rule, with what went into it.
nlohmann::ordered_json dust_estimates_json(const Simulation& s);

/// A table for the report: what came off grains, by cause and class; nothing without loads.
void add_liberation_table(const Simulation& s, const RunFacts& facts,
                          nlohmann::ordered_json& tables);

/// Tables for the report: what each hood has drawn out, by size.
void add_hood_tables(const Simulation& s, nlohmann::ordered_json& tables);

}  // namespace dust::run
