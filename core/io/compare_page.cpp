// SPDX-License-Identifier: Apache-2.0
#include "io/compare.hpp"
#include "io/report_page.hpp"
#include "io/report_pictures.hpp"
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace dust::io {

namespace {

using nlohmann::json;

constexpr double k_many_errors = 3.0;  ///< a difference worth a second look

std::string difference_html(const QuantityPair& pair) {
  if (!std::isfinite(pair.difference())) return "\u2013";
  if (pair.difference() == 0.0) return "none";
  std::string text = quantity_html(pair.difference(), -1.0, pair.unit);
  if (pair.first != 0.0) {
    text += " (" + number_html(100.0 * pair.difference() / std::abs(pair.first), 2) + "\u202f%)";
  }
  return text;
}

std::string errors_html(const QuantityPair& pair) {
  const double errors = pair.in_errors();
  if (!std::isfinite(errors)) return "\u2013";
  const std::string text = number_html(errors, 2);
  return std::abs(errors) > k_many_errors ? "<strong>" + text + "</strong>" : text;
}

HtmlTable quantity_table(const Comparison& c) {
  return HtmlTable({{"Quantity", false},
                    {escape_html(c.first_name)},
                    {escape_html(c.second_name)},
                    {"Difference"},
                    {"In standard errors"}});
}

void add_row(HtmlTable& table, const QuantityPair& pair) {
  const auto value = [&](double v, double error) {
    if (pair.unit == "1" && error < 0.0 && std::isfinite(v) && v == std::round(v)) {
      return count_html(v);
    }
    return quantity_html(v, error, pair.unit);
  };
  table.row({escape_html(words(pair.name)), value(pair.first, pair.first_error),
             value(pair.second, pair.second_error), difference_html(pair), errors_html(pair)});
}

std::string scenarios_html(const Comparison& c) {
  if (c.scenario.empty()) {
    return "<section><h2>Scenarios</h2>\n<p>Both runs have the same scenario.</p></section>\n";
  }
  HtmlTable table(
      {{"Key", false}, {escape_html(c.first_name), false}, {escape_html(c.second_name), false}});
  const auto cell = [](const std::string& text) {
    return text.empty() ? std::string("\u2013") : escape_html(text);
  };
  for (const ScenarioDifference& d : c.scenario) {
    table.row({"<code>" + escape_html(d.path) + "</code>", cell(d.first), cell(d.second)});
  }
  return "<section id=\"scenarios\"><h2>Where the scenarios differ</h2>\n" + table.html() +
         "</section>\n";
}

std::string quantities_html(const Comparison& c) {
  std::string text;
  for (std::size_t k = 0; k < c.quantities.size();) {
    const std::string& sensor = c.quantities[k].group;
    HtmlTable table = quantity_table(c);
    std::size_t count = 0;
    for (; k < c.quantities.size() && c.quantities[k].group == sensor; ++k, ++count) {
      add_row(table, c.quantities[k]);
    }
    text += "<details><summary>" + escape_html(words(sensor)) + " <small>" + std::to_string(count) +
            (count == 1 ? " figure" : " figures") + "</small></summary>" + table.html() +
            "</details>\n";
  }
  if (text.empty()) return text;
  return "<section id=\"figures\"><h2>All figures</h2>\n" + text + "</section>\n";
}

std::string headline_html(const Comparison& c) {
  HtmlTable table = quantity_table(c);
  std::string group;
  for (const QuantityPair& pair : c.headline) {
    if (pair.group != group) {
      group = pair.group;
      std::string title = words(group);
      if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') {
        title[0] = static_cast<char>(title[0] - 'a' + 'A');
      }
      table.group(escape_html(title));
    }
    add_row(table, pair);
  }
  return table.html() +
         "<p class=\"note\">Differences are those of the second run from the first. In standard "
         "errors: the difference over the root of the sum of both errors squared, for independent "
         "runs; beyond three in bold.</p>\n";
}

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
        x_label.replace(at, 4, ", mm");
        for (json& line : lines) {
          for (json& x : line["x"]) {
            if (x.is_number()) x = 1e3 * x.get<double>();
          }
        }
      } else if (x_label.ends_with(" [s]")) {
        x_label.replace(x_label.size() - 4, 4, ", s");
      }
      plots.push_back({{"title", text_at(a, "sensor") + ", " + text_at(a, "title")},
                       {"x_label", x_label},
                       {"y_label", words(label(y_label) + (series.empty() ? "" : ", " + series))},
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
          {"grains", grains_of(source, view, list_at(run.report, "classes"))},
          {"air", air_of(source)}};
}

bool has_pictures(const json& run) { return !run["grains"].is_null() || !run["air"].is_null(); }

}  // namespace

void write_comparison(const Comparison& c, const std::filesystem::path& first,
                      const std::filesystem::path& second, const std::filesystem::path& target) {
  Page page;
  page.title = c.first_name + " beside " + c.second_name;
  page.kind = "comparison of two runs";
  page.data["runs"] = {pictures_of(first, c.first, c.first_name),
                       pictures_of(second, c.second, c.second_name)};
  page.data["plots"] = {{"curves", curve_plots(c)}, {"series", series_plots(c)}};
  page.scripts = {"compare.js"};

  std::string& text = page.body;
  text = "<header>\n" + heading_html("Comparison", "", "", page.title);
  if (c.is_same_state) {
    text += "<p class=\"lede\"><strong>The end states are the same</strong>, bit for bit.</p>\n";
  }
  for (const auto& [name, run] :
       {std::pair{&c.first_name, &c.first}, {&c.second_name, &c.second}}) {
    const std::string status = text_at(run->summary, "status");
    if (!status.empty() && status != "finished") {
      text += "<p class=\"banner\">" + escape_html(*name) +
              " was not finished: " + escape_html(status) + ".</p>\n";
    }
  }
  text += headline_html(c) + "</header>\n" + scenarios_html(c);
  if (has_pictures(page.data["runs"][0]) || has_pictures(page.data["runs"][1])) {
    text +=
        "<section id=\"pictures\"><h2>Grains and air</h2>\n<div id=\"clock\" class=\"clock "
        "screen\"></div>\n<div class=\"cases\" id=\"cases\"></div></section>\n";
  }
  if (!page.data["plots"]["curves"].empty()) {
    text +=
        "<section id=\"curves\"><h2>Curves of the sensors</h2>\n<div class=\"grid\" "
        "data-plots=\"curves\"></div></section>\n";
  }
  if (!page.data["plots"]["series"].empty()) {
    text +=
        "<section id=\"series\"><h2>The runs over time</h2>\n<div class=\"grid\" "
        "data-plots=\"series\"></div></section>\n";
  }
  text += quantities_html(c) + footer_html(DUST_VERSION);
  write_page(target, page_html(page));
}

}  // namespace dust::io
