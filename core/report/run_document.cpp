// SPDX-License-Identifier: Apache-2.0
#include "report/run_document.hpp"

#include "report/facts/dust_document.hpp"
#include "report/facts/fast_dust.hpp"
#include "report/facts/limits.hpp"
#include "report/facts/run_facts.hpp"
#include "report/facts/stream_document.hpp"
#include "report/pictures/pictures.hpp"
#include "report/run_text.hpp"
#include "report/space/space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dust::report {

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
json look_for_dust(const H5Source& source, const View& view, bool is_thin, const DustSizes& dust,
                   Highlights& highlights) {
  std::vector<DustPlace> places;
  for (const LowPlace& place : highlights.places) {
    DustPlace& asked = places.emplace_back();
    asked.x = place.x.value;
    asked.z = place.z.value;
    asked.reach = k_reach;
    const bool has_depth = !is_thin && !place.y.name.empty() && std::isfinite(place.y.value);
    if (has_depth) asked.y = place.y.value;
  }
  const DustMap map = dust_map_of(source, view, dust, places);
  if (!map.share.empty()) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      highlights.places[k].dust_share = places[k].share;
    }
  }
  return dust_map_json(map, view);
}

/// What the frames tell of fine grains that overlap beyond their radius.
json crushed_json(const H5Source& source, const DustSizes& dust, const json& air,
                  const Highlights& highlights, double overlap) {
  const double air_speed = air.is_null() ? 0.0 : air["top_speed"].get<double>();
  const FastDust fast = fast_dust_of(source, dust, air_speed);
  json crushed = {{"overlap", overlap},
                  {"thrown_speed", k_thrown},
                  {"fast", fast.fast},
                  {"all", fast.all},
                  {"limit_speed", fast.limit}};
  const auto viscosity = source.attribute("/fluid", "viscosity");
  const auto finest = std::min_element(
      highlights.classes.begin(), highlights.classes.end(),
      [](const DustClass& a, const DustClass& b) { return a.diameter < b.diameter; });
  if (finest == highlights.classes.end() || viscosity.empty()) return crushed;
  const double path = stopping_distance(finest->diameter, finest->density, viscosity.front());
  if (!(path > 0.0)) return crushed;
  crushed["finest_m"] = finest->diameter;
  crushed["stopping_distance_m"] = path;
  return crushed;
}

/// What only the frames can tell. `highlights` learns where the dust is and where it parted.
json frames_json(const std::filesystem::path& folder, RunText& run, Highlights& highlights) {
  const H5Source source(folder / "results.h5");
  if (!source.is_open() && std::filesystem::exists(folder / "results.h5")) {
    run.notes.emplace_back("results.h5 cannot be read: the pictures are missing.");
  }
  if (const std::size_t missing = source.missing_frames("/particles"); missing > 0) {
    run.notes.emplace_back(std::to_string(missing) +
                           " frames of results.h5 are missing or damaged (folder frames): what "
                           "they showed is not in the pictures.");
  }
  json data;
  const json bodies = bodies_of(run.report, source);
  const View view = view_of(source, bodies, run.scenario);
  data["view"] = {view.min_x, view.min_z, view.max_x, view.max_z};
  data["bodies"] = bodies;
  const Box box = box_of(source, run.scenario);
  data["grains"] = grains_of(source, view, box, run.dust, list_at(run.report, "classes"));
  std::vector<std::string> airborne;
  const json airborne_classes = object_at(object_at(run.summary, "dust_field"), "classes");
  for (const auto& entry : airborne_classes.items()) airborne.push_back(entry.key());
  data["space"] = space_of(source, box, airborne);
  data["air"] = air_of(source);
  data["dust_map"] = look_for_dust(source, view, box.is_thin(), run.dust, highlights);
  data["release_map"] = release_map_of(source);
  data["sensor_maps"] = sensor_maps_of(source);
  const double load = number_at(object_at(run.summary, "mass_kg"), "emitted").value_or(0.0);
  if (!view.is_empty()) {
    highlights.partings =
        partings_of(dust_origins(source, view, run.dust, k_parting_side), highlights, load);
  }
  const double overlap = crushed_overlap(run);
  data["crushed"] = overlap > 0.0 ? crushed_json(source, run.dust, data["air"], highlights, overlap)
                                  : json(nullptr);
  return data;
}

json document_of(const std::filesystem::path& folder, RunText run) {
  Highlights highlights = highlights_of(run);
  json data = frames_json(folder, run, highlights);
  data["schema"] = "dust.report/1";
  data["kind"] = "run";
  // What the run itself left for the report, as it stands.
  for (const char* key : {"sections", "curves", "tables", "classes"}) {
    data[key] = list_at(run.report, key);
  }
  data["title"] = text_at(run.report, "title");
  data["setting"] = object_at(run.report, "setting");
  data["dust_rule"] = object_at(run.report, "dust_rule");
  data["outline"] = list_at(run.report, "outline");
  data["graph_dot"] = text_at(run.report, "graph_dot");
  data["summary"] = run.summary;
  data["scenario"] = run.scenario;
  data["series"] = series_json(run.series, object_at(run.summary, "series"));
  data["dust"] = dust_json(highlights, run.dust);
  data["extraction"] = extraction_json(highlights);
  data["stream"] = stream_json(highlights);
  data["flights"] = flights_json(run.report, run.dust, highlights.stream);
  data["references"] = references_json(run.summary);
  data["balance"] = balance_json(run.summary);
  data["cost"] = cost_json(run);
  data["limits"] = limits_json(run);
  data["notes"] = run.notes;
  return data;
}

}  // namespace

json run_document(const std::filesystem::path& folder) {
  return document_of(folder, read_run_text(folder));
}

json run_document(const std::filesystem::path& folder, const json& summary, const json& report) {
  return document_of(folder, read_run_text(folder, summary, report));
}

}  // namespace dust::report
