// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "report/compare.hpp"
#include "report/pictures/pictures.hpp"

#include <algorithm>
#include <cmath>

namespace dust::report {

namespace {

using nlohmann::json;

/// Means of blocks of `stride` values; a block with a gap is a gap.
json block_means(const json& list, std::size_t stride) {
  json means = json::array();
  for (std::size_t from = 0; from < list.size(); from += stride) {
    const std::size_t to = std::min(from + stride, list.size());
    double sum = 0.0;
    bool is_whole = true;
    for (std::size_t k = from; k < to; ++k) {
      is_whole = is_whole && list[k].is_number();
      if (is_whole) sum += list[k].get<double>();
    }
    if (is_whole) {
      means.push_back(sum / static_cast<double>(to - from));
    } else {
      means.push_back(nullptr);
    }
  }
  return means;
}

/// Turns places [m] on the x axis into mm, unless they reach across a plant; how the axis says it.
const char* scale_places(json& lines) {
  double farthest = 0.0;
  for (const json& line : lines) {
    for (const json& x : line["x"]) {
      if (x.is_number()) farthest = std::max(farthest, std::abs(x.get<double>()));
    }
  }
  if (farthest >= base::k_plant_extent) return ", m";
  for (json& line : lines) {
    for (json& x : line["x"]) {
      if (x.is_number()) x = 1e3 * x.get<double>();
    }
  }
  return ", mm";
}

/// Curves of the sensors that both runs have, over each other.
json curve_plots(const Comparison& c) {
  // Rates sampled at every step are mostly noise of single grains.
  constexpr std::size_t k_points = 100;
  json plots = json::array();
  const auto label = [](const std::string& text) { return text.substr(0, text.find(" [")); };
  for (const json& a : list_at(c.first.report, "curves")) {
    for (const json& b : list_at(c.second.report, "curves")) {
      bool is_same = true;
      for (const char* key : {"sensor", "title", "series", "x_label", "y_label"}) {
        is_same = is_same && text_at(a, key) == text_at(b, key);
      }
      // What both were held against is no difference between them.
      if (!is_same || text_at(a, "kind") == "reference") continue;
      json lines = json::array();
      bool is_zero = true;
      for (const auto& [curve, name] :
           {std::pair{&a, c.first_name}, std::pair{&b, c.second_name}}) {
        const json& x = list_at(*curve, "x");
        const json& y = list_at(*curve, "y");
        if (x.size() != y.size() || x.size() < 2) continue;
        const auto is_less = [](const json& u, const json& v) {
          return u.is_number() && v.is_number() && u < v;
        };
        if (std::adjacent_find(x.begin(), x.end(), [&](const json& u, const json& v) {
              return !is_less(u, v);
            }) != x.end()) {
          continue;  // a plot needs one value per place
        }
        for (const json& v : y) is_zero = is_zero && (!v.is_number() || v == 0.0);
        const std::size_t stride = (x.size() + k_points - 1) / k_points;
        lines.push_back(
            {{"name", name}, {"x", block_means(x, stride)}, {"y", block_means(y, stride)}});
      }
      if (lines.empty() || is_zero) continue;
      const std::string y_label = text_at(a, "y_label"), series = text_at(a, "series");
      const auto open = y_label.rfind('['), close = y_label.rfind(']');
      const bool has_unit = open != std::string::npos && close != std::string::npos && close > open;
      std::string x_label = text_at(a, "x_label");
      if (const auto at = x_label.find(" [m]"); at != std::string::npos) {
        x_label.replace(at, 4, scale_places(lines));
      } else if (x_label.ends_with(" [s]")) {
        x_label.replace(x_label.size() - 4, 4, ", s");
      }
      plots.push_back({{"title", text_at(a, "sensor") + ", " + text_at(a, "title")},
                       {"x_label", x_label},
                       {"y_label", label(y_label) + (series.empty() ? "" : ", " + series)},
                       {"unit", has_unit ? y_label.substr(open + 1, close - open - 1) : ""},
                       {"lines", lines}});
    }
  }
  return plots;
}

/// Columns of series.csv that belong to no sensor, over each other.
json series_plots(const Comparison& c) {
  constexpr std::size_t k_points = 800;
  json plots = json::array();
  const auto line_of = [&](const RunText& run, const SeriesColumn& column,
                           const std::string& name) {
    json x = json::array(), y = json::array();
    const auto& times = run.series.front().values;
    const std::size_t stride = std::max<std::size_t>(1, (times.size() + k_points - 1) / k_points);
    for (std::size_t k = 0; k < times.size() && k < column.values.size(); k += stride) {
      x.push_back(times[k]);
      if (std::isfinite(column.values[k])) {
        y.push_back(column.values[k]);
      } else {
        y.push_back(nullptr);
      }
    }
    return json{{"name", name}, {"x", x}, {"y", y}};
  };
  for (const SeriesColumn& a : c.first.series) {
    if (&a == &c.first.series.front() || a.name.find('/') != std::string::npos) continue;
    for (const SeriesColumn& b : c.second.series) {
      if (b.name != a.name || b.unit != a.unit || a.values.size() < 2 || b.values.size() < 2)
        continue;
      const auto is_nothing = [](double v) { return !(std::abs(v) > 0.0); };
      if (std::all_of(a.values.begin(), a.values.end(), is_nothing) &&
          std::all_of(b.values.begin(), b.values.end(), is_nothing)) {
        continue;
      }
      plots.push_back(
          {{"title", a.name},
           {"x_label", "time, s"},
           {"y_label", "value"},
           {"unit", a.unit == "1" ? "" : a.unit},
           {"lines", {line_of(c.first, a, c.first_name), line_of(c.second, b, c.second_name)}}});
    }
  }
  return plots;
}

json pictures_of(const std::filesystem::path& folder, const RunText& run, const std::string& name) {
  const H5Source source(folder / "results.h5");
  const json bodies = bodies_of(run.report, source);
  const View view = view_of(source, bodies, run.scenario);
  return {{"name", name},
          {"view", {view.min_x, view.min_z, view.max_x, view.max_z}},
          {"bodies", bodies},
          {"grains", grains_of(source, view, box_of(source, run.scenario), run.dust,
                               list_at(run.report, "classes"))},
          {"air", air_of(source)}};
}

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json pairs_json(const std::vector<QuantityPair>& pairs) {
  json list = json::array();
  for (const QuantityPair& pair : pairs) {
    list.push_back({{"group", pair.group},
                    {"name", pair.name},
                    {"unit", pair.unit},
                    {"first", finite(pair.first)},
                    {"first_error", pair.first_error > 0.0 ? json(pair.first_error) : json()},
                    {"first_reason", pair.first_reason},
                    {"second", finite(pair.second)},
                    {"second_error", pair.second_error > 0.0 ? json(pair.second_error) : json()},
                    {"second_reason", pair.second_reason},
                    {"difference", finite(pair.difference())},
                    {"in_errors", finite(pair.in_errors())}});
  }
  return list;
}

json scenario_json(const std::vector<ScenarioDifference>& differences) {
  json list = json::array();
  for (const ScenarioDifference& d : differences) {
    list.push_back({{"path", d.path}, {"first", d.first}, {"second", d.second}});
  }
  return list;
}

}  // namespace

json comparison_document(const Comparison& c, const std::filesystem::path& first,
                         const std::filesystem::path& second) {
  json data;
  data["schema"] = "dust.report/1";
  data["kind"] = "comparison";
  data["names"] = {c.first_name, c.second_name};
  data["status"] = {text_at(c.first.summary, "status"), text_at(c.second.summary, "status")};
  data["is_same_state"] = c.is_same_state;
  data["errors_of_one_run"] = k_errors_of_one_run;
  data["headline"] = pairs_json(c.headline);
  data["quantities"] = pairs_json(c.quantities);
  data["scenario"] = scenario_json(c.scenario);
  data["runs"] = {pictures_of(first, c.first, c.first_name),
                  pictures_of(second, c.second, c.second_name)};
  data["plots"] = {{"curves", curve_plots(c)}, {"series", series_plots(c)}};
  return data;
}

void write_comparison(const Comparison& c, const std::filesystem::path& first,
                      const std::filesystem::path& second, const std::filesystem::path& target,
                      const Templates& templates) {
  write_page(target, page_of(templates, "compare.html", comparison_document(c, first, second)));
}

}  // namespace dust::report
