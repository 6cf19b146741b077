// SPDX-License-Identifier: Apache-2.0
// Rules of sensors: figures with names, units and errors, nothing from nothing, and the same
// figures through an interruption.
#include "contract/as_kind.hpp"
#include "contract/memory_archive.hpp"
#include "contract/rule_runner.hpp"
#include "contract/scenes/sensor_stream.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace dust::contract {
namespace {

constexpr int k_samples = 90;

/// Figures that are ratios of the same quantity, or counts.
bool is_bare(const std::string& unit) { return unit == "1" || unit == "-" || unit == "g/t"; }

/// What a figure is, as a text.
std::string role_of(const Figure& figure) {
  const sdk::FigureRole& r = figure.role;
  return std::string(sdk::name_of(r.role)) + "," + std::string(sdk::info_of(r.quantity).name) +
         "," + std::string(sdk::name_of(r.direction)) + "," + shown(r.smallest) + "," +
         shown(r.largest) + "," + figure.species + "," + figure.towards + "," +
         shown(r.probability) + "," + shown(r.drop) + "," + std::to_string(r.index);
}

/// The roles of all, to see that they stay.
std::string roles_of(const Figures& figures) {
  std::string text;
  for (const auto& [name, figure] : figures.all()) text += name + ":" + role_of(figure) + ";";
  return text;
}

/// A text as a number that another text hardly has (Fowler, Noll and Vo): parameters that change
/// nothing but roles matter as well.
double number_of(const std::string& text) {
  std::uint64_t sum = 14695981039346656037ull;
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return static_cast<double>(sum % 1000003);
}

/// Whether it says that it has no value, for nothing has passed.
bool is_of_nothing(const Figure& figure) {
  return std::isnan(figure.value) && figure.uncertainty == sdk::k_nothing_passed;
}

void add(Observations& observations, const std::string& from, const Figures& figures) {
  for (const auto& [name, figure] : figures.all()) {
    // Of nothing a figure has no value; that it is so stands in the place of its error.
    Observation r{from + name, is_of_nothing(figure) ? 0.0 : figure.value, sdk::dimension::none};
    if (!is_bare(figure.unit)) {
      const auto unit = scenario::parse_unit(figure.unit);
      r.has_dimension = unit.has_value();
      if (unit) r.dimension = unit->dimension;
    }
    observations.push_back(r);
    // A negative error means "none" and has no unit.
    r.name += " (error)";
    if (figure.uncertainty < 0.0) r.dimension = sdk::dimension::none;
    r.value = figure.uncertainty;
    observations.push_back(r);
    observations.push_back(
        {from + name + " (role)", number_of(role_of(figure)), sdk::dimension::none});
  }
}

class NoReport final : public sdk::ReportSink {
 public:
  void section(std::string_view heading, std::string_view text) override {
    require(!heading.empty(), "a section of its report has no heading");
    require(!text.empty(), "its section '" + std::string(heading) + "' has no text");
  }
  void curve(std::string_view title, std::string_view, std::string_view, std::string_view series,
             std::span<const double> x, std::span<const double> y) override {
    require(x.size() == y.size(), "the curve '" + std::string(title) + "' (" + std::string(series) +
                                      ") has " + std::to_string(x.size()) + " numbers for x and " +
                                      std::to_string(y.size()) + " for y; expected: as many");
  }
  void row(std::string_view title, std::span<const std::string> columns,
           std::span<const double> values) override {
    require(columns.size() == values.size(),
            "the table '" + std::string(title) + "' has a row of " + std::to_string(values.size()) +
                " numbers under a head of " + std::to_string(columns.size()) +
                " columns; expected: as many");
  }
};

std::unique_ptr<sdk::Sensor> run(const Maker& make, const Units& units, bool is_empty) {
  auto sensor = make_as<sdk::Sensor>(make, units);
  SensorStream scene(is_empty, units);
  for (int s = 0; s < k_samples; ++s) scene.show(*sensor);
  return sensor;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto sensor = run(make, variant.units, false);
  Observations observations;
  add(observations, "summary: ", summary_of(*sensor));
  add(observations, "series: ", series_of(*sensor));
  NoReport report;
  sensor->report(report);
  return observations;
}

/// Names, units and sizes of the fields.
class FieldList final : public sdk::FieldSink {
 public:
  void field(std::string_view name, std::string_view unit, const sdk::GridShape& grid,
             std::span<const double> values, const sdk::FigureRole&) override {
    const std::string what = "the field '" + std::string(name) + "' ";
    require(!unit.empty(), what + "has no unit; a bare number has \"1\"");
    require(grid.count[0] > 0 && grid.count[1] > 0 && grid.count[2] > 0, what + "has no cells");
    const auto cells = static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2];
    require(values.size() == cells, what + "has " + std::to_string(values.size()) +
                                        " numbers for " + std::to_string(cells) + " cells");
    for (const double v : values) require(std::isfinite(v), what + "holds " + shown(v));
    names_.emplace_back(name);
    numbers_.insert(numbers_.end(), values.begin(), values.end());
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }

 private:
  std::vector<std::string> names_;
  std::vector<double> numbers_;
};

FieldList fields_of(const sdk::Sensor& sensor) {
  FieldList list;
  sensor.fields(list);
  return list;
}

bool is_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  });
}

void check_names(const Maker& make) {
  const auto sensor = run(make, {}, false);
  std::string unknown;
  for (const bool is_series : {false, true}) {
    const Figures figures = is_series ? series_of(*sensor) : summary_of(*sensor);
    std::set<std::string> seen;
    for (const auto& [name, figure] : figures.all()) {
      require(is_name(name),
              "'" + name + "' is not a path of snake_case words: a to z, 0 to 9, _ and /");
      require(seen.insert(name).second, "'" + name + "' is given twice");
      require(!figure.unit.empty(), "'" + name + "' has no unit; a bare number has \"1\"");
      if (!is_bare(figure.unit) && !scenario::parse_unit(figure.unit)) {
        unknown += " " + name + " [" + figure.unit + "]";
      }
    }
  }
  std::set<std::string> fields;
  const FieldList written = fields_of(*sensor);
  for (const std::string& name : written.names()) {
    require(is_name(name) && name.find('/') == std::string::npos,
            "the field '" + name + "' is not snake_case: a to z, 0 to 9 and _");
    require(fields.insert(name).second, "the field '" + name + "' is given twice");
  }
  if (!unknown.empty()) throw Remark("units the engine does not know:" + unknown);
}

/// The first of two lists of names that differs: "'a [m]', now 'b [m]'".
std::string first_change(const std::vector<std::string>& before,
                         const std::vector<std::string>& now) {
  const auto quoted = [](const std::vector<std::string>& names, std::size_t n) {
    return n < names.size() ? "'" + names[n] + "'" : std::string("nothing");
  };
  std::size_t n = 0;
  while (n < before.size() && n < now.size() && before[n] == now[n]) ++n;
  return quoted(before, n) + ", now " + quoted(now, n);
}
void require_same(const std::vector<std::string>& before, const std::vector<std::string>& now,
                  const std::string& what) {
  require(before == now, what + first_change(before, now) + "; expected: the same names always");
}

/// What must hold of the role of one figure.
void check_role(const std::string& name, const Figure& figure) {
  const sdk::FigureRole& role = figure.role;
  const std::string what = "'" + name + "' ";
  const sdk::QuantityInfo quantity = sdk::info_of(role.quantity);
  const bool is_known = role.quantity != sdk::Quantity::unspecified;
  require(is_known || role.role == sdk::Role::detail,
          what + "has the role " + std::string(sdk::name_of(role.role)) + " but no quantity");
  if (is_known) {
    const bool is_bare_number = is_bare(figure.unit);
    const auto unit = scenario::parse_unit(figure.unit);
    const bool fits = is_bare_number ? quantity.dimension == sdk::dimension::none
                                     : !unit || unit->dimension == quantity.dimension;
    require(fits, what + "is said to be a " + std::string(quantity.name) + ", which has no unit " +
                      figure.unit);
    require(
        (role.quantity == sdk::Quantity::mass_per_load) == (figure.unit == "g/t"),
        what + "has the unit " + figure.unit + "; mass_per_load is given in g/t, and only that");
  }
  require(role.smallest >= 0.0 && (role.largest == 0.0 || role.largest >= role.smallest),
          what + "counts diameters from " + shown(role.smallest) + " to " + shown(role.largest));
  const bool is_quantile = role.role == sdk::Role::stream_quantile;
  require(is_quantile ? role.probability > 0.0 && role.probability < 1.0 : role.probability == 0.0,
          what + "has the probability " + shown(role.probability) +
              "; a stream_quantile has one between 0 and 1, nothing else has any");
  require((role.role == sdk::Role::opening || role.role == sdk::Role::passage) ==
              (role.direction != sdk::Direction::none),
          what + "has the direction " + std::string(sdk::name_of(role.direction)) +
              "; what passes an opening or a place has one, nothing else has any");
  require(role.role != sdk::Role::low_pressure || role.index >= 1,
          what + "is a place of low pressure without an index from 1 on");
}

void check_roles(const Maker& make) {
  const auto seeing = run(make, {}, false);
  const auto blind = run(make, {}, true);
  std::string without;
  for (const bool is_series : {false, true}) {
    const Figures figures = is_series ? series_of(*seeing) : summary_of(*seeing);
    for (const auto& [name, figure] : figures.all()) {
      check_role(name, figure);
      if (figure.role.quantity == sdk::Quantity::unspecified) without += " " + name;
    }
    require(roles_of(figures) == roles_of(is_series ? series_of(*blind) : summary_of(*blind)),
            std::string("the roles of its figures in its ") + (is_series ? "series" : "summary") +
                " depend on what it sees; expected: those of an empty domain");
  }
  if (!without.empty())
    throw Remark("figures without a quantity, which the report just lists:" + without);
}

/// Whether something of the standard stream comes to where the sensor looks.
bool is_met(const Maker& make) {
  const Figures figures = summary_of(*run(make, {}, false));
  return std::any_of(figures.all().begin(), figures.all().end(), [](const auto& named) {
    const auto& figure = named.second;
    // How long it looked is no find.
    return figure.value != 0.0 && !is_of_nothing(figure) &&
           figure.role.role != sdk::Role::observed_time;
  });
}

void check_sees(const Maker& make) {
  const Figures figures = summary_of(*run(make, {}, false));
  int with_error = 0;
  for (const auto& [name, figure] : figures.all()) {
    with_error +=
        figure.uncertainty > 0.0 || !sdk::reason_without_error(figure.uncertainty).empty();
  }
  require(!figures.all().empty(), "its summary is empty after " + std::to_string(k_samples) +
                                      " samples; expected: at least one figure");
  if (!is_met(make)) {
    throw Remark(
        "the standard stream does not meet it: place it with --set, for example "
        "--set min='[0.1, 0, 0.02]'");
  }
  if (with_error == 0)
    throw Remark("no figure has an error or says why it has none; the README should say it");
}

void check_nothing(const Maker& make) {
  const std::vector<std::string> full = summary_of(*run(make, {}, false)).names();
  const auto sensor = make_as<sdk::Sensor>(make);
  const std::vector<std::string> series = series_of(*sensor).names();
  const std::vector<std::string> fields = fields_of(*sensor).names();
  SensorStream scene(true);
  for (int s = 0; s < k_samples; ++s) {
    scene.show(*sensor);
    const std::string when = " in an empty domain after " + std::to_string(s + 1) + " samples: ";
    require_same(series, series_of(*sensor).names(), "the columns of its series change" + when);
    require_same(full, summary_of(*sensor).names(),
                 "the names of its summary are not those beside grains" + when);
    require_same(fields, fields_of(*sensor).names(), "its fields change" + when);
  }
  const Figures nothing = summary_of(*sensor);
  for (const auto& [name, figure] : nothing.all()) {
    if (figure.role.role == sdk::Role::observed_time) continue;  // how long it looked is no find
    require(figure.value == 0.0 || is_of_nothing(figure),
            "'" + name + "' is " + shown(figure.value) +
                " in an empty domain; expected: 0 of an amount, a rate or a count; of a mean, a "
                "place or a ratio no number, with k_nothing_passed for its error "
                "(Role::observed_time: how long it has looked)");
    require(figure.uncertainty <= 0.0, "'" + name + "' has an error of " +
                                           shown(figure.uncertainty) +
                                           " in an empty domain; expected: none");
  }
}

/// What is not known yet (a mean over no time) is the same where it is known to neither.
bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void compare(const Figures& a, const Figures& b, const std::string& when) {
  require_same(a.names(), b.names(), when + "its figures have other names: ");
  for (std::size_t n = 0; n < a.all().size(); ++n) {
    const auto& [name, figure] = a.all()[n];
    require(is_same(figure.value, b.all()[n].second.value) &&
                figure.uncertainty == b.all()[n].second.uncertainty,
            when + "'" + name + "' differs: " + shown(b.all()[n].second.value) +
                ", expected: " + shown(figure.value) + " (save and load keep its state)");
  }
}

void check_restart(const Maker& make) {
  for (const int pause : {0, 1, 37, k_samples - 1}) {
    const auto whole = make_as<sdk::Sensor>(make);
    auto part = make_as<sdk::Sensor>(make);
    SensorStream scene;
    SensorStream same;
    for (int s = 0; s < k_samples; ++s) {
      if (s == pause) {
        MemoryArchive archive;
        part->save(archive);
        part = make_as<sdk::Sensor>(make);
        part->load(archive);
        const std::string when = "saved and loaded after " + std::to_string(s) + " samples ";
        compare(summary_of(*whole), summary_of(*part), when);
        compare(series_of(*whole), series_of(*part), when);
        require(fields_of(*whole).numbers() == fields_of(*part).numbers(),
                when + "a field differs (save and load keep its state)");
      }
      scene.show(*whole);
      same.show(*part);
    }
    const std::string when = "going on after " + std::to_string(pause) + " samples ";
    compare(summary_of(*whole), summary_of(*part), when);
    compare(series_of(*whole), series_of(*part), when);
  }
}

/// However seldom rows are written, they say the same: values of a moment and totals those of the
/// full series, means its time means.
void check_thinned(const Maker& make) {
  constexpr int k_samples_per_row = 9;
  // A mean of means is the mean of all to some roundings of the largest.
  constexpr double k_rounding = 1e-12;
  const auto full = make_as<sdk::Sensor>(make);
  const auto thinned = make_as<sdk::Sensor>(make);
  SensorStream scene;
  SensorStream same;
  std::vector<double> sums;
  std::vector<double> sizes;
  for (int s = 0; s < k_samples; ++s) {
    scene.show(*full);
    same.show(*thinned);
    const Figures row = series_of(*full);
    sums.resize(row.all().size());
    sizes.resize(row.all().size());
    for (std::size_t c = 0; c < sums.size(); ++c) {
      const double value = row.all()[c].second.value;
      sums[c] += value / k_samples_per_row;
      sizes[c] += std::abs(value);
    }
    full->end_row();
    if ((s + 1) % k_samples_per_row != 0) continue;
    const Figures seldom = series_of(*thinned);
    require_same(row.names(), seldom.names(), "a series with fewer rows has other columns: ");
    for (std::size_t c = 0; c < sums.size(); ++c) {
      const auto& [name, figure] = seldom.all()[c];
      const bool is_mean = thinned->row_value(name) == sdk::RowValue::mean;
      const double wanted = is_mean ? sums[c] : row.all()[c].second.value;
      require(is_same(figure.value, wanted) ||
                  std::abs(figure.value - wanted) <= (is_mean ? k_rounding * sizes[c] : 0.0),
              "'" + name + "' is " + shown(figure.value) + " in a row for every " +
                  std::to_string(k_samples_per_row) + " samples; the samples say " + shown(wanted));
    }
    thinned->end_row();
    sums.clear();
    sizes.clear();
  }
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("names its figures and their units", [&] { check_names(make); });
  runner.rule("says what its figures are", [&] { check_roles(make); });
  runner.rule("sees something in a stream, with errors", [&] { check_sees(make); });
  runner.rule("gives zeros or no values, of the same names, where there is nothing",
              [&] { check_nothing(make); });
  runner.rule("loses nothing between rows of series.csv", [&] { check_thinned(make); });
  runner.rule("goes on with the same bits when saved and loaded", [&] { check_restart(make); });
}

}  // namespace

Kind sensor_kind() {
  // Lengths stay: names of figures may hold them.
  return {.observe = observe,
          .batches = {},
          .other_units = {1.0, 4.0, 0.5},
          .is_hot = false,
          .is_met = is_met,
          .rules = rules};
}

}  // namespace dust::contract
