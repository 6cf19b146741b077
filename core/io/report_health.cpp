// SPDX-License-Identifier: Apache-2.0
#include "io/report_limits.hpp"
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>

namespace dust::io {

namespace {

using nlohmann::json;

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
    rows +=
        "<tr><th scope=\"row\">" + escape_html(words(path)) + "</th><td>" + shown + "</td></tr>\n";
  }
}

std::string facts_html(const std::string& rows) {
  return "<div class=\"scroll\" tabindex=\"0\"><table class=\"facts\"><tbody>" + rows +
         "</tbody></table></div>\n";
}

/// Keys that have their own place on the page.
bool is_shown_elsewhere(const std::string& key) {
  static constexpr std::array k_keys{
      "scenario",       "version",     "status",         "threads",         "wall_s",
      "cpu_s",          "simulated_s", "dem_steps",      "fluid_steps",     "particle_steps",
      "peak_rss_bytes", "particles",   "real_particles", "mass_kg",         "timers_s",
      "state_sha256",   "sensors",     "reason",         "size_classes",    "plugins",
      "build",          "warnings",    "references",     "scenario_sha256", "huge_page_bytes"};
  return std::find(k_keys.begin(), k_keys.end(), key) != k_keys.end();
}

std::string limits_html(const std::vector<Limit>& limits) {
  HtmlTable table({{"Limit", false}, {"Reached"}, {"Valid"}, {"", false}}, "limits");
  for (const Limit& limit : limits) {
    table.row({escape_html(limit.name), number_html(limit.reached, 3), limit.valid,
               limit.is_touched
                   ? "<strong class=\"wrong\">beyond.</strong> " + escape_html(limit.consequence)
                   : std::string("<span class=\"good\">kept</span>")});
  }
  return table.html();
}

}  // namespace

int limits_touched(const RunText& run) {
  const auto limits = limits_of(run);
  return static_cast<int>(
      std::count_if(limits.begin(), limits.end(), [](const Limit& l) { return l.is_touched; }));
}

std::string health_html(const RunText& run, const std::string& explanation) {
  std::string counters, others;
  bool has_touched = false, has_counters = false, ignored = false;
  for (const auto& [key, value] : run.summary.items()) {
    if (is_shown_elsewhere(key)) continue;
    const bool is_counter = key.find("limit") != std::string::npos || key == "health" ||
                            key.find("counter") != std::string::npos;
    if (!is_counter) {
      leaves(key, value, others, ignored);
      continue;
    }
    has_counters = true;
    if (!value.is_object()) leaves(key, value, counters, has_touched);
    if (!value.is_object()) continue;
    for (const auto& [name, part] : value.items()) {
      if (!is_limit_key(name)) leaves(name, part, counters, has_touched);
    }
  }
  const auto limits = limits_of(run);
  const json& warnings = list_at(run.summary, "warnings");
  if (!has_counters && others.empty() && run.notes.empty() && limits.empty() && warnings.empty()) {
    return {};
  }
  std::string text = "<section id=\"health\"><h2>Limits and health</h2>\n";
  const int touched = limits_touched(run);
  if (has_counters || !limits.empty()) {
    text += touched > 0 ? "<p><strong class=\"wrong\">" + std::to_string(touched) +
                              (touched == 1 ? " limit" : " limits") +
                              " of validity touched.</strong> Nothing is clamped silently.</p>\n"
            : has_touched
                ? std::string(
                      "<p>Nothing is clamped silently: each limiter counts how often it "
                      "acted.</p>\n")
                : std::string("<p><strong class=\"good\">No limit was touched.</strong></p>\n");
  }
  text += limits_html(limits);
  if (!explanation.empty()) text += "<p class=\"caution\">" + explanation + "</p>\n";
  for (const json& warning : warnings) {
    if (!warning.is_string()) continue;
    text += "<p class=\"caution\">" + escape_html(warning.get<std::string>()) + "</p>\n";
  }
  for (const std::string& note : run.notes)
    text += "<p class=\"note\">" + escape_html(note) + "</p>\n";
  if (!counters.empty()) {
    text +=
        "<details><summary>Counters of the run</summary>" + facts_html(counters) + "</details>\n";
  }
  if (!others.empty()) {
    text += "<details><summary>Other entries of the summary</summary>" + facts_html(others) +
            "</details>\n";
  }
  return text + "</section>\n";
}

}  // namespace dust::io
