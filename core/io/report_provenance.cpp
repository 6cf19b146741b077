// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace dust::io {

namespace {

using nlohmann::json;

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>\n";
}

std::string build_text(const json& build) {
  std::string text = text_at(build, "compiler");
  if (const auto processor = text_at(build, "processor"); !processor.empty()) {
    text += " for " + processor;
  }
  if (const auto version = number_at(build, "plugin_interface")) {
    text += ", plugin interface " + std::to_string(static_cast<int>(*version));
  }
  return text;
}

/// The models the run chose, by kind, with the versions they give themselves.
std::string plugins_html(const json& summary) {
  HtmlTable table({{"Kind", false}, {"Models and their versions", false}}, "facts");
  std::string kind, names;
  const auto close = [&] {
    if (!kind.empty()) table.row({escape_html(words(kind)), names});
    names.clear();
  };
  for (const json& plugin : list_at(summary, "plugins")) {
    if (text_at(plugin, "kind") != kind) {
      close();
      kind = text_at(plugin, "kind");
    }
    names += (names.empty() ? "" : ", ") + escape_html(text_at(plugin, "name")) + "\u00a0" +
             escape_html(text_at(plugin, "version"));
  }
  close();
  return table.html();
}

}  // namespace

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
  add_text("Scenario as run, SHA-256", "scenario_sha256", true);
  add_text("Engine version", "version", false);
  if (const std::string build = build_text(object_at(summary, "build")); !build.empty()) {
    rows += row("Built by", escape_html(build));
  }
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
      "interruption.</p>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"facts\"><tbody>" +
      rows + "</tbody></table></div>\n" + plugins_html(summary);
  if (!run.scenario.empty()) {
    text += "<details><summary>The scenario as run</summary><pre>" + escape_html(run.scenario) +
            "</pre></details>\n";
  }
  return text + "</section>\n";
}

}  // namespace dust::io
