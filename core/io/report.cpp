// SPDX-License-Identifier: Apache-2.0
#include "io/report.hpp"

#include "base/error.hpp"
#include "io/report_assets.hpp"
#include "io/report_pictures.hpp"
#include "io/report_run.hpp"
#include "io/report_sections.hpp"
#include "io/report_text.hpp"

#include <array>
#include <cmath>
#include <fstream>

namespace dust::io {

namespace {

using nlohmann::json;

constexpr std::size_t k_series_rows = 2000;  ///< more points than a plot has pixels

/// series.csv for the plots: every `stride`th row, the last one included.
json series_json(const std::vector<SeriesColumn>& columns) {
  json list = json::array();
  for (const SeriesColumn& column : columns) {
    const std::size_t rows = column.values.size();
    const std::size_t stride = std::max<std::size_t>(1, (rows + k_series_rows - 1) / k_series_rows);
    json values = json::array();
    for (std::size_t k = 0; k < rows; ++k) {
      if ((rows - 1 - k) % stride != 0) continue;
      const double value = column.values[k];
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

std::string grains_section(const json& grains) {
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
  return "<figure id=\"grains\" class=\"side\"><div class=\"picture\" id=\"grains-picture\"></div>"
         "<figcaption><b>The stream from the side.</b> Grains seen along <i>y</i>, true to scale, "
         "coloured "
         "by diameter. Dust (finer than 100\u202f\u00b5m) is drawn larger than it is, on top, with "
         "its "
         "path over the last frames." +
         note +
         "<span id=\"grains-legend\" class=\"key\"></span><span id=\"grains-count\" "
         "class=\"note\"></span>"
         "<span class=\"note screen\">Double-click to look closer, drag to move. <button "
         "type=\"button\" "
         "id=\"grains-whole\">Whole view</button></span></figcaption></figure>\n";
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
  text += has_places ? "Numbered rings: the places of low mean pressure listed below; eddies "
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
         grains_section(grains) + air_section(air, !highlights.places.empty()) +
         places_html(highlights) +
         "<noscript><p class=\"note\">The pictures are drawn by the page's own script, which is "
         "switched "
         "off here.</p></noscript></section>\n";
}

std::string page(const RunText& run, const json& data, const Highlights& highlights) {
  std::string title = text_at(run.report, "title");
  if (title.empty()) title = words(text_at(run.summary, "scenario"));
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      // The page may ask nobody for anything, whatever stands in the files it was made of.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"dust " DUST_VERSION "\">\n<title>" +
      escape_html(title.empty() ? "Run" : title) + " \u2013 run report</title>\n<style>";
  text += report_asset("uPlot.min.css");
  text += report_asset("report.css");
  text += "</style>\n</head>\n<body>\n<main>\n";
  text += header_html(run, highlights) + result_html(highlights);
  text += pictures_html(data["grains"], data["air"], highlights);
  text += stream_html(highlights);
  text += "<section id=\"curves\" hidden><h2>Fluxes and concentrations</h2></section>\n";
  text += "<section id=\"series\" hidden><h2>The run over time</h2></section>\n";
  text += balance_html(run) + cost_html(run) + health_html(run) + figures_html(run) +
          provenance_html(run);
  text += "<footer>Written by dust " + escape_html(text_at(run.summary, "version")) +
          ". This page is complete in itself and asks no other machine for "
          "anything.</footer>\n</main>\n";
  text += "<script type=\"application/json\" id=\"run-data\">" + script_json(data) + "</script>\n";
  for (const char* name : {"uPlot.iife.min.js", "base.js", "colour.js", "grains.js", "air.js",
                           "stream.js", "curves.js", "graph.js", "main.js"}) {
    text += "<script>";
    text += report_asset(name);
    text += "</script>\n";
  }
  return text + "</body>\n</html>\n";
}

}  // namespace

void write_report(const std::filesystem::path& folder) {
  RunText run = read_run_text(folder);
  const Highlights highlights = highlights_of(run);
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
  }
  data["curves"] = list_at(run.report, "curves");
  data["series"] = series_json(run.series);
  data["stream"] = stream_json(highlights);
  data["places"] = places_json(highlights);
  data["sensors"] = json::array();
  for (const auto& entry : object_at(run.summary, "sensors").items())
    data["sensors"].push_back(entry.key());
  data["graph"] = text_at(run.report, "graph_dot");

  const auto target = folder / "report.html";
  const auto part = folder / "report.html.part";
  {
    std::ofstream stream(part, std::ios::binary);
    stream << page(run, data, highlights);
    stream.close();
    if (!stream) {
      throw base::UserError("error: cannot write " + target.string() +
                            "; make room on the disk or give yourself the right to write there");
    }
  }
  std::error_code failed;
  std::filesystem::rename(part, target, failed);
  if (failed) {
    throw base::UserError("error: cannot replace " + target.string() + ": " + failed.message());
  }
}

}  // namespace dust::io
