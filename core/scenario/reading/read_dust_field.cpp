// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace dust::scenario {
namespace {

/// Dust finer than this share of the smallest grain moves between grains as if they were walls.
constexpr double k_largest_share = 0.1;
/// Of what walls and grains do to dust beyond settling.
constexpr std::array<std::string_view, 6> k_unasked = {
    "inertia", "scavenging", "resuspension", "emission_coefficient", "cohesion", "deposition"};

/// A box of dust, which may be flat, of which part lies in the domain.
void check_box(Reading& reading, const Node& given, const std::string& path, sdk::Vec3 min,
               sdk::Vec3 max) {
  static constexpr const char* k_axes[] = {"x", "y", "z"};
  const DomainSpec& domain = reading.setup.domain;
  for (int d = 0; d < 3; ++d) {
    const std::string axis = k_axes[d];
    if (min[d] > max[d]) {
      reading.error(mark_of(given, "min"),
                    path + ": min is above max in " + axis + ": " + number_text(min[d]) +
                        " m and " + number_text(max[d]) +
                        " m; give the lower corner of the box as min, the upper one as max");
      return;
    }
    // Of a domain that is wrong, it is told there.
    if (!reading.has_domain) return;
    const bool is_flat = min[d] == max[d];
    if (is_flat ? min[d] >= domain.min[d] && max[d] <= domain.max[d]
                : min[d] < domain.max[d] && max[d] > domain.min[d]) {
      continue;
    }
    reading.error(mark_of(given, "min"),
                  path + ": no part of the box lies in the domain: in " + axis +
                      " it reaches from " + number_text(min[d]) + " to " + number_text(max[d]) +
                      " m, the domain from " + number_text(domain.min[d]) + " to " +
                      number_text(domain.max[d]) + " m; give min and max in it, with their unit");
    return;
  }
}

/// When a source gives dust.
void check_times(Reading& reading, const Node& given, const std::string& path, double begin,
                 double end) {
  const auto seconds = [](double time) { return number_text(time) + " s"; };
  if (!(begin < end)) {
    reading.error(mark_of(given, given.find("end") != nullptr ? "end" : "begin"),
                  path + ".end: " + seconds(end) + " is not after begin, " + seconds(begin) +
                      ": no dust would come; give a later end or an earlier begin");
  } else if (reading.setup.time.end > 0.0 && !(begin < reading.setup.time.end)) {
    reading.diagnostics.warning(mark_of(given, "begin"),
                                path + ".begin: " + seconds(begin) + " is not before time.end, " +
                                    seconds(reading.setup.time.end) +
                                    ": no dust comes; give an earlier begin or a later end");
  }
}

Node read_clouds(Reading& reading, MapReader& field, DustFieldSpec& spec) {
  Node written = Node::make_map();
  for_each_named(reading, field, "clouds", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, "dust.field." + path, entry.where, reading.diagnostics);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto read = block<DustCloudBlock>(reader, &values);
    reader.finish();
    if (reader.is_good() && read.concentration.size() != spec.diameters.size()) {
      reading.error(mark_of(entry.value, "concentration"),
                    "dust.field." + path + ".concentration: " +
                        std::to_string(read.concentration.size()) + " numbers for " +
                        std::to_string(spec.diameters.size()) + " classes; give one for each");
    }
    if (reader.is_good()) {
      check_box(reading, entry.value, "dust.field." + path, read.min, read.max);
    }
    spec.clouds.push_back({entry.key, read.min, read.max, read.concentration});
    add(written, entry.key, written_block<DustCloudBlock>(values));
  });
  return written;
}

Node read_dust_sources(Reading& reading, MapReader& field, DustFieldSpec& spec) {
  Node written = Node::make_map();
  for_each_named(reading, field, "sources", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, "dust.field." + path, entry.where, reading.diagnostics);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto read = block<DustSourceBlock>(reader, &values);
    reader.finish();
    if (reader.is_good() && read.mass_flow.size() != spec.diameters.size()) {
      reading.error(mark_of(entry.value, "mass_flow"),
                    "dust.field." + path + ".mass_flow: " + std::to_string(read.mass_flow.size()) +
                        " numbers for " + std::to_string(spec.diameters.size()) +
                        " classes; give one for each");
    }
    if (reader.is_good()) {
      check_box(reading, entry.value, "dust.field." + path, read.min, read.max);
      check_times(reading, entry.value, "dust.field." + path, read.begin, read.end);
    }
    spec.sources.push_back({entry.key, read.min, read.max, read.mass_flow, read.begin, read.end});
    Node map = Node::make_map();
    for (std::size_t n = 0; n < values.size(); ++n) {
      // An end that never comes cannot be written.
      const std::string& name = DustSourceBlock::schema()[n].name;
      if (name != "end" || entry.value.find("end") != nullptr) {
        add(map, name, written_value(values[n]));
      }
    }
    add(written, entry.key, std::move(map));
  });
  return written;
}

/// Sinks and sources that a scenario does not name are not written out either.
void leave_out_unasked(const Node& given, Node& written) {
  std::erase_if(written.entries, [&](const Entry& e) {
    return std::find(k_unasked.begin(), k_unasked.end(), e.key) != k_unasked.end() &&
           given.find(e.key) == nullptr;
  });
}

void check_dust_field(Reading& reading, const Node& node, const DustFieldSpec& spec) {
  if (spec.diameters.empty()) {
    reading.error(mark_of(node, "classes"),
                  "dust.field.classes: is empty; give at least one diameter");
    return;
  }
  for (std::size_t n = 1; n < spec.diameters.size(); ++n) {
    if (spec.diameters[n] > spec.diameters[n - 1]) continue;
    reading.error(mark_of(node, "classes"),
                  "dust.field.classes: " + number_text(spec.diameters[n]) +
                      " m does not come after " + number_text(spec.diameters[n - 1]) +
                      " m; write them ascending, each once");
  }
  // Dust may be there as grains as well: it is beside these that it counts.
  const DustRule rule = reading.dust.rule();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < reading.emitters.size(); ++n) {
    const int material = reading.setup.emitters[n].material;
    for (const double d : static_cast<const sdk::Emitter&>(*reading.emitters[n]).diameters()) {
      if (!rule.is_dust(d, material)) smallest = std::min(smallest, rule.represented(d, material));
    }
  }
  const double coarsest = spec.diameters.back();
  if (coarsest > k_largest_share * smallest) {
    reading.error(
        mark_of(node, "classes"),
        "dust.field.classes: " + number_text(coarsest) +
            " m is more than a tenth of the smallest grain, " + number_text(smallest) +
            " m: dust of that size does not follow the gas between such grains; let it be "
            "grains, or leave the class out");
  }
}

/// What grains and walls do to dust beyond settling, where it cannot be.
void check_exchange(Reading& reading, const Node& node, const DustFieldSpec& spec) {
  if (spec.scavenging && reading.emitters.empty()) {
    reading.error(
        mark_of(node, "scavenging"),
        "dust.field.scavenging: there are no grains that could catch dust: give emitters, "
        "or take scavenging out");
  }
  if (spec.resuspension && !(norm(reading.setup.gravity) > 0.0)) {
    reading.error(mark_of(node, "resuspension"),
                  "dust.field.resuspension: its threshold is not known without gravity; give "
                  "gravity, or take resuspension out");
  }
  if (spec.resuspension) return;
  for (const char* key : {"emission_coefficient", "cohesion"}) {
    if (node.find(key) == nullptr) continue;
    reading.error(mark_of(node, key), std::string("dust.field.") + key +
                                          ": nothing takes dust off walls: give resuspension: "
                                          "true, or take " +
                                          key + " out");
  }
}

}  // namespace

void read_dust_field(Reading& reading, MapReader& dust, Node& written) {
  const Entry* entry = dust.optional("field");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "dust.field", entry->where, reading.diagnostics);
  if (!entry->value.is_map()) return;
  std::vector<sdk::Value> values;
  const auto read = block<DustFieldBlock>(reader, &values);
  const bool is_good =
      reading.models.check_references(reader, DustFieldBlock::schema(), values, true);
  DustFieldSpec spec;
  spec.diameters = read.classes;
  const int material = reading.names.materials.index(read.material);
  if (material >= 0 && static_cast<std::size_t>(material) < reading.setup.materials.size()) {
    spec.density = reading.setup.materials[static_cast<std::size_t>(material)].properties.density;
  }
  spec.schmidt_number = read.schmidt_number;
  spec.inertia = read.inertia;
  spec.scavenging = read.scavenging;
  if (read.resuspension) spec.resuspension = {read.emission_coefficient, read.cohesion};
  spec.has_smooth_walls = read.deposition == "lai_nazaroff";
  spec.where = entry->where;
  Node map = written_block<DustFieldBlock>(values);
  leave_out_unasked(entry->value, map);
  add(map, "clouds", read_clouds(reading, reader, spec));
  add(map, "sources", read_dust_sources(reading, reader, spec));
  reader.finish();
  std::erase_if(map.entries,
                [](const Entry& e) { return e.value.is_map() && e.value.entries.empty(); });
  add(written, "field", std::move(map));
  if (!reading.has_fluid) {
    reading.error(
        entry->where,
        "dust.field: there is no fluid that carries it: give fluid: {cells: ...} instead of "
        "none, or take dust.field out");
  }
  if (reading.setup.fluid && !reading.setup.fluid->regions.empty()) {
    reading.error(
        entry->where,
        "dust.field: the dust settles, drifts and diffuses as in one fluid, and "
        "fluid.regions has " +
            std::to_string(reading.setup.fluid->regions.size()) +
            " of another: take fluid.regions or dust.field out, or let the dust be grains, "
            "which know the fluid by place");
  }
  if (reader.is_good() && is_good) check_dust_field(reading, entry->value, spec);
  check_exchange(reading, entry->value, spec);
  // Also where its material is wrong, which is told there: what else it says counts.
  if (reading.has_fluid) reading.dust.field = std::move(spec);
}

}  // namespace dust::scenario
