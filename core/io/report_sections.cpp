// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"

#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace dust::io {

namespace {

using nlohmann::json;

constexpr double k_closure = 1e-9;  ///< relative; round-off of sums of 1e6 to 1e7 masses in double

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", std::clamp(share, 0.0, 1.0) * 100.0);
  return text;
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>\n";
}

/// One line of the balance; `closes` turns false when emitted differs from the sum of the parts.
std::string balance_row(const char* name, const json& parts, bool is_exact, const char* unit,
                        bool& closes) {
  const auto emitted = number_at(parts, "emitted");
  if (!emitted) return {};
  const auto part = [&](const char* key) { return number_at(parts, key).value_or(0.0); };
  const double difference = *emitted - part("in_domain") - part("left") - part("removed");
  const double scale = std::max(std::abs(*emitted), 1e-300);
  const bool is_closed = is_exact ? difference == 0.0 : std::abs(difference) <= k_closure * scale;
  closes = closes && is_closed;
  const auto cell = [&](double value) {
    const std::string shown = *unit != '\0'                ? quantity_html(value, -1.0, unit)
                              : value == std::round(value) ? count_html(value)
                                                           : number_html(value, 7);
    return "<td class=\"n\">" + shown + "</td>";
  };
  return std::string("<tr><th scope=\"row\">") + name + "</th>" + cell(*emitted) +
         cell(part("in_domain")) + cell(part("left")) + cell(part("removed")) + "<td class=\"n" +
         (is_closed ? "" : " wrong") + "\">" + number_html(difference, 2) + "</td></tr>\n";
}

/// What became of each size class; empty for runs without these books.
std::string classes_html(const RunText& run) {
  std::string rows;
  for (const json& entry : list_at(run.summary, "size_classes")) {
    const json& mass = object_at(entry, "mass_kg");
    const auto emitted = number_at(mass, "emitted");
    const auto diameter = number_at(entry, "diameter_m");
    if (!emitted || !diameter) continue;
    rows += "<tr><th scope=\"row\">" + quantity_html(*diameter, -1.0, "m") + "</th>";
    for (const char* part : {"emitted", "in_domain", "left", "removed"}) {
      rows += "<td class=\"n\">" + quantity_html(number_at(mass, part).value_or(0.0), -1.0, "kg") +
              "</td>";
    }
    rows += "</tr>\n";
  }
  if (rows.empty()) return rows;
  return "<div class=\"scroll\"><table><thead><tr><th>Mass by diameter</th><th "
         "class=\"n\">Released</th><th class=\"n\">In domain</th><th class=\"n\">Left</th><th "
         "class=\"n\">Removed</th></tr></thead>\n<tbody>" +
         rows + "</tbody></table></div>\n";
}

std::string mass_bar(const json& mass) {
  const double emitted = number_at(mass, "emitted").value_or(0.0);
  if (!(emitted > 0.0)) return {};
  std::string bar, legend;
  int tone = 0;
  for (const auto& [key, name] :
       std::array{std::pair{"in_domain", "still in the domain"},
                  std::pair{"left", "left through a boundary"}, std::pair{"removed", "removed"}}) {
    const double share = number_at(mass, key).value_or(0.0) / emitted;
    ++tone;
    if (!(share > 0.0)) continue;
    const std::string mark = "tone" + std::to_string(tone);
    bar += "<i class=\"" + mark + "\" style=\"width:" + percent(share) + "%\"></i>";
    legend +=
        "<span><i class=\"" + mark + "\"></i>" + name + " " + percent(share) + "\u202f%</span>";
  }
  return "<div class=\"stack\" role=\"img\" aria-label=\"Shares of the mass released\">" + bar +
         "</div><p class=\"legend\">" + legend + "</p>\n";
}

struct Cost {
  std::string name;
  double seconds = 0.0;
};

void collect_costs(const std::string& path, const json& value, std::vector<Cost>& costs) {
  if (value.is_number()) costs.push_back({path, value.get<double>()});
  if (!value.is_object()) return;
  for (const auto& [key, part] : value.items()) {
    // The whole of the DEM nodes, which are listed one by one.
    if (key == "dem_cycle") continue;
    collect_costs(path.empty() ? key : path + "/" + key, part, costs);
  }
}

constexpr double k_small_cost = 0.005;  ///< nodes below this share of the time are one line

void gather_small(std::vector<Cost>& costs, double limit) {
  const auto first = std::find_if(costs.begin(), costs.end(),
                                  [&](const Cost& cost) { return cost.seconds < limit; });
  if (costs.end() - first < 2) return;
  Cost others{std::to_string(costs.end() - first) + " other nodes", 0.0};
  for (auto cost = first; cost != costs.end(); ++cost) others.seconds += cost->seconds;
  costs.erase(first, costs.end());
  costs.push_back(others);
}

/// Scalars of a JSON tree as table rows with paths for names.
void leaves(const std::string& path, const json& value, std::string& rows, bool& has_nonzero) {
  if (value.is_object()) {
    for (const auto& [key, part] : value.items()) {
      leaves(path.empty() ? key : path + " / " + key, part, rows, has_nonzero);
    }
  } else if (value.is_array()) {
    for (const json& part : value) leaves(path, part, rows, has_nonzero);
  } else if (!value.is_null()) {
    if (value.is_number()) has_nonzero = has_nonzero || value.get<double>() != 0.0;
    const std::string shown = value.is_string()           ? escape_html(value.get<std::string>())
                              : value.is_number_integer() ? count_html(value.get<double>())
                              : value.is_number()         ? number_html(value.get<double>(), 6)
                                                  : std::string(value.get<bool>() ? "yes" : "no");
    rows += row(escape_html(words(path)), shown);
  }
}

/// Keys that have their own place on the page.
bool is_shown_elsewhere(const std::string& key) {
  static constexpr std::array k_keys{
      "scenario",       "version",     "status",    "threads",      "wall_s",         "cpu_s",
      "peak_rss_bytes", "simulated_s", "dem_steps", "fluid_steps",  "particle_steps", "particles",
      "real_particles", "mass_kg",     "timers_s",  "state_sha256", "sensors",        "reason"};
  return std::find(k_keys.begin(), k_keys.end(), key) != k_keys.end();
}

}  // namespace

std::string balance_html(const RunText& run) {
  bool closes = true;
  std::string rows;
  rows += balance_row("Computed grains", object_at(run.summary, "particles"), true, "", closes);
  rows += balance_row("Real grains", object_at(run.summary, "real_particles"), false, "", closes);
  rows += balance_row("Mass", object_at(run.summary, "mass_kg"), false, "kg", closes);
  if (rows.empty()) return {};
  std::string text = "<section id=\"balance\"><h2>Mass balance</h2>\n<p>";
  text +=
      closes
          ? "<strong class=\"good\">The balance closes.</strong> Every grain released is still in "
            "the domain, has left through a boundary or was removed, in numbers exactly and in "
            "mass to round-off."
          : "<strong class=\"wrong\">The balance does not close.</strong> What was released "
            "differs from what is in the domain, left and was removed: trust no figure of this "
            "run before the cause is known.";
  text += "</p>\n" + mass_bar(object_at(run.summary, "mass_kg"));
  text +=
      "<div class=\"scroll\"><table><thead><tr><th></th><th class=\"n\">Released</th><th "
      "class=\"n\">In "
      "domain</th><th class=\"n\">Left</th><th class=\"n\">Removed</th><th "
      "class=\"n\">Difference</th></tr></thead>\n<tbody>" +
      rows + "</tbody></table></div>\n";
  text += classes_html(run);
  if (const auto most = number_at(object_at(run.summary, "particles"), "max")) {
    text +=
        "<p class=\"note\">At most " + count_html(*most) +
        " computed grains were in the domain at one time. A real grain counts with the statistical "
        "weight of the computed grains that stand for it.</p>\n";
  }
  return text + "</section>\n";
}

std::string cost_html(const RunText& run) {
  const auto wall = number_at(run.summary, "wall_s");
  const auto simulated = number_at(run.summary, "simulated_s");
  const auto steps = number_at(run.summary, "particle_steps");
  std::vector<Cost> costs;
  collect_costs("", object_at(run.summary, "timers_s"), costs);
  if (costs.empty()) collect_costs("", object_at(run.report, "timers_s"), costs);
  if (!wall && costs.empty()) return {};
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost& a, const Cost& b) { return a.seconds > b.seconds; });
  std::string text = "<section id=\"cost\"><h2>What it cost</h2>\n<dl class=\"tiles small\">\n";
  const auto tile = [&](const char* name, const std::string& value) {
    text += std::string("<div class=\"tile\"><dt>") + name + "</dt><dd><b>" + value +
            "</b></dd></div>\n";
  };
  const json& timers = object_at(run.summary, "timers_s");
  double dem_time = 0.0;
  for (const char* node : {"contact", "force", "integration", "neighbour"}) {
    dem_time += number_at(timers, node).value_or(0.0);
  }
  if (wall && simulated && *simulated > 0.0) {
    tile("Computing time per simulated second", duration_html(*wall / *simulated));
  }
  if (steps && dem_time > 0.0) {
    tile("Grain-steps per second of DEM time",
         number_html(*steps / dem_time / 1e6, 3) + "\u202f<span class=\"unit\">million</span>");
  } else if (wall && steps && *wall > 0.0) {
    tile("Grain-steps per second", number_html(*steps / *wall, 3));
  }
  const auto fluid_time = number_at(timers, "fluid");
  const auto fluid_steps = number_at(run.summary, "fluid_steps");
  if (fluid_time && fluid_steps && *fluid_steps > 0.0) {
    tile("Air, time per step", quantity_html(*fluid_time / *fluid_steps, -1.0, "s"));
  }
  const auto cpu = number_at(run.summary, "cpu_s");
  if (wall && cpu && *wall > 0.0) {
    const auto threads = number_at(run.summary, "threads");
    tile("Processors busy, on average",
         number_html(*cpu / *wall, 3) + (threads ? " of " + count_html(*threads) : std::string()));
  }
  if (const auto memory = number_at(run.summary, "peak_rss_bytes")) {
    tile("Memory at most", number_html(*memory / 1e6, 4) + "\u202f<span class=\"unit\">MB</span>");
  }
  text += "</dl>\n";
  if (!costs.empty()) {
    const double longest = std::max(costs.front().seconds, 1e-300);
    double whole = wall.value_or(0.0);
    for (const Cost& cost : costs) whole = std::max(whole, cost.seconds);
    gather_small(costs, k_small_cost * whole);
    text +=
        "<div class=\"scroll\"><table class=\"bars\"><thead><tr><th>Node</th><th "
        "class=\"n\">Time</th>"
        "<th class=\"n\">Share of the wall time</th><th "
        "aria-hidden=\"true\"></th></tr></thead>\n<tbody>\n";
    for (const Cost& cost : costs) {
      text += "<tr><th scope=\"row\">" + escape_html(words(cost.name)) + "</th><td class=\"n\">" +
              number_html(cost.seconds, 3) + "\u202fs</td><td class=\"n\">" +
              percent(whole > 0.0 ? cost.seconds / whole : 0.0) +
              "\u202f%</td><td class=\"bar\"><i style=\"width:" + percent(cost.seconds / longest) +
              "%\"></i></td></tr>\n";
    }
    text +=
        "</tbody></table></div>\n<p class=\"note\">Wall-clock time of each kind of node; nodes "
        "that "
        "run side by side may add up to more than the whole. DEM time is that of contact, force, "
        "integration and neighbour; a grain-step is one grain moved on by one step.</p>\n";
  }
  return text + "</section>\n";
}

std::string health_html(const RunText& run) {
  std::string rows, others;
  bool has_touched = false, has_limits = false, ignored = false;
  for (const auto& [key, value] : run.summary.items()) {
    if (is_shown_elsewhere(key)) continue;
    const bool is_limit = key.find("limit") != std::string::npos ||
                          key.find("health") != std::string::npos ||
                          key.find("counter") != std::string::npos;
    has_limits = has_limits || is_limit;
    leaves(is_limit && value.is_object() ? "" : key, value, is_limit ? rows : others,
           is_limit ? has_touched : ignored);
  }
  std::string text = "<section id=\"health\"><h2>Limits and health</h2>\n";
  if (has_limits) {
    text +=
        has_touched
            ? "<p>Nothing is clamped silently: each limit counts how often it was touched.</p>\n"
            : "<p><strong class=\"good\">No limit was touched.</strong></p>\n";
    text +=
        "<div class=\"scroll\"><table class=\"facts\"><tbody>" + rows + "</tbody></table></div>\n";
  }
  for (const std::string& note : run.notes)
    text += "<p class=\"note\">" + escape_html(note) + "</p>\n";
  if (!others.empty()) {
    text +=
        "<details><summary>Other entries of the summary</summary><div class=\"scroll\"><table "
        "class=\"facts\"><tbody>" +
        others + "</tbody></table></div></details>\n";
  }
  return has_limits || !others.empty() || !run.notes.empty() ? text + "</section>\n"
                                                             : std::string();
}

std::string figures_html(const RunText& run) {
  std::string text;
  for (std::size_t k = 0; k < run.figures.size();) {
    const std::string& sensor = run.figures[k].sensor;
    std::string rows;
    std::size_t count = 0;
    for (; k < run.figures.size() && run.figures[k].sensor == sensor; ++k, ++count) {
      const Figure& figure = run.figures[k];
      char plain[64];
      std::snprintf(plain, sizeof plain, std::isfinite(figure.value) ? "%.9g" : "", figure.value);
      rows += "<tr><td>" + escape_html(words(figure.name)) + "</td><td class=\"n\">" +
              quantity_html(figure.value, figure.uncertainty, figure.unit) +
              "</td><td class=\"n raw\">" + plain +
              (figure.unit == "1" || figure.unit == "-" ? "" : " " + escape_html(figure.unit)) +
              "</td></tr>\n";
    }
    text += "<details><summary>" + escape_html(words(sensor)) + " <small>" + std::to_string(count) +
            (count == 1 ? " figure" : " figures") +
            "</small></summary><div class=\"scroll\"><table><thead><tr><th>Quantity</th><th "
            "class=\"n\">Value \u00b1 standard error</th><th class=\"n\">SI "
            "value</th></tr></thead>\n<tbody>\n" +
            rows + "</tbody></table></div></details>\n";
  }
  for (const json& table : list_at(run.report, "tables")) {
    if (list_at(table, "rows").empty()) continue;
    text += "<details><summary>" + escape_html(text_at(table, "title")) + " <small>table of " +
            escape_html(words(text_at(table, "sensor"))) +
            "</small></summary><div class=\"scroll\"><table><thead><tr>";
    for (const json& name : list_at(table, "columns")) {
      text += "<th class=\"n\">" + escape_html(name.is_string() ? name.get<std::string>() : "") +
              "</th>";
    }
    text += "</tr></thead>\n<tbody>\n";
    for (const json& cells : list_at(table, "rows")) {
      text += "<tr>";
      for (const json& cell : cells) {
        text += "<td class=\"n\">" +
                (cell.is_number()   ? number_html(cell.get<double>(), 5)
                 : cell.is_string() ? escape_html(cell.get<std::string>())
                                    : std::string("\u2013")) +
                "</td>";
      }
      text += "</tr>\n";
    }
    text += "</tbody></table></div></details>\n";
  }
  if (text.empty()) return text;
  return "<section id=\"figures\"><h2>All figures</h2>\n<p>Every sensor's figures of this run. The "
         "error is "
         "one standard error; where none stands, the sensor makes no estimate.</p>\n" +
         text + "</section>\n";
}

std::string provenance_html(const RunText& run) {
  const json& summary = run.summary;
  std::string rows;
  const auto add_text = [&](const char* name, const char* key, bool is_code) {
    const std::string text = text_at(summary, key);
    if (text.empty()) return;
    rows += row(name, is_code ? "<code>" + escape_html(text) + "</code>" : escape_html(text));
  };
  const auto add_count = [&](const char* name, const char* key) {
    if (const auto value = number_at(summary, key)) rows += row(name, count_html(*value));
  };
  add_text("Scenario", "scenario", false);
  add_text("Engine version", "version", false);
  add_text("Status", "status", false);
  if (const auto value = number_at(summary, "simulated_s")) {
    rows += row("Simulated time", number_html(*value, 6) + "\u202fs");
  }
  add_count("Threads", "threads");
  for (const auto& [name, key] :
       {std::pair{"Wall time", "wall_s"}, std::pair{"Processor time", "cpu_s"}}) {
    if (const auto value = number_at(summary, key)) {
      rows += row(name, duration_html(*value) +
                            (*value >= 100.0 ? " (" + number_html(*value, 6) + "\u202fs)" : ""));
    }
  }
  add_count("DEM steps", "dem_steps");
  add_count("Fluid steps", "fluid_steps");
  add_count("Grain-steps", "particle_steps");
  add_text("State, SHA-256", "state_sha256", true);
  std::string text =
      "<section id=\"provenance\"><h2>Provenance</h2>\n<p>The same scenario, build and "
      "machine give the same state on any number of threads and after any "
      "interruption.</p>\n<div class=\"scroll\"><table class=\"facts\"><tbody>" +
      rows + "</tbody></table></div>\n";
  if (!run.scenario.empty()) {
    text += "<details><summary>The scenario as run</summary><pre>" + escape_html(run.scenario) +
            "</pre></details>\n";
  }
  const std::string graph = text_at(run.report, "graph_dot");
  if (!graph.empty()) {
    text +=
        "<details id=\"graph\"><summary>The task graph</summary><div "
        "id=\"graph-picture\"></div><pre>" +
        escape_html(graph) + "</pre></details>\n";
  }
  return text + "</section>\n";
}

}  // namespace dust::io
