// SPDX-License-Identifier: Apache-2.0
#include "study/hoods/hood_results.hpp"

#include "base/error.hpp"
#include "base/process/shell_word.hpp"
#include "dust/sdk/sampling.hpp"
#include "io/atomic_file.hpp"
#include "report/highlights.hpp"
#include "report/run_text.hpp"
#include "scenario/text/tree.hpp"
#include "scenario/text/units.hpp"
#include "study/hoods/hood_study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

constexpr double k_grams_per_tonne = 1e6;

/// The hood of a point: the group of its body, and its flow.
struct Hood {
  std::string place;
  double flow = 0.0;                 ///< [m3/s]
  std::optional<sdk::Vec3> opening;  ///< [m] its middle
};

/// A quantity of a scenario in SI.
std::optional<double> si_of(const scenario::Node& node, sdk::Dimension dimension) {
  std::string error;
  const auto written = scenario::split_number(node.text, error);
  return written ? scenario::to_si(*written, dimension, error) : std::nullopt;
}

/// The middle of two corners [m].
std::optional<sdk::Vec3> middle_of(const scenario::Node* min, const scenario::Node* max) {
  if (min == nullptr || max == nullptr || min->items.size() != 3 || max->items.size() != 3) {
    return std::nullopt;
  }
  sdk::Vec3 middle;
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    const auto low = si_of(min->items[n], sdk::dimension::length);
    const auto high = si_of(max->items[n], sdk::dimension::length);
    if (!low || !high) return std::nullopt;
    middle[d] = 0.5 * (*low + *high);
  }
  return middle;
}

std::optional<Hood> hood_of(const std::string& scenario_text, const std::string& file) {
  scenario::Diagnostics diagnostics;
  const auto root = scenario::parse_yaml(scenario_text, file, false, diagnostics);
  const auto child = [](const scenario::Node* node, const char* key) -> const scenario::Node* {
    const scenario::Entry* entry = node != nullptr ? node->find(key) : nullptr;
    return entry != nullptr ? &entry->value : nullptr;
  };
  const scenario::Node* body = child(child(root ? &*root : nullptr, "bodies"), k_hood_body);
  const scenario::Node* flow = child(child(body, "suction"), "flow");
  const scenario::Node* group = child(body, "group");
  if (flow == nullptr || group == nullptr) return std::nullopt;
  const auto value = si_of(*flow, sdk::dimension::volume_flow);
  if (!value) return std::nullopt;
  const scenario::Node* suction = child(body, "suction");
  return Hood{group->text, *value, middle_of(child(suction, "min"), child(suction, "max"))};
}

/// A column of series.csv by name; null where there is none.
const report::SeriesColumn* column_of(const report::RunText& run, const std::string& name) {
  const auto at = std::find_if(run.series.begin(), run.series.end(),
                               [&](const auto& column) { return column.name == name; });
  return at == run.series.end() ? nullptr : &*at;
}

/// How fast totals of series.csv grow after the time at which counting begins.
class Growth {
 public:
  explicit Growth(const report::RunText& run) : run_(run), time_(column_of(run, "time")) {
    if (time_ == nullptr || time_->values.empty()) return;
    const double first = report::number_at(report::object_at(run.summary, "start_from"), "time_s")
                             .value_or(time_->values.front());
    begin_ = first + k_settling * (time_->values.back() - first);
  }
  /// The sum of the columns per second, each by the factor that `takes` gives its name.
  template <class Takes>
  [[nodiscard]] Uncertain of(const Takes& takes) const {
    if (time_ == nullptr) return {};
    const std::size_t rows = time_->values.size();
    std::vector<double> total(rows, 0.0);
    for (const report::SeriesColumn& column : run_.series) {
      const auto factor = static_cast<double>(takes(column.name));
      if (factor == 0.0 || column.values.size() != rows) continue;
      for (std::size_t n = 0; n < rows; ++n) total[n] += factor * column.values[n];
    }
    sdk::BatchMeans means(1);
    for (std::size_t n = 1; n < rows; ++n) {
      const double duration = time_->values[n] - time_->values[n - 1];
      if (time_->values[n - 1] < begin_ - 1e-9 || !(duration > 0.0)) continue;
      const double rate = (total[n] - total[n - 1]) / duration;
      means.add({&rate, 1}, duration);
    }
    if (!(means.duration() > 0.0)) return {};
    // A rate that still changes is known to what its batches scatter.
    const double error = means.error(0);
    return {means.mean(0), error == sdk::k_not_steady ? means.deviation(0) : error};
  }
  /// [s] counted.
  [[nodiscard]] double duration() const {
    return time_ == nullptr || time_->values.empty() ? 0.0 : time_->values.back() - begin_;
  }

 private:
  const report::RunText& run_;
  const report::SeriesColumn* time_;
  double begin_ = 0.0;
};

/// Hoods of a point: the one that is tried, or those that stand there anyway.
enum class Hoods : std::uint8_t { tried, others };

/// Is it a column of one of them, that ends with `what`?
bool is_of(const std::string& column, Hoods hoods, const std::string& what) {
  constexpr const char* k_of_hoods = "hoods/";
  const bool is_tried = column == k_of_hoods + std::string(k_hood_body) + what;
  if (hoods == Hoods::tried) return is_tried;
  return column.starts_with(k_of_hoods) && column.ends_with(what) && !is_tried;
}

/// Columns of all dust that a hood has drawn, and of the part that came out of the dust field.
constexpr const char* k_dust = "/dust";
constexpr const char* k_field_dust = "/field_dust";

/// [kg] of a computed grain of dust in the mean over those that hoods have drawn; 0 without any.
double mass_of_drawn(const report::RunText& run, Hoods hoods) {
  double count = 0.0, mass = 0.0;
  for (const auto& table : report::list_at(run.report, "tables")) {
    const std::string column = "hoods/" + report::text_at(table, "sensor") + k_dust;
    if (column_of(run, column) == nullptr || !is_of(column, hoods, k_dust)) continue;
    for (const auto& row : report::list_at(table, "rows")) {
      if (!row.is_array() || row.size() != 3 || !run.dust.is_dust(1e-6 * row[0].get<double>())) {
        continue;
      }
      count += row[1].get<double>();
      mass += 1e-3 * row[2].get<double>();
    }
  }
  return count > 0.0 ? mass / count : 0.0;
}

/// A part without an error leaves the sum without one; a part that is not there does not.
Uncertain sum(const Uncertain& a, const Uncertain& b) {
  if (a.value == 0.0) return b;
  if (b.value == 0.0) return a;
  if (a.error < 0.0 || b.error < 0.0) return {a.value + b.value, -1.0};
  return {a.value + b.value, std::hypot(a.error, b.error)};
}

bool is_of_field(const std::string& name, const char* end) {
  return name.starts_with("dust_field/") && name.ends_with(end);
}

/// What hoods draw out.
struct Drawn {
  Uncertain rate;         ///< [kg/s]
  double computed = 0.0;  ///< computed grains of it; negative: a field
};

Drawn drawn_by(Hoods hoods, const report::RunText& run, const Growth& growth) {
  const Uncertain field =
      growth.of([&](const std::string& name) { return is_of(name, hoods, k_field_dust); });
  Uncertain grains = growth.of([&](const std::string& name) {
    return is_of(name, hoods, k_dust) ? 1.0 : is_of(name, hoods, k_field_dust) ? -1.0 : 0.0;
  });
  Drawn drawn{.computed = field.value > 0.0 ? -1.0 : 0.0};
  if (const double mass = mass_of_drawn(run, hoods); mass > 0.0) {
    drawn.computed = grains.value * growth.duration() / mass;
    // What few grains tell is known no better than by counting.
    const double counting = mass * std::sqrt(drawn.computed) / growth.duration();
    if (drawn.computed > 0.0) grains.error = std::max(grains.error, counting);
  }
  if (grains.value == 0.0) grains.error = -1.0;
  drawn.rate = sum(grains, field);
  return drawn;
}

HoodTrial trial_of(const report::RunText& run, double flow) {
  const Growth growth(run);
  const Drawn tried = drawn_by(Hoods::tried, run, growth);
  const Drawn others = drawn_by(Hoods::others, run, growth);
  HoodTrial trial{.flow = flow, .drawn = tried.rate, .drawn_by_others = others.rate};
  trial.load = growth.of([](const std::string& name) { return name == "mass_emitted"; }).value;
  const bool is_counted = tried.computed >= 0.0 && others.computed >= 0.0;
  trial.computed = is_counted ? tried.computed + others.computed : -1.0;
  // Per time: a load that has ended, or is not even, has no amount per tonne.
  const report::Highlights highlights = report::highlights_of(run);
  const bool has_rates = !highlights.leaving.empty();
  const report::Figure out = report::sum_of(has_rates ? highlights.leaving : highlights.openings);
  const double scale = has_rates ? 1.0 : trial.load / k_grams_per_tonne;
  const Uncertain left =
      growth.of([](const std::string& name) { return is_of_field(name, "/left"); });
  trial.escaping =
      sum({out.value * scale, out.uncertainty > 0.0 ? out.uncertainty * scale : -1.0}, left);
  return trial;
}

/// From here on the scatter of runs with other seeds tells the error of their mean.
constexpr std::size_t k_min_replicas = 3;

/// The mean of runs with other seeds. They begin with the same state, so that their own errors are
/// not independent: its error is theirs in the mean or, of three and more, that of their scatter
/// \f$ s / \sqrt{n} \f$, whichever is larger.
Uncertain mean_of_replicas(std::span<const Uncertain> runs) {
  const auto count = static_cast<double>(runs.size());
  Uncertain mean;
  for (const Uncertain& run : runs) mean.value += run.value / count;
  double own = 0.0, squares = 0.0;
  bool is_open = false;
  for (const Uncertain& run : runs) {
    own += std::max(run.error, 0.0) / count;
    squares += std::pow(run.value - mean.value, 2);
    is_open = is_open || (run.value != 0.0 && run.error < 0.0);
  }
  if (is_open) return mean;
  const bool has_scatter = runs.size() >= k_min_replicas;
  const double error =
      std::max(own, has_scatter ? std::sqrt(squares / (count * (count - 1.0))) : 0.0);
  if (error > 0.0) mean.error = error;
  return mean;
}

/// Folders of the points of a study, all of them finished.
std::vector<fs::path> finished_points(const fs::path& study) {
  const fs::path table = study / "study.csv";
  std::ifstream stream(table, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  const auto head = report::csv_cells(line);
  const auto status = std::find(head.begin(), head.end(), "status") - head.begin();
  const auto hash = std::find(head.begin(), head.end(), "hash") - head.begin();
  std::vector<fs::path> folders;
  std::size_t first_missing = 0, missing = 0;
  for (std::size_t row = 2; std::getline(stream, line); ++row) {
    const auto cells = report::csv_cells(line);
    if (cells.size() != head.size()) continue;
    folders.push_back(study / "points" / cells[static_cast<std::size_t>(hash)]);
    if (cells[static_cast<std::size_t>(status)] == "finished") continue;
    if (missing++ == 0) first_missing = row;
  }
  if (missing > 0) {
    throw base::UserError(table.string() + ":" + std::to_string(first_missing) + ": error: " +
                          std::to_string(missing) + " of " + std::to_string(folders.size()) +
                          " points have not finished: engine study " +
                          base::shell_word((study / "study.yaml").string()) + " -o " +
                          base::shell_word(study.string()) + " --resume");
  }
  return folders;
}

}  // namespace

bool is_study(const fs::path& folder) { return fs::exists(folder / "study.csv"); }

std::optional<Uncertain> HoodTrial::capture() const {
  const Uncertain all = sum(drawn, drawn_by_others);
  const double d = all.value, e = escaping.value;
  if (!(d + e > 0.0)) return std::nullopt;
  Uncertain capture{d / (d + e), -1.0};
  if (capture_error >= 0.0) {
    capture.error = capture_error;
    return capture;
  }
  const bool is_open = (d > 0.0 && all.error < 0.0) || (e > 0.0 && escaping.error < 0.0);
  if (is_open || (all.error < 0.0 && escaping.error < 0.0)) return capture;
  // Errors of the two add in squares, each by its derivative.
  const double of_drawn = e * std::max(all.error, 0.0);
  const double of_escaping = d * std::max(escaping.error, 0.0);
  capture.error = std::hypot(of_drawn, of_escaping) / ((d + e) * (d + e));
  return capture;
}

HoodTrial mean_of(std::span<const HoodTrial> trials) {
  if (trials.size() == 1) return trials.front();
  HoodTrial mean{.flow = trials.front().flow, .computed = 0.0, .replicas = trials.size()};
  std::vector<Uncertain> drawn, drawn_by_others, escaping, captures;
  for (const HoodTrial& trial : trials) {
    drawn.push_back(trial.drawn);
    drawn_by_others.push_back(trial.drawn_by_others);
    escaping.push_back(trial.escaping);
    if (const auto capture = trial.capture()) captures.push_back(*capture);
    mean.load += trial.load / static_cast<double>(trials.size());
    mean.computed += trial.computed;
  }
  mean.drawn = mean_of_replicas(drawn);
  mean.drawn_by_others = mean_of_replicas(drawn_by_others);
  mean.escaping = mean_of_replicas(escaping);
  if (captures.size() >= k_min_replicas) mean.capture_error = mean_of_replicas(captures).error;
  return mean;
}

HoodResults hood_results(const fs::path& study) {
  std::map<std::string, std::map<double, std::vector<HoodTrial>>> trials;
  std::map<std::string, std::optional<sdk::Vec3>> openings;
  std::vector<HoodTrial> plain;
  for (const fs::path& folder : finished_points(study)) {
    const report::RunText run = report::read_run_text(folder);
    const std::string file = (folder / "scenario.yaml").string();
    if (const auto hood = hood_of(io::read_text(file), file)) {
      trials[hood->place][hood->flow].push_back(trial_of(run, hood->flow));
      openings[hood->place] = hood->opening;
    } else {
      plain.push_back(trial_of(run, 0.0));
    }
  }
  if (trials.empty()) {
    throw base::UserError(
        (study / "study.yaml").string() +
        ":1: error: none of its points has a hood that was suggested: give a "
        "study that engine suggest-hoods RUN has written, or the folder of a run");
  }
  HoodResults results;
  for (const auto& [name, flows] : trials) {
    HoodPlace place{name, {}, openings[name]};
    for (const auto& [flow, replicas] : flows) place.trials.push_back(mean_of(replicas));
    results.places.push_back(std::move(place));
  }
  if (!plain.empty()) results.plain = mean_of(plain);
  return results;
}

std::optional<NeededFlow> needed_flow(const HoodPlace& place, double wanted) {
  const HoodTrial* before = nullptr;
  double lower = 0.0;
  for (const HoodTrial& trial : place.trials) {
    const auto capture = trial.capture();
    if (!capture) continue;
    if (capture->value >= wanted) {
      if (before == nullptr) return NeededFlow{trial.flow, true};
      const double part = (wanted - lower) / (capture->value - lower);
      return NeededFlow{before->flow + part * (trial.flow - before->flow), false};
    }
    before = &trial;
    lower = capture->value;
  }
  return std::nullopt;
}

}  // namespace dust::study
