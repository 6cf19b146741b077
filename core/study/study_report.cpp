// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.hpp"

#include "io/report_assets.hpp"
#include "io/report_text.hpp"
#include "io/run_files.hpp"
#include "study/effects.hpp"
#include "study/runner.hpp"
#include "study/svg_plot.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace dust::study {
namespace {

using io::escape_html;
using io::number_html;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + ", " + unit;
}

/// Long paths by their last part where that says which.
std::string short_name(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

std::size_t count_of(const Results& results, Status status) {
  return static_cast<std::size_t>(
      std::count_if(results.outcomes.begin(), results.outcomes.end(),
                    [&](const Outcome& o) { return o.status == status; }));
}

std::string header_html(const Spec& spec, const Results& results) {
  const std::size_t finished = count_of(results, Status::finished);
  const std::size_t failed = count_of(results, Status::failed);
  const std::size_t all = results.outcomes.size();
  double wall = 0.0;
  for (const Outcome& o : results.outcomes) wall += o.wall_s;
  const char* look = finished == all ? "good" : "bad";
  std::string text = "<header>\n<p class=\"eyebrow\"><span>Study</span><span class=\"status ";
  text += std::string(look) + "\">" + std::to_string(finished) + " of " + std::to_string(all) +
          " runs finished</span><span>dust " DUST_VERSION
          "</span><button type=\"button\" id=\"theme\" class=\"screen\" hidden>Dark</button></p>\n";
  text += "<h1>" + escape_html(io::words(spec.name)) + "</h1>\n<p class=\"lede\">" +
          escape_html(spec.title.empty() ? "Variations of " + spec.base.filename().string() + "."
                                         : spec.title) +
          "</p>\n<dl class=\"tiles\">\n";
  const auto tile = [&](const char* name, const std::string& value, const std::string& below) {
    text += std::string("<div class=\"tile\"><dt>") + name + "</dt><dd><b>" + value + "</b><span>" +
            below + "</span></dd></div>\n";
  };
  tile("Runs", std::to_string(all),
       std::to_string(results.plan.inputs.size()) + " inputs, " +
           std::to_string(results.plan.outputs.size()) + " outputs");
  tile("Finished", std::to_string(finished),
       failed == 0 ? "none failed" : std::to_string(failed) + " failed");
  tile("Time of all runs", io::duration_html(wall), "one after the other");
  tile("Base", escape_html(spec.base.stem().string()), escape_html(spec.base.generic_string()));
  return text + "</dl>\n</header>\n";
}

std::string expectations_html(const Spec& spec, const Results& results) {
  if (spec.expectations.empty()) return {};
  std::string rows;
  std::size_t as_expected = 0;
  std::size_t against = 0;
  for (const Expectation& e : spec.expectations) {
    const Verdict verdict = judge(e, spec, results);
    const bool is_good = verdict.kind == Verdict::Kind::as_expected;
    const bool is_bad = verdict.kind == Verdict::Kind::against;
    as_expected += is_good ? 1 : 0;
    against += is_bad ? 1 : 0;
    rows += "<tr><td>" + escape_html(io::words(e.output)) + " " + escape_html(e.then) +
            "</td><td>" +
            escape_html(e.from.empty() ? "with " + e.input : "from " + e.from + " to " + e.to) +
            "</td><td>" +
            (is_good  ? "<strong class=\"good\">"
             : is_bad ? "<strong class=\"wrong\">"
                      : "<span>") +
            escape_html(verdict.text) + (is_good || is_bad ? "</strong>" : "</span>") +
            "</td><td>" + escape_html(e.why) + "</td></tr>\n";
  }
  return "<section id=\"expectations\"><h2>Expected signs</h2>\n<p>" + std::to_string(as_expected) +
         " of " + std::to_string(spec.expectations.size()) + " are as expected, " +
         std::to_string(against) +
         " against. A change counts as told from noise when it exceeds twice its standard error."
         "</p>\n<div class=\"scroll\"><table><thead><tr><th>expected</th><th></th><th>found</th>"
         "<th>why</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div></section>\n";
}

std::string effect_figure(const MainEffect& effect, const Results& results) {
  const InputColumn& input = results.plan.inputs[effect.input];
  const OutputColumn& output = results.plan.outputs[effect.output];
  std::string picture;
  if (input.is_text) {
    RowPlot plot{with_unit(output.name, output.unit), {}, {}, {}};
    for (const LevelMean& l : effect.levels) {
      plot.names.push_back(l.label);
      plot.values.push_back(l.mean);
      plot.errors.push_back(l.error);
    }
    picture = svg_rows(plot);
  } else {
    Marks single;
    single.colour = "--tone3";
    single.radius = 2.2;
    Marks means;
    means.has_line = !effect.is_scattered;
    for (const LevelMean& l : effect.levels) {
      means.x.push_back(l.input);
      means.y.push_back(l.mean);
      means.error.push_back(effect.is_scattered ? -1.0 : l.error);
    }
    for (std::size_t n = 0; n < results.outcomes.size() && !effect.is_scattered; ++n) {
      const Outcome& o = results.outcomes[n];
      if (effect.output >= o.outputs.size() || !o.outputs[effect.output].value) continue;
      single.x.push_back(results.plan.points[n].inputs[effect.input].number);
      single.y.push_back(*o.outputs[effect.output].value);
    }
    picture = svg_xy(
        {with_unit(input.name, input.unit), with_unit(output.name, output.unit), {single, means}});
  }
  std::string change = number_html(effect.change);
  if (effect.error >= 0.0) change += " \u00b1 " + number_html(effect.error, 2);
  return "<figure>" + picture + "<figcaption><b>" + escape_html(io::words(output.name)) +
         "</b> against " + escape_html(io::words(short_name(input.name))) + ". Change over the " +
         (effect.is_scattered ? "range (fitted line): " : "levels: ") + change +
         (output.unit == "1" ? "" : "\u202f" + escape_html(output.unit)) +
         ".</figcaption></figure>\n";
}

std::string effects_html(const Spec& spec, const Results& results) {
  const auto effects = main_effects(spec, results);
  if (effects.empty()) return {};
  std::string text =
      "<section id=\"effects\"><h2>Main effects</h2>\n<p>Each mark is the mean over all finished "
      "runs with that level, whatever the other inputs were; faint marks are single runs. Bars: "
      "one "
      "standard error, from replicates where there are any, otherwise from what the sensors tell "
      "of "
      "themselves.</p>\n";
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    std::string figures;
    for (const MainEffect& e : effects) {
      if (e.output == o) figures += effect_figure(e, results);
    }
    if (figures.empty()) continue;
    const OutputColumn& c = results.plan.outputs[o];
    text += "<h3>" + escape_html(io::words(c.name)) + " <small>" + escape_html(c.quantity) +
            "</small></h3>\n<div class=\"grid\">\n" + figures + "</div>\n";
  }
  return text + "</section>\n";
}

std::string cell(const std::optional<double>& value, double error) {
  if (!value) return "<td class=\"n\">\u2013</td>";
  return "<td class=\"n\">" +
         (error >= 0.0 ? io::value_html(*value, error) : number_html(*value, 5)) + "</td>";
}

std::string points_html(const Results& results) {
  std::string text =
      "<section id=\"points\"><h2>All points</h2>\n<div class=\"scroll\"><table><thead><tr>"
      "<th>point</th>";
  for (const InputColumn& c : results.plan.inputs) {
    text += "<th class=\"n\">" + escape_html(with_unit(short_name(c.name), c.unit)) + "</th>";
  }
  text += "<th class=\"n\">seed</th>";
  for (const OutputColumn& c : results.plan.outputs) {
    text += "<th class=\"n\">" + escape_html(with_unit(c.name, c.unit)) + "</th>";
  }
  text += "<th>status</th><th class=\"n\">time</th></tr></thead><tbody>\n";
  for (std::size_t n = 0; n < results.outcomes.size(); ++n) {
    const Point& point = results.plan.points[n];
    const Outcome& o = results.outcomes[n];
    const bool is_finished = o.status == Status::finished;
    text += "<tr><td>";
    text += is_finished ? "<a href=\"points/" + point.hash + "/report.html\">" +
                              std::to_string(n + 1) + "</a>"
                        : std::to_string(n + 1);
    text += "</td>";
    for (const InputValue& v : point.inputs) {
      text += "<td class=\"n\">" + escape_html(v.text) + "</td>";
    }
    text += "<td class=\"n\">" + std::to_string(point.seed) + "</td>";
    for (std::size_t k = 0; k < results.plan.outputs.size(); ++k) {
      const OutputValue v = k < o.outputs.size() ? o.outputs[k] : OutputValue{};
      text += cell(v.value, v.error);
    }
    text += std::string("<td>") + status_word(o.status) +
            (o.reason.empty() ? "" : ": " + escape_html(o.reason)) + "</td><td class=\"n\">" +
            (o.status == Status::waiting ? "" : io::duration_html(o.wall_s)) + "</td></tr>\n";
  }
  return text +
         "</tbody></table></div>\n<p class=\"note\">The numbers lead to the runs' own reports. The "
         "same table stands in study.csv, and as columns in study.h5.</p></section>\n";
}

std::string provenance_html(const Spec& spec) {
  std::ifstream stream(spec.file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  return "<section id=\"provenance\"><h2>Provenance</h2>\n<p>Every run keeps its full scenario "
         "beside its results: points/HASH.yaml.</p>\n<details><summary>The study file</summary>"
         "<pre>" +
         escape_html(text) + "</pre></details></section>\n";
}

/// The theme follows the reader's system until the button is pressed; paper is light.
constexpr const char* k_script =
    "(() => {\n"
    "  const root = document.documentElement, button = document.getElementById('theme');\n"
    "  const system = window.matchMedia('(prefers-color-scheme: dark)');\n"
    "  let chosen = null;\n"
    "  const show = (theme) => {\n"
    "    root.dataset.theme = theme;\n"
    "    button.textContent = theme === 'dark' ? 'Light' : 'Dark';\n"
    "  };\n"
    "  const now = () => chosen || (system.matches ? 'dark' : 'light');\n"
    "  button.hidden = false;\n"
    "  show(now());\n"
    "  system.addEventListener('change', () => show(now()));\n"
    "  button.addEventListener('click', () => {\n"
    "    chosen = now() === 'dark' ? 'light' : 'dark';\n"
    "    show(chosen);\n"
    "  });\n"
    "  window.addEventListener('beforeprint', () => show('light'));\n"
    "  window.addEventListener('afterprint', () => show(now()));\n"
    "  root.dataset.drawn = 'yes';\n"
    "})();\n";

}  // namespace

void write_study_report(const std::filesystem::path& file, const Spec& spec, const Results& results,
                        const CalibrationAnswer* answer) {
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"dust " DUST_VERSION "\">\n<title>" +
      escape_html(io::words(spec.name)) + " \u2013 study report</title>\n<style>";
  text += io::report_asset("report.css");
  text += "</style>\n</head>\n<body>\n<main>\n" + header_html(spec, results);
  if (answer != nullptr) text += calibration_html(*answer);
  text += expectations_html(spec, results) + effects_html(spec, results) + points_html(results) +
          provenance_html(spec);
  text += "<footer>Written by dust " DUST_VERSION
          ". This page is complete in itself and asks no other machine for anything.</footer>\n"
          "</main>\n<script>" +
          std::string(k_script) + "</script>\n</body>\n</html>\n";
  io::write_text(file, text);
}

}  // namespace dust::study
