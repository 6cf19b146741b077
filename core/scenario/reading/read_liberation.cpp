// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "dust/sdk/liberation_law.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace dust::scenario {

namespace {

/// Whether the box has a volume and part of it lies in the domain.
bool is_box_in_domain(const scenario::FeedZoneSpec& zone, const DomainSpec& domain) {
  const auto overlaps = [](double low, double high, double from, double to) {
    return low < high && low < to && high > from;
  };
  return overlaps(zone.min.x, zone.max.x, domain.min.x, domain.max.x) &&
         overlaps(zone.min.y, zone.max.y, domain.min.y, domain.max.y) &&
         overlaps(zone.min.z, zone.max.z, domain.min.z, domain.max.z);
}

/// Loads that could not be read are told so already.
bool is_any_load_refused(const Reading& reading) {
  return std::any_of(
      reading.setup.materials.begin(), reading.setup.materials.end(), [&](const MaterialSpec& m) {
        return reading.diagnostics.has_error_below("materials." + m.name + ".dust_load");
      });
}

void read_feed_zones(Reading& reading, MapReader& dust, Node& written) {
  Node zones = Node::make_map();
  for_each_named(reading, dust, "feed_zones", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, "dust." + path, entry.where, reading.diagnostics);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto read = block<FeedZoneBlock>(reader, &values);
    reader.finish();
    const FeedZoneSpec zone{entry.key, read.min, read.max};
    if (reader.is_good() && reading.has_domain && !is_box_in_domain(zone, reading.setup.domain)) {
      reading.error(entry.where, "dust." + path +
                                     ": no part of the box lies in the domain; min is its lower "
                                     "corner, max its upper one");
    }
    reading.dust.feed_zones.push_back(zone);
    add(zones, entry.key, written_block<FeedZoneBlock>(values));
  });
  if (!zones.entries.empty()) add(written, "feed_zones", std::move(zones));
}

/// Whether there is a dust.field, right or wrong.
bool asks_for_field(const Reading& reading) {
  const Entry* dust = reading.root.find("dust");
  return dust != nullptr && dust->value.find("field") != nullptr;
}

}  // namespace

void read_liberation(Reading& reading, MapReader& dust, Node& written) {
  read_feed_zones(reading, dust, written);
  const Entry* entry = dust.optional("liberation");
  if (const Entry* zones = dust.optional("feed_zones"); zones != nullptr && entry == nullptr) {
    reading.error(zones->where,
                  "dust.feed_zones: nothing comes off grains anywhere: give dust: {liberation: "
                  "{model: energy, ...}}, or take feed_zones out");
  }
  ReadModel law;
  if (entry != nullptr) law = read_part(reading, dust, "liberation", false, written);
  check_dust_loads(reading, law.model.get(), entry == nullptr || law.model != nullptr);
  if (!law.choice) return;
  const Mark where = law.choice->where;
  if (!reading.dust.field && reading.has_fluid && dust.optional("field") == nullptr) {
    reading.error(where,
                  "dust.liberation: there is no dust.field that takes up what comes off: give "
                  "dust: {field: {classes: [...], material: ...}}");
  }
  const bool has_load = std::any_of(reading.dust.loads.begin(), reading.dust.loads.end(),
                                    [](const DustLoadSpec& load) { return !load.share.empty(); });
  if (!has_load && !is_any_load_refused(reading)) {
    reading.error(where,
                  "dust.liberation: no material has a dust_load that could come off: give "
                  "materials: {...: {dust_load: [...]}}, or take dust.liberation out");
  }
  reading.dust.liberation = std::move(law.choice);
}

void check_dust_loads(Reading& reading, const sdk::Model* law, bool is_law_read) {
  const Entry* materials = reading.root.find("materials");
  if (materials == nullptr || !materials->value.is_map()) return;
  const bool binds = law != nullptr && static_cast<const sdk::LiberationLaw*>(law)->uses_moisture();
  for (std::size_t m = 0; m < reading.dust.loads.size() && m < materials->value.entries.size();
       ++m) {
    const Entry& material = materials->value.entries[m];
    const std::string path = "materials." + material.key;
    const DustLoadSpec& load = reading.dust.loads[m];
    const bool bridges = std::find(reading.bridging.begin(), reading.bridging.end(),
                                   material.key) != reading.bridging.end();
    if (load.moisture > 0.0 && !binds && !bridges && is_law_read) {
      reading.error(mark_of(material.value, "moisture"),
                    path + ".moisture: " +
                        (law == nullptr ? "there is no dust.liberation that makes anything"
                                        : "the law of dust.liberation makes nothing") +
                        " of it: give a law that reads it (energy, force_ratio, shear), or an "
                        "interaction with cohesion: {model: liquid_bridge, ...} that gives no "
                        "volume of its own, or take moisture out");
    }
    if (load.share.empty()) continue;
    const Mark where = mark_of(material.value, "dust_load");
    const double sum = std::accumulate(load.share.begin(), load.share.end(), 0.0);
    if (sum > 1.0) {
      reading.error(where, path + ".dust_load: the shares of the classes make " +
                               base::digits_text(100.0 * sum, 4) +
                               " % of the grain; they are part of its mass: give at most 100 %");
    }
    if (!reading.has_fluid) {
      reading.error(where,
                    path +
                        ".dust_load: there is no fluid that takes dust up: give fluid: {cells: "
                        "...} instead of none, or take dust_load out");
    } else if (!asks_for_field(reading)) {
      reading.error(where,
                    path +
                        ".dust_load: there is no dust.field whose classes it could mean: give "
                        "dust: {field: {classes: [...], material: ...}, liberation: {model: "
                        "energy, ...}}, or take dust_load out");
    } else if (!reading.dust.field || reading.dust.field->diameters.empty()) {
      continue;  // told where the field stands
    } else if (load.share.size() != reading.dust.field->diameters.size()) {
      reading.error(where, path + ".dust_load: " + std::to_string(load.share.size()) +
                               " numbers for " +
                               std::to_string(reading.dust.field->diameters.size()) +
                               " classes of dust.field; give one for each");
    } else if (law == nullptr && is_law_read) {
      reading.diagnostics.warning(where,
                                  path +
                                      ".dust_load: stays on the grains: give dust: {liberation: "
                                      "{model: energy, ...}} for it to come off");
    }
  }
}

}  // namespace dust::scenario
