// SPDX-License-Identifier: Apache-2.0
#include "io/report_pictures.hpp"
#include "io/report_sections.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

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

/// The diameter in "class_10_um/grams_per_tonne" [m]; negative when the path names no size class.
double class_of(const std::string& path) {
  const auto at = path.find("class_");
  if (at == std::string::npos) return -1.0;
  const char* begin = path.c_str() + at + 6;
  char* end = nullptr;
  const double value = std::strtod(begin, &end);
  if (end == begin) return -1.0;
  return value * (std::string(end).rfind("_mm", 0) == 0 ? 1e-3 : 1e-6);
}

/// Keeps what is dust: of a sensor that tells size classes apart only its fine classes; a sensor
/// that does not is taken at its word.
void keep_dust(std::vector<Figure>& figures) {
  std::set<std::string> with_classes;
  for (const Figure& figure : figures) {
    if (class_of(figure.name) >= 0.0) with_classes.insert(figure.sensor);
  }
  std::erase_if(figures, [&](const Figure& figure) {
    const double diameter = class_of(figure.name);
    return diameter >= 0.0 ? diameter >= k_dust_diameter : with_classes.count(figure.sensor) > 0;
  });
}

/// Where there is but one class of dust, naming it everywhere tells nothing.
void drop_only_class(Highlights& highlights) {
  std::set<double> diameters;
  for (const auto* list : {&highlights.dust, &highlights.held}) {
    for (const Figure& figure : *list) {
      if (class_of(figure.name) >= 0.0) diameters.insert(class_of(figure.name));
    }
  }
  if (diameters.size() > 1) return;
  for (auto* list : {&highlights.dust, &highlights.held}) {
    for (Figure& figure : *list) {
      if (figure.name.rfind("class_", 0) == 0) {
        figure.name = figure.name.substr(figure.name.find('/') + 1);
      }
    }
  }
}

/// By convention a sensor with "out" among the words of its name watches an opening.
bool is_opening(const std::string& sensor) {
  return has("_" + sensor + "_", "_out_") || has(sensor, "escape");
}

/// "carry back, grains of 10 um"; the quantity's own name when it says more than the unit does.
std::string place_html(const Figure& figure) {
  // Of "dust_out_below_belt" the place is what tells it from the other openings.
  const auto out = figure.sensor.find("_out_");
  std::string text =
      "<em>" +
      escape_html(words(out == std::string::npos ? figure.sensor : figure.sensor.substr(out + 5))) +
      "</em>";
  const double diameter = class_of(figure.name);
  if (diameter >= 0.0) text += " (grains of " + quantity_html(diameter, -1.0, "m") + ")";
  const std::string leaf = leaf_of(figure.name);
  if (leaf != "grams_per_tonne") text += " (" + escape_html(words(leaf)) + ")";
  return text;
}

int rank_of(const Figure& figure) {
  const std::string text = figure.sensor + "/" + figure.name;
  if (has(text, "loose") || has(text, "liberated")) return 0;
  return has(text, "dust") ? 1 : 2;
}

/// Dust in the load [g/t] by the books of the size classes; negative without them.
double dust_fed(const nlohmann::json& summary) {
  double dust = 0.0, all = 0.0;
  for (const auto& entry : list_at(summary, "size_classes")) {
    const auto mass = number_at(object_at(entry, "mass_kg"), "emitted");
    const auto diameter = number_at(entry, "diameter_m");
    if (!mass || !diameter) return -1.0;
    all += *mass;
    if (*diameter < k_dust_diameter) dust += *mass;
  }
  constexpr double k_grams_per_tonne = 1e6;
  return all > 0.0 ? k_grams_per_tonne * dust / all : -1.0;
}

/// Gathers "place_1/x", "place_1/z" and "place_1/depth" of a sensor.
void collect_place(const Figure& figure, std::map<std::string, LowPlace>& places) {
  const auto at = figure.name.rfind('/');
  if (at == std::string::npos || figure.name.rfind("place_", 0) != 0) return;
  const std::string leaf = leaf_of(figure.name), name = figure.name.substr(0, at);
  LowPlace& place = places[figure.sensor + "/" + name];
  place.name = name.substr(name.rfind('_') + 1);
  if (leaf == "x") place.x = figure;
  if (leaf == "z") place.z = figure;
  if (leaf == "depth") place.depth = figure;
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

/// Sums of what independent sensors count; errors add in squares. A figure that counted nothing has
/// no error and adds none.
Figure sum_of(const std::vector<Figure>& figures) {
  Figure sum;
  double squares = 0.0;
  for (const Figure& figure : figures) {
    sum.value += figure.value;
    if (figure.uncertainty > 0.0) squares += figure.uncertainty * figure.uncertainty;
  }
  sum.unit = figures.empty() ? "" : figures.front().unit;
  sum.uncertainty = squares > 0.0 ? std::sqrt(squares) : -1.0;
  return sum;
}

std::string share_html(double value, double whole) {
  return whole > 0.0 ? number_html(100.0 * value / whole, 2) + "\u202f%" : std::string("\u2013");
}

/// "0.012 +- 0.003 g/t at <em>carry back</em>, ..." for up to `most` figures from `first` on.
std::string list_html(const std::vector<Figure>& figures, std::size_t first, std::size_t most) {
  std::string text;
  for (std::size_t k = first; k < figures.size() && k < first + most; ++k) {
    const Figure& figure = figures[k];
    if (!text.empty()) text += ", ";
    text += figure.value == 0.0 ? std::string("none")
                                : quantity_html(figure.value, figure.uncertainty,
                                                figure.unit.empty() ? "g/t" : figure.unit);
    text += (is_opening(figure.sensor) ? " " : " at ") + place_html(figure);
  }
  return text;
}

std::string dust_sentence(const Highlights& highlights) {
  const bool has_openings = !highlights.openings.empty();
  const auto& list = has_openings              ? highlights.openings
                     : highlights.dust.empty() ? highlights.held
                                               : highlights.dust;
  if (list.empty()) return {};
  if (std::all_of(list.begin(), list.end(), [](const Figure& f) { return f.value == 0.0; })) {
    return std::string("<strong>No dust has been counted") +
           (has_openings ? " at the openings" : "") + ".</strong>";
  }
  const Figure first = has_openings ? sum_of(list) : list.front();
  const bool is_small = first.value < 0.1;  // g/t
  const double factor = is_small ? 1e3 : 1.0;
  std::string text = "<strong>" +
                     value_html(first.value * factor,
                                first.uncertainty > 0.0 ? first.uncertainty * factor : -1.0) +
                     "\u202f" + (is_small ? "mg" : "g") + " of dust per tonne</strong> of load ";
  text += has_openings ? "get out" : "is found at " + place_html(first);
  if (highlights.fed > 0.0) {
    text += ", " + share_html(first.value, highlights.fed) + " of the dust fed";
  }
  const std::string rest = list_html(list, has_openings ? 0 : 1, 3);
  if (!rest.empty()) text += (has_openings ? ": " : ", ") + rest;
  return text + ".";
}

std::string lede_html(const RunText& run, const Highlights& highlights) {
  std::string text = dust_sentence(highlights);
  if (!highlights.stream.empty()) {
    const StreamDrop& last = highlights.stream.back();
    text += std::string(text.empty() ? "" : " ") + "After a drop of " +
            quantity_html(last.drop, -1.0, "m") + " the middle of the stream has come <strong>" +
            quantity_html(last.median.value, last.median.uncertainty, last.median.unit) +
            "</strong> forward.";
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

/// The mean pressure of a place; three digits where no error tells how many count.
std::string depth_html(const LowPlace& place) {
  if (place.depth.uncertainty > 0.0) {
    return quantity_html(-place.depth.value, place.depth.uncertainty, place.depth.unit);
  }
  return number_html(-place.depth.value, 3) + "\u202f" + escape_html(place.depth.unit);
}

std::string tile(const std::string& name, const std::string& value, const std::string& note) {
  return "<div class=\"tile\"><dt>" + name + "</dt><dd><b>" + value + "</b>" +
         (note.empty() ? "" : "<span>" + note + "</span>") + "</dd></div>\n";
}

std::string tiles_html(const RunText& run, const Highlights& highlights) {
  std::string text;
  const std::string of_fed =
      highlights.fed > 0.0 ? "of " + quantity_html(highlights.fed, -1.0, "g/t") + " in the load"
                           : std::string();
  if (!highlights.openings.empty()) {
    const Figure sum = sum_of(highlights.openings);
    text += tile("Dust that gets out", quantity_html(sum.value, sum.uncertainty, sum.unit), of_fed);
  } else if (!highlights.dust.empty()) {
    const Figure& figure = highlights.dust.front();
    text += tile("Dust, " + escape_html(words(figure.sensor)),
                 quantity_html(figure.value, figure.uncertainty, figure.unit), of_fed);
  }
  if (!highlights.places.empty()) {
    const LowPlace& place = highlights.places.front();
    text += tile("Lowest pressure, at x and z",
                 number_html(place.x.value * 1e3, 3) + ", " + number_html(place.z.value * 1e3, 3) +
                     "\u202f<span class=\"unit\">mm</span>",
                 depth_html(place));
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

Highlights highlights_of(const RunText& run) {
  Highlights highlights;
  std::map<std::pair<std::string, double>, StreamDrop> drops;
  std::map<std::string, LowPlace> places;
  std::set<std::string> stocks;  // sensors that say what is there, not what passes
  for (const Figure& figure : run.figures) {
    if (leaf_of(figure.name) == "mass_at_end") stocks.insert(figure.sensor);
  }
  for (const Figure& figure : run.figures) {
    if (!std::isfinite(figure.value)) continue;
    // Of passages to and fro what remains counts.
    const bool is_one_way = has(figure.name, "forward/") || has(figure.name, "backward/");
    if (is_per_tonne(figure) && !is_one_way) {
      (stocks.count(figure.sensor) > 0 ? highlights.held : highlights.dust).push_back(figure);
    }
    collect_place(figure, places);
    const double drop = drop_of(figure.name);
    const int quantile = quantile_of(figure.name);
    if (drop < 0.0 || quantile == 0 || figure.unit != "m") continue;
    // Figures of single size classes ("drop_20_mm/300_um/median") are no part of the whole stream.
    if (std::count(figure.name.begin(), figure.name.end(), '/') > 1) continue;
    StreamDrop& entry = drops[{figure.sensor, drop}];
    entry.drop = drop;
    (quantile == 5 ? entry.low : quantile == 50 ? entry.median : entry.high) = figure;
  }
  highlights.fed = dust_fed(run.summary);
  keep_dust(highlights.dust);
  keep_dust(highlights.held);
  drop_only_class(highlights);
  for (const Figure& figure : highlights.dust) {
    if (is_opening(figure.sensor)) highlights.openings.push_back(figure);
  }
  std::erase_if(highlights.dust, [](const Figure& figure) { return is_opening(figure.sensor); });
  const auto is_larger = [](const Figure& a, const Figure& b) { return a.value > b.value; };
  std::stable_sort(highlights.openings.begin(), highlights.openings.end(), is_larger);
  std::stable_sort(highlights.held.begin(), highlights.held.end(), is_larger);
  std::stable_sort(highlights.dust.begin(), highlights.dust.end(),
                   [](const Figure& a, const Figure& b) { return rank_of(a) < rank_of(b); });
  for (const auto& [key, entry] : drops) {
    // One stream only: the first sensor, in the order of the names.
    if (key.first == drops.begin()->first.first && !entry.median.name.empty()) {
      highlights.stream.push_back(entry);
    }
  }
  for (auto& [key, place] : places) {
    if (place.depth.value > 0.0 && !place.x.name.empty() && !place.z.name.empty()) {
      highlights.places.push_back(place);
    }
  }
  std::stable_sort(
      highlights.places.begin(), highlights.places.end(),
      [](const LowPlace& a, const LowPlace& b) { return a.depth.value > b.depth.value; });
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
  if (!highlights.has_dust()) return {};
  double largest = highlights.fed;
  for (const auto* list : {&highlights.openings, &highlights.dust, &highlights.held}) {
    for (const Figure& figure : *list) largest = std::max(largest, std::abs(figure.value));
  }
  const auto line = [&](const std::string& what, double value, const std::string& shown,
                        const char* bar) {
    char width[32];
    std::snprintf(width, sizeof width, "%.1f",
                  largest > 0.0 ? std::abs(value) / largest * 100.0 : 0.0);
    return "<tr><td>" + what + "</td><td class=\"n\">" + shown + "</td><td class=\"n\">" +
           share_html(value, highlights.fed) + "</td><td class=\"bar\">" +
           (value == 0.0
                ? std::string()
                : std::string("<i class=\"") + bar + "\" style=\"width:" + width + "%\"></i>") +
           "</td></tr>\n";
  };
  const auto group = [&](const char* title, const std::vector<Figure>& list) {
    if (list.empty()) return std::string();
    std::string text = std::string("<tr class=\"group\"><th colspan=\"4\" scope=\"rowgroup\">") +
                       title + "</th></tr>\n";
    for (const Figure& figure : list) {
      text +=
          line(place_html(figure), figure.value,
               figure.value == 0.0 ? std::string("none counted")
                                   : quantity_html(figure.value, figure.uncertainty, figure.unit),
               "dustbar");
    }
    return text;
  };
  std::string text =
      "<section id=\"dust\"><h2>Where the dust goes</h2>\n<div class=\"scroll\"><table "
      "class=\"bars\">\n<thead><tr><th>Grains finer than 100\u202f\u00b5m</th><th "
      "class=\"n\">Per tonne of load \u00b1 standard error</th><th class=\"n\">Share of the dust "
      "fed</th><th aria-hidden=\"true\"></th></tr></thead>\n<tbody>\n";
  if (highlights.fed > 0.0) {
    text += line("In the load", highlights.fed, quantity_html(highlights.fed, -1.0, "g/t"), "fed");
  }
  text += group("Gets out", highlights.openings) + group("Passes", highlights.dust) +
          group("Is there at the end", highlights.held);
  return text +
         "</tbody></table></div>\n<p class=\"note\">What passes is counted per tonne released in "
         "the "
         "same time, after the sensor's start-up; what is there at the end, per tonne released "
         "until "
         "then. The same dust may pass several sensors: shares need not add up to the whole.</p>"
         "</section>\n";
}

std::string places_html(const Highlights& highlights) {
  if (highlights.places.empty()) return {};
  std::string text =
      "<h3>Where suction would find low pressure</h3>\n<div class=\"scroll\"><table "
      "class=\"narrow\"><thead><tr><th>Ring</th><th class=\"n\">x</th><th class=\"n\">z</th><th "
      "class=\"n\">Mean pressure</th></tr></thead>\n<tbody>\n";
  for (const LowPlace& place : highlights.places) {
    const auto cell = [](const std::string& shown) { return "<td class=\"n\">" + shown + "</td>"; };
    text += "<tr><td>" + escape_html(place.name) + "</td>" +
            cell(number_html(place.x.value * 1e3, 3) + "\u202fmm") +
            cell(number_html(place.z.value * 1e3, 3) + "\u202fmm") + cell(depth_html(place)) +
            "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string stream_html(const Highlights& highlights) {
  // Curves alone may fill the section: the page's script shows it then.
  std::string text = std::string("<section id=\"stream\"") +
                     (highlights.stream.empty() ? " hidden" : "") +
                     "><h2>The path of the stream</h2>\n<div id=\"stream-picture\"></div>\n";
  if (highlights.stream.empty()) return text + "</section>\n";
  text +=
      "<div class=\"scroll\"><table><thead><tr><th class=\"n\">Drop</th><th class=\"n\">5\u202f% "
      "</th><th class=\"n\">Median</th><th class=\"n\">95\u202f%</th></tr></thead>\n<tbody>\n";
  const auto cell = [](const Figure& figure) {
    return "<td class=\"n\">" +
           (figure.name.empty() ? std::string("\u2013")
                                : quantity_html(figure.value, figure.uncertainty, figure.unit)) +
           "</td>";
  };
  for (const StreamDrop& drop : highlights.stream) {
    text += "<tr><td class=\"n\">" + quantity_html(drop.drop, -1.0, "m") + "</td>" +
            cell(drop.low) + cell(drop.median) + cell(drop.high) + "</tr>\n";
  }
  return text + "</tbody></table></div></section>\n";
}

}  // namespace dust::io
