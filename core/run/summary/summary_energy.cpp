// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary_energy.hpp"

#include <string>

namespace dust::run {

using sdk::RowValue;

void visit_energy(const Simulation& s, const ColumnVisitor& visit) {
  if (!s.setup().audit.energy) return;
  const particles::EnergyBalance b = s.dem().energy();
  const auto energy = sdk::detail(sdk::Quantity::energy);
  const auto add = [&](const char* name, double value, RowValue kind) {
    visit("energy/" + std::string(name) + " [J]", value, kind, energy);
  };
  add("translation", b.translation, RowValue::instant);
  add("rotation", b.rotation, RowValue::instant);
  add("elastic_normal", b.elastic_normal, RowValue::instant);
  add("elastic_friction", b.elastic_friction, RowValue::instant);
  add("entered", b.entered, RowValue::total);
  add("left", b.left, RowValue::total);
  add("gravity", b.gravity, RowValue::total);
  add("walls", b.walls, RowValue::total);
  add("fluid", b.fluid, RowValue::total);
  add("lost_normal", b.lost_normal, RowValue::total);
  add("lost_friction", b.lost_friction, RowValue::total);
  add("lost_rolling", b.lost_rolling, RowValue::total);
  add("error", b.error(), RowValue::instant);
}

nlohmann::ordered_json energy_json(const Simulation& s) {
  const particles::EnergyBalance b = s.dem().energy();
  return {{"kinetic_J", {{"translation", b.translation}, {"rotation", b.rotation}}},
          {"elastic_J", {{"normal", b.elastic_normal}, {"friction", b.elastic_friction}}},
          {"work_J", {{"gravity", b.gravity}, {"walls", b.walls}, {"fluid", b.fluid}}},
          {"lost_J",
           {{"normal", b.lost_normal}, {"friction", b.lost_friction}, {"rolling", b.lost_rolling}}},
          {"entered_J", b.entered},
          {"left_J", b.left},
          {"error_J", b.error()},
          {"relative_error", b.relative_error()}};
}

void add_energy_table(const Simulation& s, nlohmann::ordered_json& tables) {
  if (!s.setup().audit.energy) return;
  const particles::EnergyBalance b = s.dem().energy();
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  nlohmann::ordered_json row = nlohmann::ordered_json::array();
  const auto add = [&](const char* name, double value) {
    columns.push_back(std::string(name) + " [J]");
    row.push_back(value);
  };
  add("came with grains", b.entered);
  add("went with grains", b.left);
  add("gravity", b.gravity);
  add("walls", b.walls);
  add("fluid", b.fluid);
  add("lost by damping", b.lost_normal);
  add("by friction", b.lost_friction);
  add("by rolling", b.lost_rolling);
  add("kinetic", b.translation + b.rotation);
  add("elastic", b.elastic_normal + b.elastic_friction);
  add("missed", b.error());
  tables.push_back({{"sensor", "energy"},
                    {"title", "Energy of the grains"},
                    {"columns", columns},
                    {"rows", nlohmann::ordered_json::array({row})}});
}

}  // namespace dust::run
