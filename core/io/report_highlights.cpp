// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace dust::io {

namespace {

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

bool is_per_tonne(const Figure& figure) {
  return figure.unit == "g/t" || figure.unit == "g/tonne" || has(figure.name, "per_tonne");
}

std::string leaf_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// 5, 50 or 95 when a figure's last word names that quantile, else 0.
int quantile_of(const std::string& path) {
  const std::string leaf = leaf_of(path);
  if (has(leaf, "spread") || has(leaf, "width") || has(leaf, "count")) return 0;
  if (has(leaf, "median") || has(leaf, "50")) return 50;
  if (has(leaf, "95")) return 95;
  if (has(leaf, "05") || leaf == "5" || leaf == "q5" || leaf == "quantile_5") return 5;
  return 0;
}

/// The drop in "drop_140_mm/median" [m]; negative when the path names none.
double drop_of(const std::string& path) {
  const auto at = path.find("drop_");
  if (at == std::string::npos) return -1.0;
  const char* begin = path.c_str() + at + 5;
  char* end = nullptr;
  const double value = std::strtod(begin, &end);
  if (end == begin) return -1.0;
  const std::string rest(end);
  if (rest.rfind("_mm", 0) == 0) return value * 1e-3;
  if (rest.rfind("_cm", 0) == 0) return value * 1e-2;
  return value;
}

int rank_of(const Figure& figure) {
  const std::string text = figure.sensor + "/" + figure.name;
  if (has(text, "loose") || has(text, "liberated")) return 0;
  return has(text, "dust") ? 1 : 2;
}

std::string status_html(const RunText& run) {
  const std::string status = text_at(run.summary, "status");
  const auto simulated = number_at(run.summary, "simulated_s");
  if (status.empty() || status == "finished") return {};
  std::string text = "<p class=\"banner\" role=\"status\"><strong>";
  text += status == "failed" ? "This run failed" : "This run was stopped before its end";
  if (simulated) text += " at " + number_html(*simulated) + "\u202fs of simulated time";
  text += ".</strong> Everything below is what it had reached. ";
  if (const auto reason = text_at(run.summary, "reason"); !reason.empty()) {
    text += escape_html(reason) + " ";
  }
  text += status == "failed"
              ? "The last good state is kept in <code>checkpoint.h5</code>, the cause "
                "stands at the end of <code>run.log</code>."
              : "<code>engine run scenario.yaml --resume</code> goes on from its "
                "checkpoint.";
  return text + "</p>\n";
}

std::string where_it_went(const Highlights& highlights) {
  std::string text;
  for (std::size_t k = 1; k < highlights.dust.size() && k < 4; ++k) {
    const Figure& figure = highlights.dust[k];
    text += k == 1 ? " Elsewhere: " : "; ";
    text +=
        quantity_html(figure.value, figure.uncertainty, figure.unit.empty() ? "g/t" : figure.unit);
    text += " (<em>" + escape_html(words(figure.sensor)) + "</em>, " +
            escape_html(words(leaf_of(figure.name))) + ")";
  }
  return text.empty() ? text : text + ".";
}

std::string lede_html(const RunText& run, const Highlights& highlights) {
  std::string text;
  if (!highlights.dust.empty()) {
    const Figure& figure = highlights.dust.front();
    text += "<strong>" + value_html(figure.value, figure.uncertainty) +
            "\u202fg of dust per tonne</strong> of load got loose (<em>" +
            escape_html(words(figure.sensor)) + "</em>, " +
            escape_html(words(leaf_of(figure.name))) + ").";
    text += where_it_went(highlights);
  }
  if (!highlights.stream.empty()) {
    const StreamDrop& last = highlights.stream.back();
    text += text.empty() ? "The" : " The";
    text += " middle of the stream lies <strong>" +
            quantity_html(last.median.value, last.median.uncertainty, last.median.unit) +
            "</strong> out at a drop of " + quantity_html(last.drop, -1.0, "m") + ".";
  }
  if (text.empty()) {
    const auto emitted = number_at(object_at(run.summary, "particles"), "emitted");
    const auto simulated = number_at(run.summary, "simulated_s");
    if (emitted) text += count_html(*emitted) + " grains were released";
    if (emitted && simulated)
      text += " in " + number_html(*simulated) + "\u202fs of simulated time";
    if (emitted) text += ".";
  }
  return text.empty() ? text : "<p class=\"lede\">" + text + "</p>\n";
}

std::string tile(const std::string& name, const std::string& value, const std::string& note) {
  return "<div class=\"tile\"><dt>" + name + "</dt><dd><b>" + value + "</b>" +
         (note.empty() ? "" : "<span>" + note + "</span>") + "</dd></div>\n";
}

std::string tiles_html(const RunText& run, const Highlights& highlights) {
  std::string text;
  if (!highlights.dust.empty()) {
    const Figure& figure = highlights.dust.front();
    text += tile("Dust", quantity_html(figure.value, figure.uncertainty, figure.unit),
                 escape_html(words(figure.sensor)));
  }
  if (!highlights.stream.empty()) {
    const StreamDrop& last = highlights.stream.back();
    text += tile("Stream, median",
                 quantity_html(last.median.value, last.median.uncertainty, last.median.unit),
                 "at " + quantity_html(last.drop, -1.0, "m") + " drop");
  }
  const auto& grains = object_at(run.summary, "particles");
  if (const auto emitted = number_at(grains, "emitted")) {
    const auto real = number_at(object_at(run.summary, "real_particles"), "emitted");
    text += tile(
        "Grains released", count_html(*emitted),
        real && *real != *emitted ? "for " + count_html(std::round(*real)) + " real ones" : "");
  }
  const auto wall = number_at(run.summary, "wall_s");
  const auto simulated = number_at(run.summary, "simulated_s");
  if (wall) {
    text += tile("Computing time", duration_html(*wall),
                 simulated ? "for " + number_html(*simulated, 3) + "\u202fs simulated" : "");
  }
  return text.empty() ? text : "<dl class=\"tiles\">\n" + text + "</dl>\n";
}

}  // namespace

Highlights highlights_of(const std::vector<Figure>& figures) {
  Highlights highlights;
  std::map<std::pair<std::string, double>, StreamDrop> drops;
  for (const Figure& figure : figures) {
    if (!std::isfinite(figure.value)) continue;
    if (is_per_tonne(figure)) highlights.dust.push_back(figure);
    const double drop = drop_of(figure.name);
    const int quantile = quantile_of(figure.name);
    if (drop < 0.0 || quantile == 0 || figure.unit != "m") continue;
    // Figures of single size classes ("drop_20_mm/300_um/median") are no part of the whole stream.
    if (std::count(figure.name.begin(), figure.name.end(), '/') > 1) continue;
    StreamDrop& entry = drops[{figure.sensor, drop}];
    entry.drop = drop;
    (quantile == 5 ? entry.low : quantile == 50 ? entry.median : entry.high) = figure;
  }
  std::stable_sort(highlights.dust.begin(), highlights.dust.end(),
                   [](const Figure& a, const Figure& b) { return rank_of(a) < rank_of(b); });
  for (const auto& [key, entry] : drops) {
    // One stream only: the first sensor, in the order of the names.
    if (key.first == drops.begin()->first.first && !entry.median.name.empty()) {
      highlights.stream.push_back(entry);
    }
  }
  return highlights;
}

std::string header_html(const RunText& run, const Highlights& highlights) {
  std::string title = text_at(run.report, "title");
  const std::string scenario = text_at(run.summary, "scenario");
  if (title.empty()) title = words(scenario);
  if (title.empty()) title = "Run";
  const std::string status = text_at(run.summary, "status");
  std::string text = "<header>\n<p class=\"eyebrow\"><span>Run report</span>";
  if (!scenario.empty()) text += "<span>" + escape_html(scenario) + "</span>";
  if (!status.empty()) {
    text += "<span class=\"status " + std::string(status == "finished" ? "good" : "bad") + "\">" +
            escape_html(status) + "</span>";
  }
  text += "<button type=\"button\" id=\"theme\" hidden>Dark</button></p>\n<h1>" +
          escape_html(title) + "</h1>\n";
  return text + status_html(run) + lede_html(run, highlights) + tiles_html(run, highlights) +
         "</header>\n";
}

std::string result_html(const Highlights& highlights) {
  if (highlights.dust.size() < 2) return {};
  double largest = 0.0;
  for (const Figure& figure : highlights.dust) largest = std::max(largest, std::abs(figure.value));
  std::string text =
      "<section id=\"dust\"><h2>Where the dust went</h2>\n<div class=\"scroll\"><table "
      "class=\"bars\">\n"
      "<thead><tr><th>Sensor</th><th>Quantity</th><th class=\"n\">Value \u00b1 standard error</th>"
      "<th aria-hidden=\"true\"></th></tr></thead>\n<tbody>\n";
  for (const Figure& figure : highlights.dust) {
    const double share = largest > 0.0 ? std::abs(figure.value) / largest * 100.0 : 0.0;
    char width[32];
    std::snprintf(width, sizeof width, "%.1f", share);
    text += "<tr><td>" + escape_html(words(figure.sensor)) + "</td><td>" +
            escape_html(words(figure.name)) + "</td><td class=\"n\">" +
            quantity_html(figure.value, figure.uncertainty, figure.unit) +
            "</td><td class=\"bar\"><i class=\"dustbar\" style=\"width:" + width +
            "%\"></i></td></tr>\n";
  }
  return text + "</tbody></table></div></section>\n";
}

}  // namespace dust::io
