// SPDX-License-Identifier: Apache-2.0
#include "report/compare.hpp"

#include "base/text.hpp"
#include "dust/sdk/vec3.hpp"
#include "report/highlights.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
constexpr double k_nothing = 1e-30;  ///< in any SI unit

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string text_of(const YAML::Node& node) {
  if (node.IsScalar()) return node.Scalar();
  if (node.IsNull()) return "~";
  std::string text;
  for (const YAML::Node& part : node) text += (text.empty() ? "" : ", ") + text_of(part);
  return "[" + text + "]";
}

void flatten(const YAML::Node& node, const std::string& path,
             std::map<std::string, std::string>& keys) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : std::string("?");
      flatten(entry.second, path.empty() ? key : path + "." + key, keys);
    }
    return;
  }
  const bool has_maps = node.IsSequence() && std::any_of(node.begin(), node.end(),
                                                         [](const auto& n) { return n.IsMap(); });
  if (!has_maps) {
    keys[path] = text_of(node);
    return;
  }
  for (std::size_t k = 0; k < node.size(); ++k) {
    flatten(node[k], path + "[" + std::to_string(k) + "]", keys);
  }
}

/// The unit that a key of summary.json ends with: "g_per_tonne", "entered_kg".
std::string unit_of_key(const std::string& name) {
  constexpr std::array<std::pair<const char*, const char*>, 5> k_units = {{{"kg_per_h", "kg/h"},
                                                                           {"g_per_tonne", "g/t"},
                                                                           {"mg_per_kg", "mg/kg"},
                                                                           {"kg", "kg"},
                                                                           {"", "1"}}};
  const auto* const found = std::find_if(
      k_units.begin(), k_units.end(), [&](const auto& unit) { return name.ends_with(unit.first); });
  return found->second;
}

constexpr const char* k_since_zero = " since t = 0";

/// What both runs are compared by.
class Ways {
 public:
  Ways(const RunText& first, const RunText& second, bool is_per_load) : is_per_load_(is_per_load) {
    for (const RunText* run : {&first, &second}) {
      const json& start = object_at(run->summary, "start_from");
      const auto since = number_at(start, "rates_since_s");
      // Of older branches the rates go on, too.
      const bool is_older =
          !since && start.contains("is_same_scenario") && start["is_same_scenario"] == false;
      if (is_older) since_of_rates_ = k_since_zero;
      if (is_older || since.value_or(0.0) > 0.0) since_of_sums_ = k_since_zero;
    }
  }
  [[nodiscard]] bool is_per_load() const { return is_per_load_; }
  /// Behind what goes on through a branch, for it has to balance: with one of the runs it is of two
  /// plants.
  [[nodiscard]] const std::string& since_of_sums() const { return since_of_sums_; }
  /// Of a figure of a block of the summary.
  [[nodiscard]] std::string since_of(const Figure& figure) const {
    if (figure.sensor == "dust_rates" || figure.unit == "1") return "";
    if (figure.name.ends_with("/on_grains_kg")) return "";  // as it is at the end
    return figure.unit == "kg" ? since_of_sums_ : since_of_rates_;
  }

 private:
  bool is_per_load_;
  std::string since_of_sums_, since_of_rates_;
};

/// What a summary says of dust that is a concentration, under the names of its blocks.
std::vector<Figure> field_dust_of(const RunText& run) {
  json blocks = json::object();
  for (const char* key : {"dust_rates", "dust_outflow"}) {
    if (const json& block = object_at(run.summary, key); !block.empty()) blocks[key] = block;
  }
  const json& on_grains = object_at(object_at(run.summary, "dust_on_grains"), "classes");
  if (!on_grains.empty()) blocks["dust_on_grains"] = on_grains;
  std::vector<Figure> figures = figures_of(blocks);
  for (Figure& figure : figures) {
    if (figure.unit.empty()) figure.unit = unit_of_key(figure.name);
  }
  return figures;
}

/// "dust_rates", "left/back/per_load": "dust of the field", "left, back"; nothing for what only the
/// whole list shows.
std::optional<std::string> headline_name(const RunText& run, const Figure& figure,
                                         bool is_per_load) {
  std::vector<std::string> parts{""};
  for (const char c : figure.name) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (figure.sensor == "dust_outflow" && parts.size() == 2 && parts[1] == "kg_per_h") {
    // What a hood catches has not got out.
    const bool is_caught = object_at(run.summary, "hoods").contains(parts[0]);
    return (is_caught ? "caught, " : "got out, ") + parts[0];
  }
  if (figure.sensor == "dust_on_grains" && parts.size() == 2) {
    if (parts[1] == "set_free_kg") return "set free, " + words(parts[0]);
    if (parts[1] == "on_grains_kg") return "on grains, " + words(parts[0]);
  }
  if (figure.sensor != "dust_rates" || parts.size() != 3) return std::nullopt;
  if (parts[2] != (is_per_load ? "per_load" : "rate")) return std::nullopt;
  const bool is_way_out = parts[0] == "left" || parts[0] == "drawn_out";
  if (!is_way_out && parts[1] != "all") return std::nullopt;
  return words(parts[0]) + ", " + parts[1];
}

/// What both runs tell of their dust: amounts per load, unless one of them tells rates alone, and
/// is compared by these.
bool are_per_load(const RunText& first, const RunText& second) {
  const auto has = [](const RunText& run, const char* end) {
    const json& rates = object_at(run.summary, "dust_rates");
    return std::any_of(rates.items().begin(), rates.items().end(),
                       [&](const auto& item) { return item.key().ends_with(end); });
  };
  const auto has_rates_alone = [&](const RunText& run) {
    return has(run, "/rate") && !has(run, "/per_load");
  };
  return !has_rates_alone(first) && !has_rates_alone(second);
}

/// Of these what the first screen names: ways out by name, of the rest the sum.
void add_field_dust(const RunText& run, const Ways& ways, std::vector<Figure>& list) {
  for (Figure figure : field_dust_of(run)) {
    const auto name = headline_name(run, figure, ways.is_per_load());
    if (!name) continue;
    figure.name = *name + ways.since_of(figure);
    figure.sensor = figure.sensor == "dust_rates" ? "dust rate" : "field dust";
    list.push_back(std::move(figure));
  }
}

/// The indices by which practice ranks transfer points.
std::vector<Figure> indices_of(const RunText& run) {
  return figures_of({{"stream_indices", object_at(run.summary, "stream_indices")}});
}

/// Of these what says most: of impacts the sum, and causes per load; not where in the stream.
void add_indices(const RunText& run, std::vector<Figure>& list) {
  for (Figure figure : indices_of(run)) {
    const std::string& name = figure.name;
    const bool is_of_cause = name.starts_with("impact/") && !name.starts_with("impact/all/");
    if (name == "observed" || name.ends_with("/height")) continue;
    if (is_of_cause && !name.ends_with("/per_load")) continue;
    figure.sensor = "index of practice";
    std::string text;
    for (const char c : words(name)) text += c == '/' ? std::string(", ") : std::string(1, c);
    figure.name = text;
    list.push_back(std::move(figure));
  }
}

/// All figures: of the sensors, then of dust in the air and on grains, of the stream.
std::vector<Figure> all_figures(const RunText& run, const Ways& ways) {
  std::vector<Figure> figures = run.figures;
  for (Figure& figure : field_dust_of(run)) {
    figure.name += ways.since_of(figure);
    figures.push_back(std::move(figure));
  }
  const std::vector<Figure> indices = indices_of(run);
  figures.insert(figures.end(), indices.begin(), indices.end());
  return figures;
}

/// Pairs figures of both runs by sensor, name and unit, in the order of the first run; what only
/// the second has comes last. One that the runs tell in two units is told of each by itself.
std::vector<QuantityPair> paired(const std::vector<Figure>& first,
                                 const std::vector<Figure>& second) {
  std::vector<QuantityPair> pairs;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> places;
  for (const Figure& f : first) {
    places[{f.sensor, f.name, f.unit}] = pairs.size();
    pairs.push_back(
        {f.sensor, f.name, f.unit, f.value, f.uncertainty, k_none, -1.0, f.no_error, ""});
  }
  for (const Figure& f : second) {
    const auto found = places.find({f.sensor, f.name, f.unit});
    if (found == places.end()) {
      pairs.push_back(
          {f.sensor, f.name, f.unit, k_none, -1.0, f.value, f.uncertainty, "", f.no_error});
    } else {
      pairs[found->second].second = f.value;
      pairs[found->second].second_error = f.uncertainty;
      pairs[found->second].second_reason = f.no_error;
    }
  }
  return pairs;
}

sdk::Vec3 point_of(const LowPlace& place) {
  return {place.x.value, place.y.name.empty() ? 0.0 : place.y.value, place.z.value};
}

/// Gives places of low pressure the names of those of another run that they are nearest to: a rank
/// by depth may change from run to run where the places do not. What is left over is named last.
void name_as(const std::vector<LowPlace>& others, std::vector<LowPlace>& places) {
  std::vector<const LowPlace*> free;
  for (const LowPlace& other : others) free.push_back(&other);
  std::vector<LowPlace*> unnamed;
  for (LowPlace& place : places) unnamed.push_back(&place);
  while (!free.empty() && !unnamed.empty()) {
    std::pair<std::size_t, std::size_t> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < free.size(); ++a) {
      for (std::size_t b = 0; b < unnamed.size(); ++b) {
        const double distance = norm(point_of(*free[a]) - point_of(*unnamed[b]));
        if (!(distance < nearest)) continue;
        nearest = distance;
        best = {a, b};
      }
    }
    if (!std::isfinite(nearest)) break;
    unnamed[best.second]->name = free[best.first]->name;
    free.erase(free.begin() + static_cast<std::ptrdiff_t>(best.first));
    unnamed.erase(unnamed.begin() + static_cast<std::ptrdiff_t>(best.second));
  }
  for (std::size_t n = 0; n < unnamed.size(); ++n) {
    unnamed[n]->name = std::to_string(others.size() + n + 1);
  }
}

constexpr const char* k_low_pressure = "low pressure";

/// What has been let in and is there, and what it took.
void add_run(const RunText& run, const std::string& since, std::vector<Figure>& list) {
  const auto number = [&](const std::string& name, const json& object, const char* key,
                          const char* unit) {
    const auto value = number_at(object, key);
    if (!value) return;
    Figure reported;
    reported.sensor = "run";
    reported.name = name;
    reported.value = *value;
    reported.unit = unit;
    list.push_back(std::move(reported));
  };
  number("grains released" + since, object_at(run.summary, "particles"), "emitted", "1");
  number("grains in the domain", object_at(run.summary, "particles"), "in_domain", "1");
  number("mass released" + since, object_at(run.summary, "mass_kg"), "emitted", "kg");
  number("mass in the domain", object_at(run.summary, "mass_kg"), "in_domain", "kg");
  number("simulated time" + since, run.summary, "simulated_s", "s");
  number("computing time", run.summary, "wall_s", "s");
}

/// The figures of the first screen under names that compare between runs.
std::vector<Figure> reported_first(const RunText& run, const Highlights& highlights,
                                   const Ways& ways) {
  std::vector<Figure> list;
  const auto add = [&](std::string group, std::string name, const Figure& figure) {
    Figure reported = figure;
    reported.sensor = std::move(group);
    reported.name = std::move(name);
    list.push_back(std::move(reported));
  };
  if (!highlights.openings.empty()) add("dust", "gets out", sum_of(highlights.openings));
  for (const auto* figures : {&highlights.openings, &highlights.dust, &highlights.held}) {
    for (const Figure& figure : *figures) {
      const double diameter = highlights.classes.size() > 1 ? figure.size_class() : -1.0;
      const std::string size =
          diameter > 0.0 ? ", " + base::length_text(diameter, 6) : std::string();
      add("dust", words(figure.sensor) + size, figure);
    }
  }
  add_field_dust(run, ways, list);
  add_indices(run, list);
  for (const StreamDrop& drop : highlights.stream) {
    add("stream", "median at " + base::length_text(drop.drop, 6) + " drop", drop.median);
  }
  for (const LowPlace& place : highlights.places) {
    add(k_low_pressure, "place " + place.name + ", x", place.x);
    if (!place.y.name.empty()) add(k_low_pressure, "place " + place.name + ", y", place.y);
    add(k_low_pressure, "place " + place.name + ", z", place.z);
    add(k_low_pressure, "place " + place.name + ", depth", place.depth);
  }
  for (const Figure& figure : run.figures) {
    if (figure.towards == "overview") add(words(figure.sensor), words(figure.name), figure);
  }
  add_run(run, ways.since_of_sums(), list);
  return list;
}

/// "0.0292 +- 0.0106", as many digits as the error allows.
std::string plain(double value, double error, const std::string& reason) {
  const std::string why = reason.empty() ? "" : " (" + reason + ")";
  if (!std::isfinite(value)) return "-" + why;
  // What is far less than an atom is rounding's.
  if (std::abs(value) < k_nothing) value = 0.0;
  if (!(error > k_nothing) || !std::isfinite(error)) {
    // Counts stay whole.
    return base::digits_text(value, value == std::round(value) ? 12 : 5) + why;
  }
  if (std::max(std::abs(value), error) < 1e-4) {
    return base::digits_text(value, 3) + " +- " + base::digits_text(error, 2);
  }
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12);
  return base::fixed_text(value, decimals) + " +- " + base::fixed_text(error, decimals);
}

/// Whether it says where a place of low pressure is: no amount that would be more or less.
bool is_coordinate(const QuantityPair& pair) {
  return pair.group == k_low_pressure && !pair.name.ends_with("depth");
}

/// Where the places of low pressure are, one behind the other for both runs.
std::string places_text(const Comparison& c) {
  constexpr double k_mm = 1e3;  // per m
  std::map<std::string, std::pair<std::string, std::string>> places;
  const auto add = [](std::string& at, double value) {
    if (std::isfinite(value)) at += (at.empty() ? "" : ", ") + base::digits_text(k_mm * value, 4);
  };
  for (const QuantityPair& pair : c.headline) {
    if (!is_coordinate(pair)) continue;
    auto& [first, second] = places[pair.name.substr(0, pair.name.find(','))];
    add(first, pair.first);
    add(second, pair.second);
  }
  if (places.empty()) return "";
  std::string text = "Places of low pressure:\n";
  const auto shown = [](const std::string& at) {
    return at.empty() ? std::string("(none)") : "(" + at + ") mm";
  };
  for (const auto& [name, at] : places) {
    text += "  " + name + ": " + shown(at.first) + " | " + shown(at.second) + "\n";
  }
  return text;
}

/// Characters, not bytes, so that columns stay in line.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

double QuantityPair::in_errors() const {
  // One error that is not known may be larger than the other by far.
  if (!(first_error >= 0.0 && second_error >= 0.0)) return k_none;
  const double error = std::hypot(first_error, second_error);
  return error > 0.0 ? difference() / error : k_none;
}

std::vector<ScenarioDifference> scenario_differences(const std::string& first,
                                                     const std::string& second) {
  std::map<std::string, std::string> keys[2];
  try {
    flatten(YAML::Load(first), "", keys[0]);
    flatten(YAML::Load(second), "", keys[1]);
  } catch (const YAML::Exception&) {
    return {};
  }
  std::map<std::string, ScenarioDifference> found;
  for (const auto& [path, text] : keys[0]) found[path] = {path, text, ""};
  for (const auto& [path, text] : keys[1]) {
    found[path].path = path;
    found[path].second = text;
  }
  std::vector<ScenarioDifference> list;
  for (const auto& [path, entry] : found) {
    if (entry.first != entry.second) list.push_back(entry);
  }
  return list;
}

Comparison compare_runs(const std::filesystem::path& first, const std::filesystem::path& second) {
  Comparison c;
  c.first = read_run_text(first);
  c.second = read_run_text(second);
  const auto name_of = [](const std::filesystem::path& folder) {
    const auto path = std::filesystem::absolute(folder).lexically_normal();
    return (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
  };
  c.first_name = name_of(first);
  c.second_name = name_of(second);
  if (c.first_name == c.second_name) {
    c.first_name = first.lexically_normal().string();
    c.second_name = second.lexically_normal().string();
  }
  c.scenario = scenario_differences(c.first.scenario, c.second.scenario);
  const Ways ways(c.first, c.second, are_per_load(c.first, c.second));
  const Highlights highlights = highlights_of(c.first);
  Highlights others = highlights_of(c.second);
  name_as(highlights.places, others.places);
  c.headline =
      paired(reported_first(c.first, highlights, ways), reported_first(c.second, others, ways));
  c.quantities = paired(all_figures(c.first, ways), all_figures(c.second, ways));
  const std::string state = text_at(c.first.summary, "state_sha256");
  const bool is_something =
      number_at(object_at(c.first.summary, "particles"), "in_domain").value_or(1.0) > 0.0 ||
      !object_at(object_at(c.first.report, "setting"), "fluid").empty();
  c.is_same_state =
      is_something && !state.empty() && state == text_at(c.second.summary, "state_sha256");
  return c;
}

std::string comparison_text(const Comparison& c) {
  constexpr std::size_t k_max_keys = 20;
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"", "[unit]", c.first_name, c.second_name, "difference", "in errors"});
  for (const QuantityPair& pair : c.headline) {
    if (is_coordinate(pair)) continue;
    char difference[32] = "-", sigmas[32] = "-";
    if (std::isfinite(pair.difference())) {
      const double off = std::abs(pair.difference()) < k_nothing ? 0.0 : pair.difference();
      std::snprintf(difference, sizeof difference, off == std::round(off) ? "%+.12g" : "%+.4g",
                    off);
    }
    if (std::isfinite(pair.in_errors())) {
      std::snprintf(sigmas, sizeof sigmas, "%+.1f", pair.in_errors());
    }
    rows.push_back({pair.group + ": " + pair.name, "[" + pair.unit + "]",
                    plain(pair.first, pair.first_error, pair.first_reason),
                    plain(pair.second, pair.second_error, pair.second_reason), difference, sigmas});
  }
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string space(widths[k] - width_of(row[k]), ' ');
      text += (k == 0 ? "" : "  ") + (k < 2 ? row[k] + space : space + row[k]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  const bool has_errors = std::any_of(c.headline.begin(), c.headline.end(), [](const auto& pair) {
    return std::isfinite(pair.in_errors());
  });
  if (has_errors && !c.is_same_state) text += std::string(k_errors_of_one_run) + '\n';
  text += places_text(c);
  if (c.is_same_state) text += "The end states are the same, bit for bit.\n";
  text += c.scenario.empty() ? "The scenarios are the same.\n" : "The scenarios differ in:\n";
  for (std::size_t k = 0; k < c.scenario.size() && k < k_max_keys; ++k) {
    const ScenarioDifference& d = c.scenario[k];
    text += "  " + d.path + ": " + (d.first.empty() ? "(none)" : d.first) + " | " +
            (d.second.empty() ? "(none)" : d.second) + "\n";
  }
  if (c.scenario.size() > k_max_keys) {
    text += "  and " + std::to_string(c.scenario.size() - k_max_keys) + " more keys\n";
  }
  return text;
}

}  // namespace dust::report
