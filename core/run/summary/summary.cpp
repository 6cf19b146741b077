// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary.hpp"

#include "base/built_by.hpp"
#include "base/log.hpp"
#include "dust/sdk/plugin.hpp"
#include "io/atomic_file.hpp"
#include "io/run_files.hpp"
#include "particles/store/balance_ledger.hpp"
#include "report/pictures/outline.hpp"
#include "run/summary/dust_outflow.hpp"
#include "run/summary/figure_json.hpp"
#include "run/summary/references.hpp"
#include "run/summary/series_row.hpp"
#include "run/summary/summary_audit.hpp"
#include "run/summary/summary_dust.hpp"
#include "run/summary/summary_emitters.hpp"
#include "run/summary/summary_energy.hpp"
#include "run/summary/summary_models.hpp"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <utility>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Figures of a sensor as JSON: {"path": {"value", "unit", "uncertainty", "role", ...}}.
class JsonFigures final : public sdk::FigureSink {
 public:
  void figure(std::string_view name, double value, std::string_view unit, double uncertainty,
              const sdk::FigureRole& role) override {
    Json& entry = json_[std::string(name)];
    entry = {{"value", number(value)},
             {"unit", unit},
             {"uncertainty", uncertainty < 0.0 ? Json(nullptr) : number(uncertainty)}};
    if (const auto reason = sdk::reason_without_error(uncertainty); !reason.empty()) {
      entry["no_error"] = reason;
    }
    entry.update(role_json(role));
  }
  [[nodiscard]] const Json& json() const { return json_; }

 private:
  Json json_ = Json::object();
};

/// What each column of series.csv stands for, however seldom rows are written.
Json series_columns(const Simulation& s) {
  Json columns = Json::object();
  for_series_columns(s, [&](const std::string& name, double, sdk::RowValue kind,
                            const sdk::FigureRole&) { columns[name] = name_of(kind); });
  return columns;
}

class JsonReport final : public sdk::ReportSink {
 public:
  void section(std::string_view heading, std::string_view text) override {
    sections_.push_back({{"sensor", sensor_}, {"heading", heading}, {"text", text}});
  }
  void curve(std::string_view title, std::string_view x_label, std::string_view y_label,
             std::string_view series, std::span<const double> x,
             std::span<const double> y) override {
    Json xs = Json::array();
    Json ys = Json::array();
    for (const double v : x) xs.push_back(number(v));
    for (const double v : y) ys.push_back(number(v));
    curves_.push_back({{"sensor", sensor_},
                       {"title", title},
                       {"x_label", x_label},
                       {"y_label", y_label},
                       {"series", series},
                       {"x", xs},
                       {"y", ys}});
  }
  void row(std::string_view title, std::span<const std::string> columns,
           std::span<const double> values) override {
    const std::string key(title);
    if (!place_.contains(sensor_ + key)) {
      place_[sensor_ + key] = tables_.size();
      tables_.push_back(
          {{"sensor", sensor_}, {"title", key}, {"columns", columns}, {"rows", Json::array()}});
    }
    Json cells = Json::array();
    for (const double v : values) cells.push_back(number(v));
    tables_[place_[sensor_ + key]]["rows"].push_back(cells);
  }
  /// Whose parts follow.
  void begin(const std::string& sensor) { sensor_ = sensor; }
  [[nodiscard]] Json take_sections() { return std::move(sections_); }
  [[nodiscard]] Json take_curves() { return std::move(curves_); }
  [[nodiscard]] Json take_tables() { return std::move(tables_); }

 private:
  std::string sensor_;
  Json sections_ = Json::array();
  Json curves_ = Json::array();
  Json tables_ = Json::array();
  std::map<std::string, std::size_t> place_;
};

Json counts(const particles::Balance& b) {
  return {{"emitted", b.emitted},
          {"in_domain", b.in_domain},
          {"left", b.left},
          {"removed", b.removed},
          {"max", b.max}};
}

Json node_times(const Simulation& s, const RunFacts& facts) {
  Json times = Json::object();
  const auto nodes = node_timings(s);
  const auto seconds = facts.node_s.empty() ? node_seconds(s, {}) : facts.node_s;
  for (std::size_t n = 0; n < nodes.size(); ++n) times[nodes[n].name] = seconds.at(n);
  times["output"] = facts.output_s;
  // Of every run, also where no node has it: grains alone, air alone.
  for (const char* name : {"contact", "neighbour", "integration", "voidage", "fluid"}) {
    if (!times.contains(name)) times[name] = 0.0;
  }
  return times;
}

/// Which timers belong together, so that nobody has to know their names: those inside `dem_cycle`,
/// and of them what the particles cost by themselves (all but the fluid's force on them).
Json timer_groups(const Simulation& s) {
  Json cycle = Json::array(), particles = Json::array();
  for (const auto& node : s.dem_graph().timings()) {
    cycle.push_back(node.name);
    if (node.name != "drag") particles.push_back(node.name);
  }
  return {{"dem_cycle", std::move(cycle)}, {"particles", std::move(particles)}};
}

Json class_steps(const particles::Dem& dem) {
  Json rows = Json::array();
  for (const auto& c : dem.class_steps()) {
    const auto m = dem.ledger().masses_of(c.diameter);
    rows.push_back({{"diameter_m", c.diameter},
                    {"rayleigh_time_s", c.rayleigh_time},
                    {"hertz_time_s", c.hertz_time},
                    {"stable_step_s", c.stable_step},
                    {"level", c.level},
                    {"mass_kg",
                     {{"emitted", m.emitted},
                      {"in_domain", m.in_domain},
                      {"left", m.left},
                      {"removed", m.removed}}}});
  }
  return rows;
}

Json health(const Simulation& s) {
  Json h = Json::object();
  h["grains_left"] = departures_json(s.insertion().departures());
  h["entries_delayed"] = s.insertion().delayed();
  h["entries_waiting"] = s.insertion().waiting().size();
  h["contacts_seen_late"] = s.dem().report().missed_contact_onsets;
  const auto overlaps = s.dem().report();
  h["largest_overlap_over_radius"] = overlaps.largest_overlap;
  h["largest_overlap_over_radius_coarse"] = overlaps.largest_coarse_overlap;
  h["largest_overlap_over_radius_fine"] = overlaps.largest_fine_overlap;
  if (s.coupling() != nullptr) {
    const auto& c = s.coupling()->report();
    h["voidage_shares_moved_to_open_cells"] = c.moved_shares;
    h["voidage_cells_relieved"] = c.limited_cells;
    h["grains_without_open_cell"] = c.unplaced_grains;
    h["drag_components_without_open_face"] = c.unpaired_forces;
    h["smallest_void_fraction"] = c.smallest_void_fraction;
    h["largest_diameter_over_spacing"] = c.largest_diameter_over_spacing;
    h["limit_of_diameter_over_spacing"] = s.models().voidage->largest_diameter_over_spacing();
    h["largest_momentum_imbalance"] = c.largest_imbalance;
  }
  if (s.fluid() != nullptr && s.fluid_stage()->resolved() != nullptr) {
    const auto& r = s.fluid_stage()->resolved()->report();
    h["resolved_spheres"] = r.spheres;
    h["resolved_markers"] = r.markers;
    h["resolved_least_cells_across"] = r.least_cells_per_diameter;
    h["resolved_largest_slip_m_per_s"] = r.largest_slip;
  }
  if (s.fluid() != nullptr) {
    h["last_divergence_per_s"] = s.fluid()->report().divergence;
    h["last_courant_number"] = s.fluid()->report().courant_number;
    h["fluid_sub_steps"] = s.fluid_stage()->sub_steps();
    h["pressure_iterations"] = s.fluid_stage()->pressure_iterations();
  }
  return h;
}

/// Of the memory held now, what stands in pages of 2 MB; 0 where nobody tells.
std::int64_t huge_page_bytes() {
  std::ifstream file("/proc/self/smaps_rollup");
  std::string word;
  while (file >> word) {
    std::int64_t kibibytes = 0;
    if (word == "AnonHugePages:" && file >> kibibytes) return 1024 * kibibytes;
  }
  return 0;
}

/// What was run, and what it cost.
Json run_json(const Simulation& s, const RunFacts& facts) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  Json j;
  j["scenario"] = s.setup().name;
  j["version"] = DUST_VERSION;
  j["status"] = facts.status;
  if (!facts.reason.empty()) j["reason"] = facts.reason;
  if (facts.start) {
    j["start_from"] = {{"state", facts.start->state},
                       {"time_s", facts.start->time},
                       {"grains", facts.start->particles},
                       {"contacts", facts.start->contacts},
                       {"contacts_without_past", facts.start->without_past},
                       {"is_same_scenario", facts.start->is_same},
                       {"rates_since_s", facts.start->before.plant.time},
                       {"particle_steps", facts.start->before.work.particle_steps},
                       {"fluid_steps", facts.start->before.work.steps}};
  }
  j["threads"] = facts.threads;
  j["wall_s"] = facts.wall_s;
  j["cpu_s"] = facts.cpu_s;
  j["peak_rss_bytes"] = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
  j["huge_page_bytes"] = huge_page_bytes();
  return j;
}

/// What was computed: time, steps, particles and their masses.
Json amounts_json(const Simulation& s, const RunFacts& facts) {
  const auto& b = s.dem().balance();
  const auto dem = s.dem().report();
  Json j;
  j["simulated_s"] = s.time();
  j["dem_step_s"] = s.dem().coarse_step();
  j["dem_steps"] = dem.steps;
  j["fluid_steps"] = s.fluid() != nullptr ? s.steps_done() : 0;
  j["particle_steps"] = dem.particle_steps;
  j["fine_particle_steps"] = dem.fine_steps;
  j["neighbour_rebuilds"] = dem.rebuilds;
  j["contacts"] = dem.contacts;
  j["particles"] = counts(b);
  j["real_particles"] = {{"emitted", b.real_emitted},
                         {"in_domain", b.real_in_domain},
                         {"left", b.real_left},
                         {"removed", b.real_removed},
                         {"max", b.real_max}};
  j["mass_kg"] = {{"emitted", b.mass_emitted},
                  {"in_domain", b.mass_in_domain},
                  {"left", b.mass_left},
                  {"removed", b.mass_removed}};
  j["emitters"] = emitters_json(s, facts);
  if (!s.dem().openings().empty()) j["hoods"] = hoods_json(s, facts);
  if (s.dust_stage() != nullptr) {
    j["dust_field"] = dust_field_json(s);
    j["dust_outflow"] = dust_outflow_json(s, facts);
  }
  if (s.dust_rates() != nullptr) {
    JsonFigures figures;
    s.dust_rates()->report(figures);
    j["dust_rates"] = figures.json();
    JsonFigures indices;
    s.stream_indices()->report(indices);
    j["stream_indices"] = indices.json();
  }
  if (s.liberation() != nullptr) {
    j["dust_on_grains"] = dust_on_grains_json(s, facts);
  }
  if (s.liberation() != nullptr ||
      (s.dust_setup().given && s.dust_setup().given->fall_height > 0.0)) {
    j["dust_estimates"] = dust_estimates_json(s);
  }
  if (s.setup().audit.energy) j["energy"] = energy_json(s);
  j["forces"] = forces_json(s.setup(), facts.forces);
  j["size_classes"] = s.models().class_diameters.empty() ? Json::array() : class_steps(s.dem());
  return j;
}

/// Times of the phases, checks, and by what all was made.
Json record_json(const Simulation& s, const RunFacts& facts) {
  Json j;
  j["timers_s"] = node_times(s, facts);
  j["timer_groups"] = timer_groups(s);
  j["health"] = health(s);
  j["warnings"] = facts.warnings;
  j["frames"] = facts.frames;
  j["series"] = series_columns(s);
  j["series_roles"] = series_roles(s);
  j["scenario_sha256"] = facts.scenario_sha256;
  j["input_files"] = Json::array();
  for (const io::InputFile& input : facts.inputs) {
    j["input_files"].push_back({{"file", input.written}, {"sha256", input.sha256}});
  }
  j["state_sha256"] = s.state_digest();
  j["build"] = {{"compiler", base::k_compiler},
                {"processor", base::k_processor},
                {"plugin_interface", sdk::k_interface_version}};
  if (facts.registry == nullptr) return j;
  j["plugins"] = plugins_json(s.setup(), s.dust_setup(), *facts.registry);
  for (Json& plugin : j["plugins"]) {
    for (const UsedModel& model : facts.models) {
      const bool is_it = plugin["kind"] == model.kind && plugin["name"] == model.name;
      if (is_it && !model.sha256.empty()) plugin["sha256"] = model.sha256;
    }
  }
  return j;
}

/// The sensors' figures; what they have for the report goes there.
Json sensors_json(const Simulation& s, JsonReport& report) {
  Json sensors = Json::object();
  for (std::size_t n = 0; n < s.models().sensors.size(); ++n) {
    const std::string& name = s.setup().sensors[n].name;
    JsonFigures figures;
    s.models().sensors[n]->summary(figures);
    sensors[name] = figures.json();
    report.begin(name);
    s.models().sensors[n]->report(report);
  }
  return sensors;
}

/// Curves from elsewhere stand among those of their sensors, marked as such.
void add_reference_curves(const std::vector<scenario::ReferenceCurve>& references, Json& curves) {
  for (const scenario::ReferenceCurve& c : references) {
    curves.push_back({{"sensor", c.sensor},
                      {"title", c.axes.title},
                      {"x_label", c.axes.x_label},
                      {"y_label", c.axes.y_label},
                      {"series", c.source},
                      {"kind", "reference"},
                      {"x", c.x},
                      {"y", c.y}});
  }
}

/// What the report needs beyond the other files.
Json report_json(const Simulation& s, const RunFacts& facts, JsonReport& report) {
  Json r;
  r["title"] = s.setup().name;
  r["sections"] = report.take_sections();
  r["curves"] = report.take_curves();
  add_reference_curves(facts.reference_curves, r["curves"]);
  r["tables"] = report.take_tables();
  add_emitter_tables(s, r["tables"]);
  add_hood_tables(s, r["tables"]);
  add_liberation_table(s, facts, r["tables"]);
  add_energy_table(s, r["tables"]);
  add_force_table(facts.forces, r["tables"]);
  r["outline"] = report::outline_of(s.setup().domain, s.models().bodies);
  r["classes"] = s.models().class_diameters;
  if (facts.registry != nullptr)
    r["setting"] = setting_json(s.setup(), s.dust_setup(), *facts.registry);
  if (s.dust_setup().given) r["dust_rule"] = dust_rule_json(s);
  r["graph_dot"] = graph_dot(s);
  return r;
}

}  // namespace

std::vector<graph::NodeTiming> node_timings(const Simulation& s) {
  auto nodes = s.dem_graph().timings();
  const auto more = s.step_graph().timings();
  nodes.insert(nodes.end(), more.begin(), more.end());
  return nodes;
}

std::vector<double> node_seconds(const Simulation& simulation, const std::vector<double>& before) {
  std::vector<double> seconds;
  for (const auto& node : node_timings(simulation)) seconds.push_back(node.seconds);
  for (std::size_t n = 0; n < std::min(before.size(), seconds.size()); ++n) seconds[n] += before[n];
  return seconds;
}

RunRecord record_of(const Simulation& s, const RunFacts& facts) {
  JsonReport report;
  Json summary = run_json(s, facts);
  summary.update(amounts_json(s, facts));
  summary.update(record_json(s, facts));
  summary["sensors"] = sensors_json(s, report);
  summary["references"] = references_json(facts.references, summary["sensors"]);
  Json rest = report_json(s, facts, report);
  return {std::move(summary), std::move(rest)};
}

void write_summary(const std::filesystem::path& folder, const Simulation& s,
                   const RunFacts& facts) {
  const RunRecord record = record_of(s, facts);
  for (const std::string& line : reference_lines(record.summary["references"])) {
    base::log_info(line);
  }
  io::write_text(folder / "summary.json", record.summary.dump(2) + "\n");
  io::write_text(folder / "report.json", record.report.dump() + "\n");
}

std::string graph_dot(const Simulation& s) {
  std::string dot = "digraph dust {\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n";
  dot += s.step_graph().dot_cluster(2);
  dot += s.dem_graph().dot_cluster(2);
  dot += "  \"fluid_step.dem_cycle\" -> \"dem_step." + s.dem_graph().timings().front().name +
         "\" [style=dashed, label=\"every DEM step\"];\n}\n";
  return dot;
}

}  // namespace dust::run
