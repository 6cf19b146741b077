// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "scenario/reading/setup_reader.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"

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

}  // namespace

void SetupReader::read_dust(MapReader& top) {
  for (const MaterialSpec& material : setup_.materials) {
    dust_.coarse_graining.push_back(material.coarse_graining);
  }
  const Entry* entry = top.optional("dust");
  if (entry == nullptr) {
    check_dust_loads(nullptr);
    return;
  }
  MapReader reader(entry->value, "dust", entry->where, diagnostics_);
  if (!entry->value.is_map()) return;
  std::vector<sdk::Value> values;
  const auto read = block<DustBlock>(reader, &values);
  const bool is_good = models_.check_references(reader, DustBlock::schema(), values, true);
  const bool has_field = entry->value.find("field") != nullptr;
  if (reader.is_good() && is_good) dust_.given = dust_spec_of(*entry, read, has_field);
  Node written = written_block<DustBlock>(values);
  read_dust_field(reader, written);
  read_liberation(reader, written);
  reader.finish();
  out_.add("dust", std::move(written));
  if (dust_.given && !has_field && !diagnostics_.has_errors()) check_dust_is_emitted(entry->where);
}

DustSpec SetupReader::dust_spec_of(const Entry& entry, const DustBlock& read, bool has_field) {
  const bool says_nothing =
      read.finer_than == 0.0 && read.classes.empty() && read.materials.empty();
  if (says_nothing && !has_field) {
    error(entry.where,
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
    spec.materials.push_back(names_.materials.index(name));
  }
  spec.openings = enabled_openings(entry.value, read.openings);
  spec.hoods = known_hoods(entry.value, read.hoods);
  return spec;
}

std::vector<std::string> SetupReader::enabled_openings(const Node& node,
                                                       const std::vector<std::string>& sensors) {
  std::vector<std::string> all;
  std::vector<std::string> enabled;
  for (const SensorFigures& sensor : figures_) all.push_back(sensor.sensor);
  for (std::size_t n = 0; n < sensors.size(); ++n) {
    const auto found =
        std::find_if(figures_.begin(), figures_.end(),
                     [&](const SensorFigures& sensor) { return sensor.sensor == sensors[n]; });
    if (found == figures_.end()) {
      error(mark_of_item(node, "openings", n), path_of_item("openings", n) + "there is no sensor " +
                                                   scenario::quoted(sensors[n]) +
                                                   suggestion(sensors[n], all, "there are"));
    } else if (found->is_enabled) {
      enabled.push_back(sensors[n]);
    }
  }
  return enabled;
}

std::vector<std::string> SetupReader::known_hoods(const Node& node,
                                                  const std::vector<std::string>& hoods) {
  std::vector<std::string> able;
  for (const BodySpec& body : setup_.bodies) {
    if (body.suction) able.push_back(body.name);
  }
  for (const SideOpeningSpec& opening : dust_.openings) {
    able.emplace_back(k_side_names[static_cast<std::size_t>(opening.side)]);
  }
  std::vector<std::string> known;
  for (std::size_t n = 0; n < hoods.size(); ++n) {
    if (std::find(able.begin(), able.end(), hoods[n]) != able.end()) {
      known.push_back(hoods[n]);
    } else if (!names_.bodies.is_disabled(hoods[n])) {
      error(mark_of_item(node, "hoods", n),
            path_of_item("hoods", n) + scenario::quoted(hoods[n]) +
                " extracts nothing: a hood is a body with suction or a side whose air draws out" +
                (able.empty() ? std::string() : suggestion(hoods[n], able, "there are")));
    }
  }
  return known;
}

void SetupReader::check_dust_is_emitted(const Mark& where) {
  const DustRule rule = dust_.rule();
  std::size_t sizes = 0;
  double finest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < emitters_.size(); ++n) {
    std::vector<int> materials = setup_.emitters[n].more_materials;
    materials.push_back(setup_.emitters[n].material);
    for (const double d : static_cast<const sdk::Emitter&>(*emitters_[n]).diameters()) {
      for (const int m : materials) {
        ++sizes;
        if (rule.is_dust(d, m)) return;
        finest = std::min(finest, rule.represented(d, m));
      }
    }
  }
  if (sizes == 0) return;
  diagnostics_.warning(where,
                       "dust: no grain of any emitter is dust by this rule; the finest "
                       "stands for grains of " +
                           number_text(finest) + " m");
}

}  // namespace dust::scenario
