// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.hpp"

#include "io/atomic_file.hpp"
#include "io/report_page.hpp"
#include "io/report_text.hpp"
#include "study/effects.hpp"
#include "study/runner.hpp"
#include "study/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

namespace dust::study {
namespace {

using io::escape_html;
using io::number_html;
using Json = nlohmann::json;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + ", " + unit;
}

/// Long paths by their last part where that says which.
std::string short_name(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

/// A name zipped with a number, which tells the levels better: an opening with its mass flow.
bool is_told_by_number(const Plan& plan, std::size_t input) {
  const auto is_twin = [&](const InputColumn& c) {
    return c.axis == plan.inputs[input].axis && !c.is_text;
  };
  return plan.inputs[input].is_text && std::any_of(plan.inputs.begin(), plan.inputs.end(), is_twin);
}

std::string counted(std::size_t count, const char* thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// The name as a heading.
std::string title_of(const Spec& spec) {
  std::string title = io::words(spec.name);
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') {
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
  }
  return title;
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
  std::string text =
      "<header>\n" +
      io::heading_html("Study", spec.name, finished == all ? "finished" : "not finished",
                       title_of(spec)) +
      "<p class=\"lede\">" +
      escape_html(spec.title.empty() ? "Variations of " + spec.base.filename().string() + "."
                                     : spec.title) +
      "</p>\n<dl class=\"tiles\">\n";
  const auto tile = [&](const char* name, const std::string& value, const std::string& below) {
    text += std::string("<div class=\"tile\"><dt>") + name + "</dt><dd><b>" + value + "</b><span>" +
            below + "</span></dd></div>\n";
  };
  tile("Runs", std::to_string(all),
       counted(results.plan.inputs.size(), "input") + ", " +
           counted(results.plan.outputs.size(), "output"));
  tile("Finished", std::to_string(finished) + " of " + std::to_string(all),
       failed == 0 ? "none failed" : std::to_string(failed) + " failed");
  tile("Time of all runs", io::duration_html(wall), "one after the other");
  tile("Base", escape_html(spec.base.stem().string()),
       escape_html(spec.base.lexically_proximate(spec.file.parent_path()).generic_string()));
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
    rows +=
        "<tr><td>" + escape_html(io::words(e.output)) + " " + escape_html(e.then) + "</td><td>" +
        escape_html(e.from.empty() ? "with " + e.input : "from " + e.from + " to " + e.to) +
        "</td><td>" +
        (is_good  ? "<strong class=\"good\">"
         : is_bad ? "<strong class=\"wrong\">"
                  : "<span>") +
        escape_html(with_true_signs(verdict.text)) + (is_good || is_bad ? "</strong>" : "</span>") +
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

/// "Change over the levels: 60.33 \u00b1 0.10 mm"
std::string change_text(const MainEffect& effect, const OutputColumn& output) {
  const std::string over = effect.is_scattered ? "the range (fitted line): " : "the levels: ";
  return "Change over " + over + amount_text(effect.change, effect.error, output.unit) + ".";
}

/// Names beside means with their errors.
std::string rows_figure(const MainEffect& effect, const Results& results) {
  const OutputColumn& output = results.plan.outputs[effect.output];
  RowPlot plot{with_unit(output.name, output.unit), {}, {}, {}};
  for (const LevelMean& l : effect.levels) {
    plot.names.push_back(l.label);
    plot.values.push_back(l.mean);
    plot.errors.push_back(l.error);
  }
  return "<figure>" + svg_rows(plot) + "<figcaption><b>" + escape_html(io::words(output.name)) +
         "</b> against " +
         escape_html(io::words(short_name(results.plan.inputs[effect.input].name))) +
         ".</figcaption></figure>\n";
}

/// What the other inputs were, for the legend.
std::string others_of(const Results& results, const Point& point, std::size_t axis) {
  std::string text;
  for (std::size_t k = 0; k < results.plan.inputs.size(); ++k) {
    const InputColumn& c = results.plan.inputs[k];
    if (c.axis == axis || is_told_by_number(results.plan, k)) continue;
    text += (text.empty() ? "" : ", ") + short_name(c.name) + " " + point.inputs[k].text +
            (c.unit.empty() || c.unit == "1" ? "" : " " + c.unit);
  }
  return text;
}

/// One line per combination of the other inputs, means of replicates: shows whether they matter.
/// Empty where there is one combination only, or more than a reader tells apart.
Json lines_of_others(const MainEffect& effect, const Results& results) {
  constexpr std::size_t k_most = 5;
  const std::size_t axis = results.plan.inputs[effect.input].axis;
  struct Sum {
    double sum = 0.0, count = 0.0;
  };
  std::map<std::vector<std::size_t>, std::pair<std::string, std::map<double, Sum>>> groups;
  for (std::size_t n = 0; n < results.outcomes.size(); ++n) {
    const Outcome& o = results.outcomes[n];
    if (effect.output >= o.outputs.size() || !o.outputs[effect.output].value) continue;
    const Point& point = results.plan.points[n];
    std::vector<std::size_t> key = point.levels;
    if (axis < key.size()) key[axis] = 0;
    auto& [name, line] = groups[key];
    name = others_of(results, point, axis);
    Sum& at = line[point.inputs[effect.input].number];
    at.sum += *o.outputs[effect.output].value;
    at.count += 1.0;
  }
  Json lines = Json::array();
  if (groups.size() < 2 || groups.size() > k_most) return lines;
  for (const auto& [key, group] : groups) {
    Json line = {{"name", group.first}, {"x", Json::array()}, {"y", Json::array()}};
    for (const auto& [x, sum] : group.second) {
      line["x"].push_back(x);
      line["y"].push_back(sum.sum / sum.count);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// A plot for Page: the means with one standard error to either side, and the lines behind them.
Json effect_plot(const MainEffect& effect, const Results& results) {
  const InputColumn& input = results.plan.inputs[effect.input];
  const OutputColumn& output = results.plan.outputs[effect.output];
  Json mean = {{"name", effect.is_scattered ? "runs" : "mean"},
               {"x", Json::array()},
               {"y", Json::array()},
               {"low", Json::array()},
               {"high", Json::array()}};
  if (effect.is_scattered) mean["kind"] = "points";
  mean["width"] = 3.0;
  bool has_errors = true;
  double last = 0.0;
  for (const LevelMean& l : effect.levels) {
    // A plot needs one value per place.
    if (!mean["x"].empty() && l.input <= last) continue;
    last = l.input;
    has_errors = has_errors && l.error >= 0.0;
    mean["x"].push_back(l.input);
    mean["y"].push_back(l.mean);
    mean["low"].push_back(l.mean - l.error);
    mean["high"].push_back(l.mean + l.error);
  }
  if (!has_errors || effect.is_scattered) {
    mean.erase("low");
    mean.erase("high");
  }
  Json lines = Json::array({mean});
  if (!effect.is_scattered) {
    for (Json& line : lines_of_others(effect, results)) lines.push_back(std::move(line));
  }
  return {{"title", output.name},
          {"x_label", with_unit(io::words(short_name(input.name)), input.unit)},
          {"y_label", lines.size() > 1 ? "mean, and each combination of the other inputs" : "mean"},
          {"unit", output.unit == "1" ? "" : output.unit},
          {"note", with_true_signs(change_text(effect, output))},
          {"lines", lines}};
}

/// All effects of numbers at a glance: a row per output, a column per input. What stands out of
/// twice its error is bold.
std::string effects_table(const std::vector<MainEffect>& effects, const Results& results) {
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < results.plan.inputs.size(); ++k) {
    const bool is_told = std::any_of(effects.begin(), effects.end(),
                                     [&](const MainEffect& e) { return e.input == k; });
    if (is_told && !results.plan.inputs[k].is_text) columns.push_back(k);
  }
  if (columns.empty()) return {};
  std::string head = "<th>change of</th>";
  for (const std::size_t k : columns) {
    const MainEffect& any = *std::find_if(effects.begin(), effects.end(),
                                          [&](const MainEffect& e) { return e.input == k; });
    const InputColumn& input = results.plan.inputs[k];
    const std::string unit = input.unit.empty() || input.unit == "1" ? "" : " " + input.unit;
    head += "<th class=\"n\">over " + escape_html(io::words(short_name(input.name))) + " " +
            number_html(any.levels.front().input) + " to " + number_html(any.levels.back().input) +
            escape_html(unit) + "</th>";
  }
  std::string rows;
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    const OutputColumn& output = results.plan.outputs[o];
    std::string cells;
    for (const std::size_t k : columns) {
      const auto effect = std::find_if(effects.begin(), effects.end(), [&](const MainEffect& e) {
        return e.input == k && e.output == o;
      });
      if (effect == effects.end()) {
        cells += "<td class=\"n\">\u2013</td>";
        continue;
      }
      const bool is_clear = effect->error >= 0.0 && std::abs(effect->change) > 2.0 * effect->error;
      const std::string text =
          escape_html(with_true_signs(amount_text(effect->change, effect->error, output.unit)));
      cells += "<td class=\"n\">" + (is_clear ? "<strong>" + text + "</strong>" : text) + "</td>";
    }
    rows += "<tr><th scope=\"row\">" + escape_html(io::words(output.name)) + "</th>" + cells +
            "</tr>\n";
  }
  return "<div class=\"scroll\"><table><thead><tr>" + head + "</tr></thead><tbody>\n" + rows +
         "</tbody></table></div>\n<p class=\"note\">From the first level to the last, with one "
         "standard error; bold: more than twice that.</p>\n";
}

std::string effects_html(const Spec& spec, const Results& results, Json& plots) {
  plots = Json::object();
  const auto effects = main_effects(spec, results);
  if (effects.empty()) return {};
  std::string text =
      "<section id=\"effects\"><h2>Main effects</h2>\n<p>Each mark is the mean over all finished "
      "runs with that level, whatever the other inputs were. Errors: from replicates where there "
      "are any, otherwise from what the sensors tell of themselves.</p>\n" +
      effects_table(effects, results);
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    std::string rows;
    Json drawn = Json::array();
    for (const MainEffect& e : effects) {
      if (e.output != o || is_told_by_number(results.plan, e.input)) continue;
      if (results.plan.inputs[e.input].is_text) {
        rows += rows_figure(e, results);
      } else {
        drawn.push_back(effect_plot(e, results));
      }
    }
    if (rows.empty() && drawn.empty()) continue;
    const OutputColumn& c = results.plan.outputs[o];
    const std::string name = "output-" + std::to_string(o);
    text += "<h3>" + escape_html(io::words(c.name)) + " <small>" + escape_html(c.quantity) +
            (c.minus.empty() ? "" : " \u2212 " + escape_html(c.minus)) +
            "</small></h3>\n<div class=\"grid\" data-plots=\"" + name + "\">\n" + rows + "</div>\n";
    plots[name] = std::move(drawn);
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

}  // namespace

std::string with_true_signs(std::string text) {
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    const bool is_first = at == 0 || text[at - 1] == ' ';
    if (is_first && text[at] == '-' && text[at + 1] >= '0' && text[at + 1] <= '9') {
      text.replace(at, 1, "\u2212");
    }
  }
  for (auto at = text.find("+-"); at != std::string::npos; at = text.find("+-", at)) {
    text.replace(at, 2, "\u00b1");
  }
  return text;
}

void write_study_report(const std::filesystem::path& file, const Spec& spec, const Results& results,
                        const CalibrationAnswer* answer) {
  io::Page page;
  page.title = title_of(spec);
  page.kind = "study report";
  page.body = header_html(spec, results);
  if (answer != nullptr) page.body += calibration_html(*answer);
  page.body += expectations_html(spec, results) + effects_html(spec, results, page.data["plots"]) +
               points_html(results) + provenance_html(spec) + io::footer_html(DUST_VERSION);
  io::write_text(file, io::page_html(page));
}

}  // namespace dust::study
