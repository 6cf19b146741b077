// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "setup/draws_out.hpp"

#include <algorithm>
#include <limits>

namespace dust::scenario {
namespace {

/// Where the n-th name of a list stands; the list's own place if it is written otherwise.
Mark mark_of_item(const Node& map, const char* key, std::size_t n) {
  const Entry* entry = map.find(key);
  if (entry == nullptr) return map.where;
  return n < entry->value.items.size() ? entry->value.items[n].where : entry->value.where;
}

std::string path_of_item(const char* key, std::size_t n) {
  return std::string("dust.") + key + "[" + std::to_string(n) + "]: ";
}

/// Says what came in place of `dust.openings`. A run's own scenario.yaml of before has it empty.
void refuse_openings(Reading& reading, MapReader& reader, const Node& dust) {
  if (dust.find("openings") == nullptr) return;
  const Entry& entry = *reader.optional("openings");
  if (entry.value.is_list() && entry.value.items.empty()) return;
  reading.error(entry.where,
                "dust.openings: had no effect and is gone: what gets out is what sensors with a "
                "role say: give the plane_flux `role: opening`, and take openings out");
}

/// One whose flow could not be read is told so already.
bool is_refused(const Reading& reading, const std::string& hood) {
  return reading.diagnostics.has_error_below("bodies." + hood) ||
         reading.diagnostics.has_error_below("domain.boundaries." + hood);
}

std::vector<std::string> known_hoods(Reading& reading, const Node& node,
                                     const std::vector<std::string>& hoods) {
  std::vector<std::string> able;
  for (const BodySpec& body : reading.setup.bodies) {
    if (body.suction && draws_out(*body.suction)) able.push_back(body.name);
  }
  for (const SideOpeningSpec& opening : reading.dust.openings) {
    able.emplace_back(k_side_names[static_cast<std::size_t>(opening.side)]);
  }
  std::vector<std::string> known;
  for (std::size_t n = 0; n < hoods.size(); ++n) {
    if (std::find(able.begin(), able.end(), hoods[n]) != able.end()) {
      known.push_back(hoods[n]);
    } else if (!reading.names.bodies.is_disabled(hoods[n]) && !is_refused(reading, hoods[n])) {
      reading.error(mark_of_item(node, "hoods", n),
                    path_of_item("hoods", n) + scenario::in_quotes(hoods[n]) +
                        " extracts nothing: a hood is a body with suction, of a flow above 0, or a "
                        "side whose air draws out" +
                        (able.empty() ? std::string() : suggestion(hoods[n], able, "there are")));
    }
  }
  return known;
}

DustSpec dust_spec_of(Reading& reading, const Entry& entry, const DustBlock& read, bool has_field) {
  const bool says_nothing =
      read.finer_than == 0.0 && read.classes.empty() && read.materials.empty();
  if (says_nothing && !has_field) {
    reading.error(entry.where,
                  "dust: says of no grain that it is dust: give finer_than, classes or "
                  "materials");
  }
  DustSpec spec;
  // A field alone leaves grains to the usual rule.
  spec.finer_than = read.finer_than > 0.0 ? read.finer_than
                    : says_nothing        ? DustRule::k_usual_limit
                                          : std::numeric_limits<double>::infinity();
  spec.classes = read.classes;
  for (const std::string& name : read.materials) {
    spec.materials.push_back(reading.names.materials.index(name));
  }
  spec.hoods = known_hoods(reading, entry.value, read.hoods);
  spec.steady_after = read.steady_after;
  spec.fall_height = read.fall_height;
  spec.open_area = read.open_area;
  if (spec.open_area > 0.0 && !(spec.fall_height > 0.0)) {
    reading.error(entry.where,
                  "dust.open_area: the rule of induced air takes the height of fall too: give "
                  "fall_height, or take open_area out");
  }
  return spec;
}

void check_dust_is_emitted(Reading& reading, const Mark& where) {
  const DustRule rule = reading.dust.rule();
  std::size_t sizes = 0;
  double finest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < reading.emitters.size(); ++n) {
    std::vector<int> materials = reading.setup.emitters[n].more_materials;
    materials.push_back(reading.setup.emitters[n].material);
    for (const double d : static_cast<const sdk::Emitter&>(*reading.emitters[n]).diameters()) {
      for (const int m : materials) {
        ++sizes;
        if (rule.is_dust(d, m)) return;
        finest = std::min(finest, rule.represented(d, m));
      }
    }
  }
  if (sizes == 0) return;
  reading.diagnostics.warning(where,
                              "dust: no grain of any emitter is dust by this rule; the finest "
                              "stands for grains of " +
                                  number_text(finest) + " m");
}

}  // namespace

void read_dust(Reading& reading, MapReader& top) {
  for (const MaterialSpec& material : reading.setup.materials) {
    reading.dust.coarse_graining.push_back(material.coarse_graining);
  }
  const Entry* entry = top.optional("dust");
  if (entry == nullptr) {
    check_dust_loads(reading, nullptr);
    return;
  }
  MapReader reader(entry->value, "dust", entry->where, reading.diagnostics);
  if (!entry->value.is_map()) return;
  std::vector<sdk::Value> values;
  const auto read = block<DustBlock>(reader, &values);
  refuse_openings(reading, reader, entry->value);
  const bool is_good = reading.models.check_references(reader, DustBlock::schema(), values, true);
  const bool has_field = entry->value.find("field") != nullptr;
  if (reader.is_good() && is_good)
    reading.dust.given = dust_spec_of(reading, *entry, read, has_field);
  check_begin_of_means("dust.steady_after", read.steady_after, reading.setup.time.end,
                       mark_of(entry->value, "steady_after"), reading.diagnostics);
  Node written = written_block<DustBlock>(values);
  read_dust_field(reading, reader, written);
  read_liberation(reading, reader, written);
  reader.finish();
  add(reading.written, "dust", std::move(written));
  if (reading.dust.given && !has_field && !reading.diagnostics.has_errors())
    check_dust_is_emitted(reading, entry->where);
}

}  // namespace dust::scenario
