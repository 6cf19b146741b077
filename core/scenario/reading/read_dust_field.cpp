// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "scenario/reading/setup_reader.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace dust::scenario {
namespace {

/// Dust finer than this share of the smallest grain moves between grains as if they were walls.
constexpr double k_largest_share = 0.1;

}  // namespace

void SetupReader::read_dust_field(MapReader& dust, Node& written) {
  const Entry* entry = dust.optional("field");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "dust.field", entry->where, diagnostics_);
  if (!entry->value.is_map()) return;
  std::vector<sdk::Value> values;
  const auto read = block<DustFieldBlock>(reader, &values);
  const bool is_good = models_.check_references(reader, DustFieldBlock::schema(), values, true);
  DustFieldSpec spec;
  spec.diameters = read.classes;
  const int material = names_.materials.index(read.material);
  if (material >= 0 && static_cast<std::size_t>(material) < setup_.materials.size()) {
    spec.density = setup_.materials[static_cast<std::size_t>(material)].properties.density;
  }
  spec.schmidt_number = read.schmidt_number;
  spec.where = entry->where;
  Node map = written_block<DustFieldBlock>(values);
  map.add("clouds", read_clouds(reader, spec));
  map.add("sources", read_dust_sources(reader, spec));
  reader.finish();
  std::erase_if(map.entries,
                [](const Entry& e) { return e.value.is_map() && e.value.entries.empty(); });
  written.add("field", std::move(map));
  if (!has_fluid_) {
    error(entry->where,
          "dust.field: there is no fluid that carries it: give fluid: {cells: ...} instead of "
          "none, or take dust.field out");
  }
  if (reader.is_good() && is_good) check_dust_field(entry->value, spec);
  if (has_fluid_ && spec.density > 0.0) dust_.field = std::move(spec);
}

Node SetupReader::read_clouds(MapReader& field, DustFieldSpec& spec) {
  Node written = Node::make_map();
  for_each_named(field, "clouds", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, "dust.field." + path, entry.where, diagnostics_);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto read = block<DustCloudBlock>(reader, &values);
    reader.finish();
    if (reader.is_good() && read.concentration.size() != spec.diameters.size()) {
      error(mark_of(entry.value, "concentration"),
            "dust.field." + path + ".concentration: " + std::to_string(read.concentration.size()) +
                " numbers for " + std::to_string(spec.diameters.size()) +
                " classes; give one for each");
    }
    spec.clouds.push_back({entry.key, read.min, read.max, read.concentration});
    written.add(entry.key, written_block<DustCloudBlock>(values));
  });
  return written;
}

Node SetupReader::read_dust_sources(MapReader& field, DustFieldSpec& spec) {
  Node written = Node::make_map();
  for_each_named(field, "sources", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, "dust.field." + path, entry.where, diagnostics_);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto read = block<DustSourceBlock>(reader, &values);
    reader.finish();
    if (reader.is_good() && read.mass_flow.size() != spec.diameters.size()) {
      error(mark_of(entry.value, "mass_flow"),
            "dust.field." + path + ".mass_flow: " + std::to_string(read.mass_flow.size()) +
                " numbers for " + std::to_string(spec.diameters.size()) +
                " classes; give one for each");
    }
    spec.sources.push_back({entry.key, read.min, read.max, read.mass_flow, read.begin, read.end});
    Node map = Node::make_map();
    for (std::size_t n = 0; n < values.size(); ++n) {
      // An end that never comes cannot be written.
      const std::string& name = DustSourceBlock::schema()[n].name;
      if (name != "end" || entry.value.find("end") != nullptr) {
        map.add(name, written_value(values[n]));
      }
    }
    written.add(entry.key, std::move(map));
  });
  return written;
}

void SetupReader::check_dust_field(const Node& node, const DustFieldSpec& spec) {
  if (spec.diameters.empty()) {
    error(mark_of(node, "classes"), "dust.field.classes: is empty; give at least one diameter");
    return;
  }
  for (std::size_t n = 1; n < spec.diameters.size(); ++n) {
    if (spec.diameters[n] > spec.diameters[n - 1]) continue;
    error(mark_of(node, "classes"),
          "dust.field.classes: " + number_text(spec.diameters[n]) + " m does not come after " +
              number_text(spec.diameters[n - 1]) + " m; write them ascending, each once");
  }
  // Dust may be there as grains as well: it is beside these that it counts.
  const DustRule rule = dust_.rule();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < emitters_.size(); ++n) {
    const int material = setup_.emitters[n].material;
    for (const double d : static_cast<const sdk::Emitter&>(*emitters_[n]).diameters()) {
      if (!rule.is_dust(d, material)) smallest = std::min(smallest, rule.represented(d, material));
    }
  }
  const double coarsest = spec.diameters.back();
  if (coarsest > k_largest_share * smallest) {
    error(mark_of(node, "classes"),
          "dust.field.classes: " + number_text(coarsest) +
              " m is more than a tenth of the smallest grain, " + number_text(smallest) +
              " m: dust of that size does not follow the gas between such grains; let it be "
              "grains, or leave the class out");
  }
}

}  // namespace dust::scenario
