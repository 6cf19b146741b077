// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.hpp"

#include "io/report_text.hpp"
#include "study/runner.hpp"
#include "study/svg_plot.hpp"

#include <algorithm>
#include <cmath>

namespace dust::study {
namespace {

using io::escape_html;
using io::number_html;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + ", " + unit;
}

/// The grid of the landscape over the first two parameters (all there are).
GridField field_of(const CalibrationAnswer& a, std::vector<double> values) {
  const Freedom& x = a.settings.parameters[0];
  const Freedom& y = a.settings.parameters[1];
  const std::size_t n = a.calibration.landscape.per_direction;
  return {{x.low, y.low}, {x.high, y.high}, n, n, std::move(values)};
}

/// The crossing of the lines on which each target is met.
std::string crossing(const CalibrationAnswer& a) {
  const Landscape& l = a.calibration.landscape;
  std::vector<GridField> fields;
  for (const auto& predictions : l.predictions) {
    std::vector<double> means;
    for (const Prediction& p : predictions) means.push_back(p.mean);
    fields.push_back(field_of(a, std::move(means)));
  }
  const GridField region = field_of(a, l.minus_log);
  ContourPlot plot;
  plot.x_label = with_unit(a.settings.parameters[0].name, a.settings.parameters[0].unit);
  plot.y_label = with_unit(a.settings.parameters[1].name, a.settings.parameters[1].unit);
  constexpr const char* k_colours[] = {"--plot2", "--plot3", "--plot5", "--plot4", "--plot6"};
  for (std::size_t g = 0; g < fields.size(); ++g) {
    const Goal& goal = a.settings.goals[g];
    const std::string colour = k_colours[g % std::size(k_colours)];
    plot.lines.push_back({&fields[g], goal.value,
                          goal.name + " = " + short_number(goal.value) +
                              (goal.unit.empty() || goal.unit == "1" ? "" : " " + goal.unit),
                          colour, false});
    plot.lines.push_back({&fields[g], goal.value - goal.error, "", colour, true});
    plot.lines.push_back({&fields[g], goal.value + goal.error, "", colour, true});
  }
  plot.region = &region;
  plot.region_level = l.region_level;
  for (const auto& place : a.calibration.places) plot.points.push_back({place[0], place[1]});
  plot.best = {a.calibration.estimates[0].best, a.calibration.estimates[1].best};
  return "<figure style=\"max-width:640px;margin-top:28px\">" + svg_contours(plot) +
         "<figcaption><b>Where the contours cross.</b> Thick: where the surrogate meets a target; "
         "thin: one standard error to either side. Shaded: the confidence region of " +
         number_html(100.0 * a.settings.confidence) +
         "\u202f%. Dots: runs; cross: the likeliest values.</figcaption></figure>\n";
}

/// One parameter: what the surrogate says of every target, with the target's band.
std::string curves(const CalibrationAnswer& a) {
  const Landscape& l = a.calibration.landscape;
  const Freedom& p = a.settings.parameters[0];
  std::string text = "<div class=\"grid\">\n";
  for (std::size_t g = 0; g < a.settings.goals.size(); ++g) {
    const Goal& goal = a.settings.goals[g];
    Marks line;
    line.has_line = true;
    line.radius = 0.0;
    for (std::size_t n = 0; n < l.places.size(); ++n) {
      line.x.push_back(p.low + l.places[n][0] * (p.high - p.low));
      line.y.push_back(l.predictions[g][n].mean);
    }
    Marks target{{p.low, p.high}, {goal.value, goal.value}, {}, "--plot2", 0.0, true};
    Marks runs;
    runs.colour = "--ink";
    for (std::size_t n = 0; n < a.calibration.places.size(); ++n) {
      if (!a.calibration.evaluations[n][g]) continue;
      runs.x.push_back(a.calibration.places[n][0]);
      runs.y.push_back(*a.calibration.evaluations[n][g]);
    }
    text +=
        "<figure>" +
        svg_xy({with_unit(p.name, p.unit), with_unit(goal.name, goal.unit), {line, target, runs}}) +
        "<figcaption><b>" + escape_html(io::words(goal.name)) +
        "</b>: runs, the surrogate through them, and the target (level line).</figcaption>"
        "</figure>\n";
  }
  return text + "</div>\n";
}

std::string estimates_table(const CalibrationAnswer& a) {
  std::string text =
      "<div class=\"scroll\"><table class=\"narrow\"><thead><tr><th>parameter</th>"
      "<th class=\"n\">likeliest</th><th class=\"n\">mean \u00b1 deviation</th>"
      "<th class=\"n\">region from</th><th class=\"n\">to</th><th>pinned down</th></tr></thead>"
      "<tbody>\n";
  for (std::size_t d = 0; d < a.settings.parameters.size(); ++d) {
    const Freedom& p = a.settings.parameters[d];
    const Estimate& e = a.calibration.estimates[d];
    text += "<tr><td>" + escape_html(with_unit(p.name, p.unit)) + "</td><td class=\"n\">" +
            number_html(e.best) + "</td><td class=\"n\">" + io::value_html(e.mean, e.deviation) +
            "</td><td class=\"n\">" + number_html(e.low) + "</td><td class=\"n\">" +
            number_html(e.high) + "</td><td>" + (e.is_pinned ? "yes" : "<b>no</b>") +
            "</td></tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string targets_table(const CalibrationAnswer& a) {
  std::string text =
      "<div class=\"scroll\"><table class=\"narrow\"><thead><tr><th>target</th>"
      "<th class=\"n\">measured</th><th class=\"n\">expected at the likeliest values</th>"
      "<th class=\"n\">scatter of single runs</th></tr></thead><tbody>\n";
  for (std::size_t g = 0; g < a.settings.goals.size(); ++g) {
    const Goal& goal = a.settings.goals[g];
    const Prediction& p = a.calibration.at_best[g];
    text += "<tr><td>" + escape_html(with_unit(goal.name, goal.unit)) + "</td><td class=\"n\">" +
            io::value_html(goal.value, goal.error) + "</td><td class=\"n\">" +
            io::value_html(p.mean, std::sqrt(p.variance)) + "</td><td class=\"n\">" +
            number_html(a.calibration.scatter[g], 2) + "</td></tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace

std::string calibration_html(const CalibrationAnswer& a) {
  std::string text = "<section id=\"calibration\"><h2>The answer</h2>\n";
  if (a.calibration.estimates.empty()) {
    return text + "<p class=\"banner\">Not enough runs finished for an answer.</p></section>\n";
  }
  const bool is_good = a.calibration.is_met && a.calibration.is_pinned;
  text += is_good ? "<div>" : "<div class=\"banner\">";
  for (const std::string& statement : a.calibration.statements) {
    text += "<p>" + escape_html(with_true_signs(statement)) + "</p>\n";
  }
  text += "</div>\n";
  text += estimates_table(a) + targets_table(a);
  if (a.settings.parameters.size() == 1) text += curves(a);
  if (a.settings.parameters.size() == 2) text += crossing(a);
  return text + "<p class=\"note\">" + std::to_string(a.calibration.places.size()) +
         " places were run, at most " + std::to_string(a.settings.runs) +
         "; surrogate: " + escape_html(io::words(a.settings.surrogate)) +
         ". Region: the smallest that holds the parameters with the stated probability, if the "
         "targets' errors are normal and independent and every value in the ranges is equally "
         "likely beforehand. It holds errors of targets and surrogate, not those of the "
         "model.</p></section>\n";
}

}  // namespace dust::study
