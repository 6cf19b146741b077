// SPDX-License-Identifier: Apache-2.0
#include "study/quantities.hpp"

#include "base/error.hpp"
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/sensor.hpp"
#include "preflight/places/sensor_look.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "setup/force_kinds.hpp"
#include "study/dust_quantities.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace dust::study {
namespace {

/// Figures of summary.json that every run has, those of runs with a fluid, and those with a fluid
/// and grains.
struct Named {
  const char* path;
  const char* unit;
};
constexpr Named k_always[] = {
    {"threads", "1"},
    {"wall_s", "s"},
    {"cpu_s", "s"},
    {"peak_rss_bytes", "B"},
    {"huge_page_bytes", "B"},
    {"simulated_s", "s"},
    {"dem_step_s", "s"},
    {"dem_steps", "1"},
    {"fluid_steps", "1"},
    {"particle_steps", "1"},
    {"fine_particle_steps", "1"},
    {"neighbour_rebuilds", "1"},
    {"contacts", "1"},
    {"particles.emitted", "1"},
    {"particles.in_domain", "1"},
    {"particles.left", "1"},
    {"particles.removed", "1"},
    {"particles.max", "1"},
    {"real_particles.emitted", "1"},
    {"real_particles.in_domain", "1"},
    {"real_particles.left", "1"},
    {"real_particles.removed", "1"},
    {"real_particles.max", "1"},
    {"mass_kg.emitted", "kg"},
    {"mass_kg.in_domain", "kg"},
    {"mass_kg.left", "kg"},
    {"mass_kg.removed", "kg"},
    {"health.entries_delayed", "1"},
    {"health.entries_waiting", "1"},
    {"health.contacts_seen_late", "1"},
    {"health.largest_overlap_over_radius", "1"},
    {"health.largest_overlap_over_radius_coarse", "1"},
    {"health.largest_overlap_over_radius_fine", "1"},
    {"frames", "1"},
    {"forces.samples", "1"},
};
/// Of each kind of forces on grains.
constexpr Named k_of_force[] = {{"share", "1"}, {"over_weight", "1"}};
constexpr Named k_with_fluid[] = {
    {"health.last_divergence_per_s", "1/s"},
    {"health.last_courant_number", "1"},
    {"health.fluid_sub_steps", "1"},
    {"health.pressure_iterations", "1"},
};
constexpr Named k_with_coupling[] = {
    {"health.voidage_shares_moved_to_open_cells", "1"},
    {"health.voidage_cells_relieved", "1"},
    {"health.grains_without_open_cell", "1"},
    {"health.drag_components_without_open_face", "1"},
    {"health.smallest_void_fraction", "1"},
    {"health.largest_diameter_over_spacing", "1"},
    {"health.limit_of_diameter_over_spacing", "1"},
    {"health.largest_momentum_imbalance", "1"},
};
constexpr Named k_with_resolved[] = {
    {"health.resolved_spheres", "1"},
    {"health.resolved_markers", "1"},
    {"health.resolved_least_cells_across", "1"},
    {"health.resolved_largest_slip_m_per_s", "m/s"},
};
constexpr Named k_of_emitter[] = {
    {"achieved.mass_kg", "kg"}, {"achieved.computed", "1"}, {"achieved.real", "1"},
    {"waiting", "1"},           {"number_of_sizes", "1"},
};

std::string dotted(std::string path) {
  std::replace(path.begin(), path.end(), '/', '.');
  return path;
}

class NamesOnly final : public sdk::FigureSink {
 public:
  NamesOnly(std::vector<Quantity>& all, std::string prefix)
      : all_(all), prefix_(std::move(prefix)) {}
  void figure(std::string_view name, double, std::string_view unit, double,
              const sdk::FigureRole&) override {
    all_.push_back({prefix_ + dotted(std::string(name)), std::string(unit), true, {}});
  }

 private:
  std::vector<Quantity>& all_;
  std::string prefix_;
};

std::vector<double> diameters_of(const scenario::Setup& setup, const registry::Registry& registry) {
  std::vector<double> all;
  for (const auto& spec : setup.emitters) {
    const auto emitter = registry.create_as<sdk::Emitter>(spec.model);
    const auto some = emitter->diameters();
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void collect(const nlohmann::json& node, const std::string& path,
             std::map<std::string, Figure>& figures) {
  if (node.is_number()) {
    figures[path] = {node.get<double>(), -1.0, {}, {}};
  } else if (node.is_object()) {
    for (const auto& item : node.items()) {
      collect(item.value(), path.empty() ? item.key() : path + "." + item.key(), figures);
    }
  }
}

std::optional<scenario::Unit> unit_of(const std::string& text) {
  if (text.empty() || text == "1" || text == "-") return scenario::Unit{};
  return scenario::parse_unit(text);
}

}  // namespace

std::vector<Quantity> quantities_of(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry) {
  std::vector<Quantity> all;
  const auto add = [&](const auto& names, const std::string& prefix = {}) {
    for (const Named& n : names) all.push_back({prefix + n.path, n.unit, false, {}});
  };
  add(k_always);
  for (const char* kind : scenario::k_force_names)
    add(k_of_force, std::string("forces.kinds.") + kind + ".");
  if (setup.fluid) add(k_with_fluid);
  if (setup.drag && setup.voidage) add(k_with_coupling);
  if (setup.fluid && !setup.fluid->resolved.empty()) add(k_with_resolved);
  for (const auto& emitter : setup.emitters) add(k_of_emitter, "emitters." + emitter.name + ".");
  const std::vector<Quantity> of_dust = dust_quantities(setup, dust, registry);
  all.insert(all.end(), of_dust.begin(), of_dust.end());

  const std::vector<double> classes = diameters_of(setup, registry);
  const sdk::WorldView world = preflight::empty_world(setup, classes);
  for (const auto& spec : setup.sensors) {
    const auto sensor = registry.create_as<sdk::Sensor>(spec.model);
    sensor->observe(world);
    NamesOnly names(all, "sensors." + spec.name + ".");
    sensor->summary(names);
  }
  return all;
}

const Quantity* find_quantity(const std::vector<Quantity>& all, const std::string& path) {
  const std::string wanted = dotted(path);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.path == wanted; });
  return found == all.end() ? nullptr : &*found;
}

std::string quantity_hint(const std::vector<Quantity>& all, const std::string& path) {
  const std::string wanted = dotted(path);
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Quantity& q : all) names.push_back(q.path);
  const std::string near = scenario::nearest(wanted, names);
  if (!near.empty()) return "; did you mean '" + near + "'?";
  // The longest part of the path that exists, and what comes behind it.
  for (std::size_t end = wanted.rfind('.'); end != std::string::npos && end > 0;
       end = wanted.rfind('.', end - 1)) {
    const std::string prefix = wanted.substr(0, end + 1);
    std::vector<std::string> next;
    for (const std::string& name : names) {
      if (!name.starts_with(prefix)) continue;
      std::string part = name.substr(prefix.size());
      part = part.substr(0, part.find('.'));
      if (std::find(next.begin(), next.end(), part) == next.end()) next.push_back(part);
    }
    if (!next.empty()) {
      const std::string rest = wanted.substr(prefix.size());
      return scenario::suggestion(rest.substr(0, rest.find('.')), next,
                                  wanted.substr(0, end) + " has");
    }
  }
  return "; quantities begin with sensors, particles, mass_kg, health, emitters, ...";
}

std::optional<double> unit_factor(const std::string& from, const std::string& to) {
  if (from == to || to.empty()) return 1.0;
  const auto a = unit_of(from);
  const auto b = unit_of(to);
  if (!a || !b || !(a->dimension == b->dimension)) return std::nullopt;
  return a->numerator / a->denominator * b->denominator / b->numerator;
}

std::map<std::string, Figure> read_figures(const std::filesystem::path& summary) {
  std::ifstream stream(summary, std::ios::binary);
  nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    throw base::RunError(summary.string() + " cannot be read");
  }
  std::map<std::string, Figure> figures;
  const auto take = [&](const std::string& prefix, const nlohmann::json& of) {
    for (const auto& one : of.items()) {
      const nlohmann::json& f = one.value();
      if (!f.is_object() || !f.contains("value")) continue;
      const bool is_known = f["value"].is_number();
      if (!is_known && !f["value"].is_null()) continue;
      Figure figure{is_known ? f["value"].get<double>() : std::numeric_limits<double>::quiet_NaN(),
                    -1.0,
                    f.value("unit", ""),
                    {}};
      if (f.contains("uncertainty") && f["uncertainty"].is_number()) {
        figure.error = f["uncertainty"].get<double>();
      }
      if (figure.error < 0.0 && f.contains("no_error") && f["no_error"].is_string()) {
        figure.no_error = f["no_error"].get<std::string>();
      }
      figures[prefix + dotted(one.key())] = figure;
    }
  };
  if (json.contains("sensors") && json["sensors"].is_object()) {
    for (const auto& sensor : json["sensors"].items()) {
      take("sensors." + sensor.key() + ".", sensor.value());
    }
    json.erase("sensors");
  }
  for (const std::string family : {"dust_rates", "stream_indices"}) {
    if (!json.contains(family)) continue;
    take(family + ".", json[family]);
    json.erase(family);
  }
  collect(json, {}, figures);
  return figures;
}

}  // namespace dust::study
