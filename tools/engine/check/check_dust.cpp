// SPDX-License-Identifier: Apache-2.0
#include "check/check_dust.hpp"

#include "base/text.hpp"
#include "scenario/text/suggest.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace dust::engine {
namespace {

using preflight::EmissionNumbers;
using scenario::DustSetup;
using scenario::Setup;

/// "0.1, 0.3, 0.5"
template <class Text>
std::string texts_of(const std::vector<double>& values, Text text) {
  std::vector<std::string> words(values.size());
  std::transform(values.begin(), values.end(), words.begin(), text);
  return scenario::listed(words);
}

std::string percent(double share) { return base::digits_text(100.0 * share, 3); }

/// [kg/s] that streams have of a material, and [kg] that comes at once.
struct Amounts {
  double flow = 0.0, at_once = 0.0;
};
Amounts amounts_of(std::span<const EmissionNumbers> emissions, std::size_t material) {
  Amounts amounts;
  for (const EmissionNumbers& e : emissions) {
    if (material < e.stream_shares.size()) {
      amounts.flow += e.mass_flow * e.stream_shares[material];
      amounts.at_once += e.mass_at_once[material];
    }
  }
  return amounts;
}

/// Of each class.
std::vector<double> brought(const scenario::DustLoadSpec& load, double solids) {
  std::vector<double> dust(load.share);
  for (double& of_class : dust) of_class *= solids;
  return dust;
}

void print_loads(std::ostream& out, const Setup& setup, const DustSetup& dust,
                 std::span<const EmissionNumbers> emissions) {
  const sdk::Vec3 edges = setup.domain.max - setup.domain.min;
  for (std::size_t m = 0; m < dust.loads.size(); ++m) {
    const auto& load = dust.loads[m];
    if (load.share.empty()) continue;
    const double all = std::accumulate(load.share.begin(), load.share.end(), 0.0);
    out << "             " << setup.materials[m].name << " carries " << percent(all) << " % of it";
    if (load.share.size() > 1) out << " (" << texts_of(load.share, percent) << " %)";
    if (load.moisture > 0.0) out << " at " << percent(load.moisture) << " % of moisture";
    const Amounts solids = amounts_of(emissions, m);
    const char* before = ": ";
    if (solids.flow > 0.0) {
      out << before
          << base::mass_flow_text(all * solids.flow, std::max({edges.x, edges.y, edges.z}));
      before = ", ";
    }
    if (solids.at_once > 0.0) {
      out << before << base::mass_text(all * solids.at_once) << " at once";
    }
    out << '\n';
  }
}

}  // namespace

std::string dust_text(const Setup& setup, const DustSetup& dust,
                      std::span<const EmissionNumbers> emissions) {
  if (!dust.field) return {};
  std::ostringstream out;
  const auto& sizes = dust.field->diameters;
  out << "  dust       a field of "
      << texts_of(sizes, [](double d) { return base::length_text(d, 3); }) << ", "
      << base::digits_text(dust.field->density, 4) << " kg/m3\n";
  print_loads(out, setup, dust, emissions);
  if (dust.liberation) {
    out << "             set free by " << dust.liberation->name;
    std::vector<std::string> zones;
    for (const scenario::FeedZoneSpec& zone : dust.feed_zones) zones.push_back(zone.name);
    if (!zones.empty()) out << ", but not in " << scenario::listed(zones);
    out << '\n';
  }
  if (dust.given && !dust.given->hoods.empty()) {
    out << "             caught by " << scenario::listed(dust.given->hoods) << '\n';
  }
  return out.str();
}

void add_dust_json(const Setup& setup, const DustSetup& dust,
                   std::span<const EmissionNumbers> emissions, nlohmann::ordered_json& json) {
  if (!dust.field) return;
  json["dust"] = {{"classes_m", dust.field->diameters}};
  for (std::size_t m = 0; m < dust.loads.size(); ++m) {
    if (dust.loads[m].share.empty()) continue;
    const Amounts solids = amounts_of(emissions, m);
    const std::string& name = setup.materials[m].name;
    json["dust"]["brought_kg_per_s"][name] = brought(dust.loads[m], solids.flow);
    json["dust"]["brought_at_once_kg"][name] = brought(dust.loads[m], solids.at_once);
  }
}

}  // namespace dust::engine
