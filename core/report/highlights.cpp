// SPDX-License-Identifier: Apache-2.0
#include "report/highlights.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace dust::report {

namespace {

using nlohmann::json;

/// Keeps what is dust: of a sensor that tells size classes apart only its fine classes; of one that
/// adds up its classes the sum, if all of them are fine; one that does not say what sizes it counts
/// is taken at its word.
void keep_dust(std::vector<Figure>& figures, const std::vector<Figure>& all,
               const DustSizes& dust) {
  std::set<std::string> with_classes, with_coarse;
  for (const Figure& figure : figures) {
    if (figure.is_of_class()) with_classes.insert(figure.sensor);
  }
  for (const Figure& figure : all) {
    if (figure.is_of_class() && !dust.is_dust(figure.size_class()))
      with_coarse.insert(figure.sensor);
  }
  std::erase_if(figures, [&](const Figure& figure) {
    if (figure.is_of_class()) return !dust.is_dust(figure.size_class());
    if (with_classes.count(figure.sensor) > 0) return true;
    if (figure.largest > 0.0) return !figure.is_finer_than(dust.limit());
    return with_coarse.count(figure.sensor) > 0;
  });
}

/// Dust in the load [g/t] by the balance of the size classes; negative without them.
double dust_fed(const nlohmann::json& summary, const DustSizes& sizes) {
  double dust = 0.0, all = 0.0;
  for (const auto& entry : list_at(summary, "size_classes")) {
    const auto mass = number_at(object_at(entry, "mass_kg"), "emitted");
    const auto diameter = number_at(entry, "diameter_m");
    if (!mass || !diameter) return -1.0;
    all += *mass;
    if (sizes.is_dust(*diameter)) dust += *mass;
  }
  constexpr double k_grams_per_tonne = 1e6;
  return all > 0.0 ? k_grams_per_tonne * dust / all : -1.0;
}

/// Gathers the coordinates and the depth of a place of low pressure.
void collect_place(const Figure& figure, std::map<std::pair<std::string, int>, LowPlace>& places) {
  if (figure.role != "low_pressure") return;
  LowPlace& place = places[{figure.sensor, figure.index}];
  place.name = std::to_string(figure.index);
  if (figure.quantity == "x") place.x = figure;
  if (figure.quantity == "y") place.y = figure;
  if (figure.quantity == "z") place.z = figure;
  if (figure.quantity == "depth_of_pressure") place.depth = figure;
}

/// The density of the grains of a class [kg/m3], from any sensor that counts both their mass and
/// their number; negative when none does.
double density_of(const RunText& run, double diameter) {
  for (const Figure& mass : run.figures) {
    if (mass.size_class() != diameter || !(mass.value > 0.0)) continue;
    const bool is_rate = mass.quantity == "mass_rate";
    if (!is_rate && mass.quantity != "mass") continue;
    for (const Figure& number : run.figures) {
      const bool is_same = number.sensor == mass.sensor && number.role == mass.role &&
                           number.direction == mass.direction && number.size_class() == diameter &&
                           number.quantity == (is_rate ? "number_rate" : "number");
      if (!is_same || !(number.value > 0.0)) continue;
      return mass.value / number.value / (std::numbers::pi / 6.0 * std::pow(diameter, 3));
    }
  }
  return -1.0;
}

std::vector<DustClass> classes_of(const RunText& run, const Highlights& highlights) {
  std::map<double, DustClass> classes;
  const auto found = [&](double diameter) -> DustClass& {
    // Diameters come from names and from the balance: equal but for rounding.
    for (auto& [key, entry] : classes) {
      if (std::abs(key - diameter) <= 1e-6 * diameter) return entry;
    }
    classes[diameter].diameter = diameter;
    return classes[diameter];
  };
  double all = 0.0;
  const json& size_classes = list_at(run.summary, "size_classes");
  const auto mass_of = [](const json& entry) {
    return number_at(object_at(entry, "mass_kg"), "emitted").value_or(0.0);
  };
  for (const json& entry : size_classes) all += mass_of(entry);
  for (const json& entry : size_classes) {
    const double diameter = number_at(entry, "diameter_m").value_or(1.0);
    if (run.dust.is_dust(diameter) && all > 0.0) found(diameter).fed = 1e6 * mass_of(entry) / all;
  }
  std::map<double, std::vector<Figure>> out;
  for (const Figure& figure : highlights.openings) {
    if (figure.is_of_class()) out[figure.size_class()].push_back(figure);
  }
  for (const auto& [diameter, list] : out) found(diameter).out = sum_of(list);
  for (const Figure& figure : run.figures) {
    const double diameter = figure.size_class();
    if (!(diameter > 0.0 && run.dust.is_dust(diameter))) continue;
    DustClass& entry = found(diameter);
    if (entry.density < 0.0) entry.density = density_of(run, diameter);
  }
  std::vector<DustClass> list;
  list.reserve(classes.size());
  for (const auto& [key, entry] : classes) list.push_back(entry);
  return list;
}

struct Halves {
  double earlier = 0.0, later = 0.0;  ///< means
};

/// The means of a rate over both halves of the last `duration`. A row holds the mean over the time
/// since the row before.
Halves halves_of(const std::vector<double>& times, const std::vector<double>& rates,
                 double duration) {
  Halves halves;
  if (times.empty() || times.size() != rates.size()) return halves;
  double sums[2] = {0.0, 0.0}, spans[2] = {0.0, 0.0};
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double before_end = times.back() - times[k];
    if (before_end >= duration || !std::isfinite(rates[k])) continue;
    const std::size_t half = before_end < 0.5 * duration ? 1 : 0;
    sums[half] += rates[k] * (times[k] - times[k - 1]);
    spans[half] += times[k] - times[k - 1];
  }
  if (spans[0] > 0.0) halves.earlier = sums[0] / spans[0];
  if (spans[1] > 0.0) halves.later = sums[1] / spans[1];
  return halves;
}

/// What all openings let out over both halves of the last `duration` [kg/s], by the columns of
/// series.csv whose roles say so.
Halves rates_out(const RunText& run, double duration) {
  Halves all;
  const json& roles = object_at(run.summary, "series_roles");
  for (const SeriesColumn& column : run.series) {
    const json& role = object_at(roles, (column.name + " [" + column.unit + "]").c_str());
    const bool is_out = text_at(role, "role") == "opening" &&
                        text_at(role, "quantity") == "mass_rate" &&
                        text_at(role, "direction") == "net";
    if (!is_out) continue;
    const Halves part = halves_of(run.series.front().values, column.values, duration);
    all.earlier += part.earlier;
    all.later += part.later;
  }
  return all;
}

/// How long the openings were watched, on how many grains their sum rests, and whether it was
/// still changing.
void find_observed_time(const RunText& run, Highlights& highlights) {
  std::set<std::string> sensors;
  for (const Figure& figure : highlights.openings) sensors.insert(figure.sensor);
  for (const Figure& figure : run.figures) {
    if (sensors.count(figure.sensor) > 0 && figure.role == "observed_time") {
      highlights.observed_time = std::max(highlights.observed_time, figure.value);
    }
  }
  if (!(highlights.observed_time > 0.0)) return;
  highlights.counted = 0.0;
  for (const Figure& figure : run.figures) {
    const bool is_dust = figure.is_of_class() && run.dust.is_dust(figure.size_class());
    if (sensors.count(figure.sensor) > 0 && is_dust && figure.quantity == "number_rate" &&
        figure.direction == "forward") {
      highlights.counted += figure.value * highlights.observed_time;
    }
  }
  // A rate is that of all grains of its sensor: of dust alone only where nothing else passes.
  for (const Figure& figure : run.figures) {
    if (sensors.count(figure.sensor) == 0 || figure.role != "opening") continue;
    if (!figure.is_per_load() || figure.is_of_class()) continue;
    double dust = 0.0;
    for (const Figure& part : highlights.openings) {
      if (part.sensor == figure.sensor) dust += part.value;
    }
    if (std::abs(figure.value - dust) > 1e-6 * std::abs(figure.value)) return;
  }
  const Halves all = rates_out(run, highlights.observed_time);
  if (all.earlier > 0.0) highlights.later_over_earlier = all.later / all.earlier;
}

}  // namespace

Figure sum_of(const std::vector<Figure>& figures) {
  Figure sum;
  double squares = 0.0;
  for (const Figure& figure : figures) {
    sum.value += figure.value;
    if (figure.uncertainty > 0.0) squares += figure.uncertainty * figure.uncertainty;
    if (figure.value != 0.0 && !figure.no_error.empty()) sum.no_error = figure.no_error;
  }
  sum.unit = figures.empty() ? "" : figures.front().unit;
  sum.uncertainty = squares > 0.0 && sum.no_error.empty() ? std::sqrt(squares) : -1.0;
  return sum;
}

Highlights highlights_of(const RunText& run) {
  Highlights highlights;
  std::map<std::pair<std::string, double>, StreamDrop> drops;
  std::map<std::pair<std::string, int>, LowPlace> places;
  for (const Figure& figure : run.figures) {
    if (!std::isfinite(figure.value)) continue;
    if (figure.is_per_load()) {
      if (figure.role == "opening") highlights.openings.push_back(figure);
      if (figure.role == "passage") highlights.dust.push_back(figure);
      if (figure.role == "stock") highlights.held.push_back(figure);
    }
    if (figure.is_per_time() && figure.role == "opening") highlights.leaving.push_back(figure);
    collect_place(figure, places);
    // Figures of single size classes are no part of the whole stream.
    if (figure.role != "stream_quantile" || figure.is_of_class()) continue;
    StreamDrop& entry = drops[{figure.sensor, figure.drop}];
    entry.drop = figure.drop;
    (figure.probability < 0.5   ? entry.low
     : figure.probability > 0.5 ? entry.high
                                : entry.median) = figure;
  }
  highlights.fed = dust_fed(run.summary, run.dust);
  keep_dust(highlights.openings, run.figures, run.dust);
  keep_dust(highlights.leaving, run.figures, run.dust);
  keep_dust(highlights.dust, run.figures, run.dust);
  keep_dust(highlights.held, run.figures, run.dust);
  const auto is_larger = [](const Figure& a, const Figure& b) { return a.value > b.value; };
  std::stable_sort(highlights.openings.begin(), highlights.openings.end(), is_larger);
  std::stable_sort(highlights.held.begin(), highlights.held.end(), is_larger);
  std::stable_sort(highlights.dust.begin(), highlights.dust.end(), is_larger);
  for (const auto& [key, entry] : drops) {
    // All at zero: nothing has crossed there yet.
    const bool is_empty =
        entry.low.value == 0.0 && entry.median.value == 0.0 && entry.high.value == 0.0;
    if (is_empty) continue;
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
  highlights.classes = classes_of(run, highlights);
  find_observed_time(run, highlights);
  return highlights;
}

int first_place(const Highlights& highlights) {
  constexpr double k_sure = 2.0;  // standard errors
  int best = -1;
  for (std::size_t k = 0; k < highlights.places.size(); ++k) {
    const LowPlace& place = highlights.places[k];
    if (place.dust_share <= 0.0) continue;
    const bool is_known = place.depth.uncertainty >= 0.0;
    if (!is_known || place.depth.value < k_sure * place.depth.uncertainty) continue;
    if (best < 0 ||
        place.dust_share > highlights.places[static_cast<std::size_t>(best)].dust_share) {
      best = static_cast<int>(k);
    }
  }
  return best >= 0 || highlights.places.empty() ? best : 0;
}

}  // namespace dust::report
