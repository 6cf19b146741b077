// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/cohesion_law.hpp"
#include "dust/sdk/emitter.hpp"
#include "scenario/checks.hpp"
#include "scenario/interactions/pair_list.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"

#include <algorithm>

namespace dust::scenario {
namespace {

/// Does the cohesive law fit the materials and the contact law?
void check_laws(Reading& reading, const InteractionSpec& spec, const ReadModel& contact,
                const ReadModel& cohesion) {
  if (!contact.model || !cohesion.model) return;
  const auto& i = reading.setup.materials[static_cast<std::size_t>(spec.material_i)].properties;
  const auto& j = reading.setup.materials[static_cast<std::size_t>(spec.material_j)].properties;
  if (!(i.young_modulus > 0.0 && j.young_modulus > 0.0)) return;  // told where it stands
  auto& law = static_cast<sdk::CohesionLaw&>(*cohesion.model);
  const ModelChoice& choice = *cohesion.choice;
  if (law.needs_hertz_force() && !static_cast<sdk::ContactLaw&>(*contact.model).has_hertz_force()) {
    reading.error(choice.where,
                  choice.path + ": '" + choice.name +
                      "' replaces the Hertz force, which the contact law '" + contact.choice->name +
                      "' does not have: choose another contact law or another cohesion");
  }
  try {
    law.prepare(i, j);
  } catch (const sdk::ParameterError& problem) {
    reading.error(choice.where, choice.path + ": " + problem.what());
  }
}

/// The moisture of a material's block as written; null where there is none.
const Entry* moisture_of(const Reading& reading, const std::string& material) {
  const Entry* materials = reading.root.find("materials");
  const Entry* block = materials == nullptr ? nullptr : materials->value.find(material);
  return block == nullptr ? nullptr : block->value.find("moisture");
}

/// One that cannot be read is the material's mistake, told there once.
bool is_moisture(const Node& written) {
  Diagnostics elsewhere;
  for (const sdk::Parameter& one : MaterialBlock::schema()) {
    if (one.name == "moisture") return read_value(written, one, "", elsewhere).has_value();
  }
  return false;
}

/// Whether the cohesive law `name` has a parameter `moisture`.
bool bridges_by_moisture(const Reading& reading, const Node& name) {
  const auto* law = reading.registry.find(sdk::CohesionLaw::k_kind, name.text);
  if (law == nullptr) return false;
  const sdk::ParameterSchema& all = law->info.parameters;
  return std::any_of(all.begin(), all.end(),
                     [](const sdk::Parameter& one) { return one.name == "moisture"; });
}

/// A law that makes bridges of moisture and is given no liquid takes that of its two materials; one
/// that is given their moisture reads it too.
void take_moisture(Reading& reading, Node& interaction) {
  const Entry* between = interaction.find("between");
  Entry* cohesion = interaction.is_map() ? find(interaction, "cohesion") : nullptr;
  if (between == nullptr || between->value.items.size() != 2 || cohesion == nullptr) return;
  const Entry* model = cohesion->value.find("model");
  if (model == nullptr || !bridges_by_moisture(reading, model->value)) return;
  if (const Entry* given = cohesion->value.find("moisture")) {
    // A run's own scenario.yaml has both.
    for (std::size_t n = 0; n < std::min<std::size_t>(2, given->value.items.size()); ++n) {
      const std::string& material = between->value.items[n].text;
      const Entry* own = moisture_of(reading, material);
      if (given->value.items[n].text == (own == nullptr ? "0" : own->value.text)) {
        reading.bridging.push_back(material);
      }
    }
    return;
  }
  for (const char* given : {"volume", "relative_volume"}) {
    if (cohesion->value.find(given) != nullptr) return;
  }
  Node both = Node::make_list();
  both.where = cohesion->where;
  bool is_given = false;
  for (const Node& material : between->value.items) {
    const Entry* own = moisture_of(reading, material.text);
    if (own != nullptr) {
      is_given = true;
      reading.bridging.push_back(material.text);
    }
    both.items.push_back(own != nullptr && is_moisture(own->value) ? own->value
                                                                   : Node::make_text("0"));
  }
  if (!is_given) return;  // the law says what it needs
  add(cohesion->value, "moisture", std::move(both));
}

Node read_interaction(Reading& reading, const Node& node, const std::string& path) {
  MapReader reader(node, path, node.where, reading.diagnostics);
  std::vector<sdk::Value> values;
  const auto read = block<InteractionBlock>(reader, &values);
  InteractionSpec spec;
  spec.where = node.where;
  bool has_pair = reader.is_good() &&
                  reading.models.check_references(reader, InteractionBlock::schema(), values, true);
  if (reader.is_good() && read.between.size() != 2) {
    reading.error(mark_of(node, "between"), path + ".between: two materials are expected, not " +
                                                std::to_string(read.between.size()));
    has_pair = false;
  }
  Node written = written_block<InteractionBlock>(values);
  // A `like` that is left led nowhere: one mistake, told already.
  const bool is_incomplete = reader.optional("like") != nullptr;
  ReadModel contact = read_part(reading, reader, "contact", !is_incomplete, written);
  ReadModel rolling = read_part(reading, reader, "rolling", false, written);
  ReadModel cohesion = read_part(reading, reader, "cohesion", false, written);
  reader.finish();
  if (!has_pair) {
    reading.pairs_are_read = false;
    return written;
  }
  spec.material_i = reading.names.materials.index(read.between[0]);
  spec.material_j = reading.names.materials.index(read.between[1]);
  for (const InteractionSpec& other : reading.setup.interactions) {
    const bool is_same = std::minmax(other.material_i, other.material_j) ==
                         std::minmax(spec.material_i, spec.material_j);
    if (is_same) {
      reading.error(node.where, path + ": the pair [" + read.between[0] + ", " + read.between[1] +
                                    "] is already given in line " +
                                    std::to_string(other.where.line));
    }
  }
  spec.contact = contact.choice.value_or(ModelChoice{});
  check_laws(reading, spec, contact, cohesion);
  spec.rolling = std::move(rolling.choice);
  spec.cohesion = std::move(cohesion.choice);
  reading.setup.interactions.push_back(std::move(spec));
  return written;
}

/// Warns of a load that makes up much of its material: per cent written as shares.
void check_share_of_dust(Reading& reading, const Entry& material, const std::string& path,
                         const std::vector<double>& load) {
  constexpr double k_much = 0.2;
  double sum = 0.0;
  for (const double share : load) sum += share;
  if (!(sum > k_much)) return;
  reading.diagnostics.warning(mark_of(material.value, "dust_load"),
                              path + ".dust_load: dust is " + number_text(100.0 * sum) +
                                  " % of the material: numbers without a unit are shares of one; "
                                  "write per cent as 0.5 %");
}

/// Warns of more water than bulk solids hold: per cent written as a share.
void check_moisture(Reading& reading, const Entry& material, const std::string& path,
                    double moisture) {
  constexpr double k_much = 0.2;
  if (!(moisture > k_much)) return;
  reading.diagnostics.warning(mark_of(material.value, "moisture"),
                              path + ".moisture: water is " + number_text(100.0 * moisture) +
                                  " % of the dry solids: a number without a unit is a share of "
                                  "one; write per cent as 1 %");
}

}  // namespace

void read_materials(Reading& reading, MapReader& top) {
  Node written = Node::make_map();
  for_each_named(reading, top, "materials", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, path, entry.where, reading.diagnostics);
    std::vector<sdk::Value> values;
    const auto material = block<MaterialBlock>(reader, &values);
    reader.finish();
    reading.setup.materials.push_back(
        {entry.key,
         {material.density, material.young_modulus, material.poisson_ratio},
         material.coarse_graining});
    reading.dust.loads.push_back({material.dust_load, material.moisture});
    check_share_of_dust(reading, entry, path, material.dust_load);
    check_moisture(reading, entry, path, material.moisture);
    Node block = written_block<MaterialBlock>(values);
    // What only dust asks for is not written where there is none.
    if (material.dust_load.empty()) {
      std::erase_if(block.entries, [](const Entry& e) { return e.key == "dust_load"; });
    }
    if (!(material.moisture > 0.0)) {
      std::erase_if(block.entries, [](const Entry& e) { return e.key == "moisture"; });
    }
    add(written, entry.key, std::move(block));
  });
  if (!written.entries.empty()) add(reading.written, "materials", std::move(written));
}

void read_interactions(Reading& reading, MapReader& top) {
  const Entry* entry = top.optional("interactions");
  if (entry == nullptr) return;
  if (!entry->value.is_list()) {
    reading.pairs_are_read = false;
    reading.error(
        entry->value.where,
        "interactions: a list of '- between: [a, b]' is expected, not " + kind_text(entry->value));
    return;
  }
  Node list = entry->value;
  complete_pairs(list, reading.diagnostics);
  for (Node& interaction : list.items) take_moisture(reading, interaction);
  Node written = Node::make_list();
  for (std::size_t n = 0; n < list.items.size(); ++n) {
    written.items.push_back(
        read_interaction(reading, list.items[n], "interactions[" + std::to_string(n) + "]"));
  }
  add(reading.written, "interactions", std::move(written));
}

void read_emitters(Reading& reading, MapReader& top) {
  Node written = Node::make_map();
  for_each_named(reading, top, "emitters", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, path, entry.where, reading.diagnostics);
    if (!entry.value.is_map()) return;
    Placed placed = read_placed(reading, reader);
    ReadModel model = reading.models.read(reader, "model", "emitter", placed.is_enabled);
    reader.finish();
    append(placed.written, std::move(model.written));
    add(written, entry.key, std::move(placed.written));
    if (!placed.is_enabled) return;
    std::vector<int> more;
    if (model.model) {
      for (const auto& name : static_cast<const sdk::Emitter&>(*model.model).materials()) {
        more.push_back(reading.names.materials.index(name));
        if (more.back() >= 0) continue;
        reading.error(entry.where, path + ": its grains are of the material '" + name +
                                       "', and there is none of that name under materials");
      }
      reading.emitters.push_back(std::move(model.model));
    }
    reading.setup.emitters.push_back({.name = entry.key,
                                      .model = model.choice.value_or(ModelChoice{}),
                                      .material = placed.material,
                                      .frame = placed.frame,
                                      .more_materials = std::move(more)});
  });
  if (!written.entries.empty()) add(reading.written, "emitters", std::move(written));
}

}  // namespace dust::scenario
