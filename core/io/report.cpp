// SPDX-License-Identifier: Apache-2.0
#include "io/report.hpp"

#include "io/report_fast_dust.hpp"
#include "io/report_flight.hpp"
#include "io/report_limits.hpp"
#include "io/report_page.hpp"
#include "io/report_pictures.hpp"
#include "io/report_run.hpp"
#include "io/report_sections.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::io {

namespace {

using nlohmann::json;

constexpr std::size_t k_series_rows = 2000;  ///< more points than a plot has pixels

/// Mean of a column over the rows (first, last], each for the time since the one before.
double mean_between(const std::vector<double>& time, const std::vector<double>& values,
                    std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t k = first + 1; k <= last; ++k) sum += (time[k] - time[k - 1]) * values[k];
  return sum / (time[last] - time[first]);
}

/// series.csv for the plots: every `stride`th row, the last one included. What is a mean over the
/// time since the row before, by `kinds` of summary.json, is that of the rows left out, too.
json series_json(const std::vector<SeriesColumn>& columns, const json& kinds) {
  json list = json::array();
  for (const SeriesColumn& column : columns) {
    const std::size_t rows = column.values.size();
    const std::size_t stride = std::max<std::size_t>(1, (rows + k_series_rows - 1) / k_series_rows);
    const auto kind = kinds.find(column.name + " [" + column.unit + "]");
    const bool is_mean = stride > 1 && kind != kinds.end() && *kind == "mean" &&
                         columns.front().values.size() == rows;
    json values = json::array();
    for (std::size_t k = 0; k < rows; ++k) {
      if ((rows - 1 - k) % stride != 0) continue;
      const double value = is_mean && k >= stride
                               ? mean_between(columns.front().values, column.values, k - stride, k)
                               : column.values[k];
      if (std::isfinite(value)) {
        // Single precision prints short; a plot shows no more.
        values.push_back(static_cast<float>(value));
      } else {
        values.push_back(nullptr);
      }
    }
    list.push_back({{"name", column.name}, {"unit", column.unit}, {"values", std::move(values)}});
  }
  return list;
}

json stream_json(const Highlights& highlights) {
  json list = json::array();
  const auto part = [](const Figure& figure) -> json {
    if (figure.name.empty()) return nullptr;
    return {{"value", figure.value}, {"error", figure.uncertainty}};
  };
  for (const StreamDrop& drop : highlights.stream) {
    list.push_back({{"drop", drop.drop},
                    {"low", part(drop.low)},
                    {"median", part(drop.median)},
                    {"high", part(drop.high)}});
  }
  return list;
}

/// Places of low pressure, for the map.
json places_json(const Highlights& highlights) {
  json list = json::array();
  for (const LowPlace& place : highlights.places) {
    list.push_back({{"name", place.name}, {"x", place.x.value}, {"z", place.z.value}});
  }
  return list;
}

/// Where dust parted from the load, for the map: the squares that matter.
json partings_json(const Highlights& highlights) {
  constexpr double k_least = 0.02;  // share
  json list = json::array();
  for (const Parting& parting : highlights.partings) {
    if (parting.share < k_least) continue;
    list.push_back(
        {{"x", parting.x}, {"z", parting.z}, {"side", k_parting_side}, {"share", parting.share}});
  }
  return list;
}

/// Paths of single grains in still air, of the finest and the coarsest coarse class.
json lone_json(const json& report, double speed, double gravity, double deepest) {
  const json& setting = object_at(report, "setting");
  const auto air_density = number_at(object_at(setting, "fluid"), "density");
  const auto viscosity = number_at(object_at(setting, "fluid"), "viscosity");
  double density = 0.0;
  for (const json& emitter : list_at(setting, "emitters")) {
    const double own = number_at(emitter, "density").value_or(0.0);
    // Which grains are whose is not told; coarse ones fly as those they stand for.
    if ((density != 0.0 && own != density) || emitter.contains("stands_for")) return json::array();
    density = own;
  }
  std::vector<double> sizes;
  for (const json& diameter : list_at(report, "classes")) {
    if (diameter.is_number() && diameter >= k_dust_diameter) sizes.push_back(diameter);
  }
  json list = json::array();
  if (!air_density || !viscosity || !(density > 0.0) || sizes.empty()) return list;
  std::sort(sizes.begin(), sizes.end());
  if (sizes.size() > 2) sizes = {sizes.front(), sizes.back()};
  constexpr int k_points = 40;
  std::vector<double> drops;
  // Closer together at the start, where the path is level.
  for (int k = 0; k <= k_points; ++k) drops.push_back(deepest * (k * k) / (k_points * k_points));
  for (const double size : sizes) {
    const auto places =
        lone_flight({size, density, speed}, {*air_density, *viscosity}, gravity, drops);
    if (places.empty()) continue;
    list.push_back({{"diameter", size}, {"x", places}, {"drop", drops}});
  }
  return list;
}

/// Free flight without air from a level belt, x = v sqrt(2 h / g): the reference of the stream.
/// Only for belts so fast that grains leave at the top of the pulley, v^2 >= g R: from slower ones
/// they slide off farther round, and no closed form without friction tells where.
json flights_json(const json& report, double deepest) {
  const json& setting = object_at(report, "setting");
  const json& gravity = list_at(setting, "gravity");
  json list = json::array();
  const bool is_down = gravity.size() == 3 && gravity[0] == 0.0 && gravity[1] == 0.0 &&
                       gravity[2].is_number() && gravity[2] < 0.0;
  if (!is_down) return list;
  for (const json& belt : list_at(setting, "belts")) {
    const auto speed = number_at(belt, "speed");
    const double fall = -gravity[2].get<double>();
    const double radius = number_at(belt, "radius").value_or(0.0);
    if (speed && *speed > 0.0 && *speed * *speed >= fall * radius) {
      list.push_back({{"name", text_at(belt, "name")},
                      {"speed", *speed},
                      {"gravity", fall},
                      {"lone", lone_json(report, *speed, fall, deepest)}});
    }
  }
  return list;
}

std::string grains_section(const json& grains, bool has_air) {
  if (grains.is_null()) return {};
  std::string note;
  const double share = grains["share"].get<double>(),
               dust_share = grains["dust_share"].get<double>();
  if (share < 1.0) {
    note += " One coarse grain in " + number_html(1.0 / share, 3) + " is shown (up to " +
            count_html(grains["most"].get<double>()) + " per frame were computed).";
  }
  if (dust_share < 1.0) {
    note += " One dust grain in " + number_html(1.0 / dust_share, 3) + " is shown.";
  }
  if (grains["frames"].size() < grains["written"].get<std::size_t>()) {
    note += " " + std::to_string(grains["frames"].size()) + " of " +
            count_html(grains["written"].get<double>()) + " frames are shown.";
  }
  const bool has_dust =
      std::any_of(grains["classes"].begin(), grains["classes"].end(), [&](const json& diameter) {
        return diameter.is_number() && diameter < grains["dust_below"];
      });
  std::string text =
      "<figure id=\"grains\" class=\"side\"><div class=\"picture\" id=\"grains-picture\"></div>"
      "<figcaption><b>From the side</b>, " +
      std::string(has_air ? "grains and air" : "the grains") +
      ". Seen along <i>y</i>, true to scale." +
      (has_dust
           ? " Dust (finer than 100\u202f\u00b5m) is drawn larger than it is, on top, with its "
             "path over the last frames."
           : "") +
      note +
      "<span class=\"choices screen\"><label>Colour of the grains <select id=\"grains-colour\">"
      "<option value=\"size\">diameter</option>";
  if (grains["speed"].get<double>() > 0.0) text += "<option value=\"speed\">speed</option>";
  text += "</select></label>";
  if (has_air) {
    text +=
        "<label><input type=\"checkbox\" id=\"grains-air\" checked> speed of the air behind "
        "them</label>";
  }
  return text +
         "</span><span id=\"grains-legend\" class=\"key\"></span><span id=\"grains-scale\" "
         "class=\"key\"></span><span id=\"grains-air-scale\" class=\"key\"></span>"
         "<span id=\"grains-count\" class=\"note\"></span>"
         "<span class=\"note screen\">Double-click or <kbd>+</kbd> to look closer, drag or arrow "
         "keys to move. <button type=\"button\" id=\"grains-whole\">Whole view</button></span>"
         "</figcaption></figure>\n";
}

std::string air_section(const json& air, bool has_places) {
  if (air.is_null()) return {};
  const char* depth =
      air["middle"].get<bool>() ? "in the middle plane" : "averaged over the depth <i>y</i>";
  std::string note;
  if (air["frames"].size() < air["written"].get<std::size_t>()) {
    note = " " + std::to_string(air["frames"].size()) + " of " +
           count_html(air["written"].get<double>()) + " frames are shown.";
  }
  std::string text =
      "<div class=\"pair\">\n<figure id=\"speed\"><div class=\"picture\" id=\"speed-picture\">"
      "</div><div id=\"speed-legend\" class=\"key\"></div><figcaption><b>Speed of the air</b> ";
  text += depth;
  text +=
      ", in m/s. The threads follow the air for a short while, longer where it is faster; their "
      "thick "
      "end leads. Highest speed of all frames: " +
      number_html(air["top_speed"].get<double>(), 3) + "\u202fm/s" +
      "; the colours follow the root of the speed, so that slow air shows, and end at " +
      number_html(air["speed"].get<double>(), 3) + "\u202fm/s" +
      " (99.8\u202f% of the cells of the fullest frame lie below)." + note +
      " <label class=\"screen\"><input type=\"checkbox\" id=\"air-dust\" checked> show the "
      "dust</label> <label class=\"screen\"><input type=\"checkbox\" id=\"air-mean\"> mean over "
      "the second half of the run instead of one moment</label>"
      "</figcaption></figure>\n";
  text +=
      "<figure id=\"pressure\"><div class=\"picture\" id=\"pressure-picture\"></div><div "
      "id=\"pressure-legend\" class=\"key\"></div><figcaption><b>Pressure of the air</b> ";
  text += depth;
  text += ", in Pa, without the hydrostatic part. ";
  text += has_places ? "Numbered rings: the places of low mean pressure listed above; eddies "
                       "wander, so look at them in the mean (switch in the figure before). "
                     : "The ring marks the lowest pressure of the frame. ";
  text += "Range over all frames: " + number_html(air["low"].get<double>(), 3) + "\u202fPa" +
          " to " + number_html(air["high"].get<double>(), 3) + "\u202fPa" +
          ".</figcaption></figure>\n</div>\n";
  return text;
}

std::string pictures_html(const json& grains, const json& air, const Highlights& highlights) {
  if (grains.is_null() && air.is_null()) return {};
  return "<section id=\"pictures\"><h2>The run in pictures</h2>\n<div id=\"clock\" class=\"clock "
         "screen\"></div>\n" +
         grains_section(grains, !air.is_null()) + air_section(air, !highlights.places.empty()) +
         "<noscript><p class=\"note\">The pictures are drawn by the page's own script, which is "
         "switched "
         "off here.</p></noscript></section>\n";
}

std::string body_html(const RunText& run, const json& data, const Highlights& highlights,
                      const std::string& explanation) {
  std::string text = header_html(run, highlights) + result_html(highlights);
  text += extraction_html(highlights, !data["air"].is_null(), !data["dust_map"].is_null());
  text += pictures_html(data["grains"], data["air"], highlights);
  text += setting_html(run, data["bodies"]);
  text += stream_html(highlights) + references_html(run);
  text += own_sections_html(run);
  text += "<section id=\"curves\" hidden><h2>Curves of the sensors</h2></section>\n";
  text += "<section id=\"series\" hidden><h2>The run over time</h2></section>\n";
  text += balance_html(run) + health_html(run, explanation) + cost_html(run) + figures_html(run) +
          provenance_html(run);
  return text + footer_html(text_at(run.summary, "version"));
}

/// The places where dust parted from the load, from squares in volumes to shares and to grams per
/// tonne where the densities are known. Errors are those of counting independent grains.
std::vector<Parting> partings_of(const std::vector<DustOrigin>& origins,
                                 const Highlights& highlights, double load) {
  double all = 0.0;
  for (const DustOrigin& origin : origins) {
    for (const auto& [diameter, volume] : origin.volume) all += volume;
  }
  const auto density_of = [&](double diameter) {
    for (const DustClass& entry : highlights.classes) {
      if (std::abs(entry.diameter - diameter) <= 1e-5 * diameter) return entry.density;
    }
    return -1.0;
  };
  std::vector<Parting> list;
  for (const DustOrigin& origin : origins) {
    Parting parting{origin.x, origin.z, {}, 0.0, 0.0};
    double mass = 0.0, mass_squares = 0.0, squares = 0.0;
    bool has_density = load > 0.0;
    for (const auto& [diameter, volume] : origin.volume) {
      const double to_mass = std::numbers::pi / 6.0 * density_of(diameter);
      has_density = has_density && to_mass > 0.0;
      const double square = origin.squares.at(diameter);
      parting.share += volume / all;
      squares += square / all / all;
      mass += to_mass * volume;
      mass_squares += to_mass * to_mass * square;
    }
    // Binomial: a share of one has no error.
    parting.share_error = std::sqrt(squares * std::max(0.0, 1.0 - parting.share));
    if (has_density) {
      constexpr double k_grams_per_tonne = 1e6;
      parting.amount.value = k_grams_per_tonne * mass / load;
      parting.amount.uncertainty = k_grams_per_tonne * std::sqrt(mass_squares) / load;
      parting.amount.unit = "g/t";
    }
    list.push_back(parting);
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Parting& a, const Parting& b) { return a.share > b.share; });
  return list;
}

/// Asks the frames how much dust lies near each place, and where dust is at all.
json look_for_dust(const H5Source& source, const View& view, Highlights& highlights) {
  std::vector<DustPlace> places;
  for (const LowPlace& place : highlights.places) {
    places.push_back({place.x.value, place.z.value, k_reach, 0.0});
  }
  const DustMap map = dust_map_of(source, view, places);
  if (!map.share.empty()) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      highlights.places[k].dust_share = places[k].share;
    }
  }
  return dust_map_json(map, view);
}

/// Why fine grains overlap beyond their radius, with what the frames tell of it.
std::string explain_crushed(const H5Source& source, const json& air, const Highlights& highlights,
                            double overlap) {
  const double air_speed = air.is_null() ? 0.0 : air["top_speed"].get<double>();
  const auto viscosity = source.attribute("/fluid", "viscosity");
  const auto finest = std::min_element(
      highlights.classes.begin(), highlights.classes.end(),
      [](const DustClass& a, const DustClass& b) { return a.diameter < b.diameter; });
  const bool is_known = finest != highlights.classes.end();
  return crushed_dust_html(overlap, fast_dust_of(source, air_speed),
                           is_known ? finest->diameter : 0.0, is_known ? finest->density : 0.0,
                           viscosity.empty() ? 0.0 : viscosity.front());
}

}  // namespace

void write_report(const std::filesystem::path& folder) {
  RunText run = read_run_text(folder);
  Highlights highlights = highlights_of(run);
  std::string explanation;
  json data;
  {
    const H5Source source(folder / "results.h5");
    if (!source.is_open() && std::filesystem::exists(folder / "results.h5")) {
      run.notes.emplace_back("results.h5 cannot be read: the pictures are missing.");
    }
    const json bodies = bodies_of(run.report, source);
    const View view = view_of(source, bodies, run.scenario);
    data["view"] = {view.min_x, view.min_z, view.max_x, view.max_z};
    data["bodies"] = bodies;
    data["grains"] = grains_of(source, view, list_at(run.report, "classes"));
    data["air"] = air_of(source);
    data["dust_map"] = look_for_dust(source, view, highlights);
    const double load = number_at(object_at(run.summary, "mass_kg"), "emitted").value_or(0.0);
    if (!view.is_empty()) {
      highlights.partings =
          partings_of(dust_origins(source, view, k_parting_side), highlights, load);
    }
    if (const double overlap = crushed_overlap(run); overlap > 0.0) {
      explanation = explain_crushed(source, data["air"], highlights, overlap);
    }
  }
  data["curves"] = list_at(run.report, "curves");
  data["series"] = series_json(run.series, object_at(run.summary, "series"));
  data["stream"] = stream_json(highlights);
  data["places"] = places_json(highlights);
  data["partings"] = partings_json(highlights);
  data["sensors"] = json::array();
  for (const auto& entry : object_at(run.summary, "sensors").items())
    data["sensors"].push_back(entry.key());
  const double deepest = highlights.stream.empty() ? 0.0 : highlights.stream.back().drop;
  data["flights"] = flights_json(run.report, deepest);
  data["graph"] = text_at(run.report, "graph_dot");

  Page page;
  page.title = run_title(run);
  page.kind = "run report";
  page.body = body_html(run, data, highlights, explanation);
  page.data = std::move(data);
  page.scripts = {"grains.js", "air.js",   "extraction.js", "stream.js",
                  "curves.js", "graph.js", "run.js"};
  write_page(folder / "report.html", page_html(page));
}

}  // namespace dust::io
