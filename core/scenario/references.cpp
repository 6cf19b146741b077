// SPDX-License-Identifier: Apache-2.0
#include "scenario/references.hpp"

#include "dust/sdk/sensor.hpp"
#include "scenario/blocks.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <optional>

namespace dust::scenario {
namespace {

class IgnoredFigures final : public sdk::FigureSink {
 public:
  void figure(std::string_view, double, std::string_view, double, const sdk::FigureRole&) override {
  }
};

class IgnoredFields final : public sdk::FieldSink {
 public:
  void field(std::string_view, std::string_view, const sdk::GridShape&, std::span<const double>,
             const sdk::FigureRole&) override {}
};

class NamedFigures final : public sdk::FigureSink {
 public:
  explicit NamedFigures(SensorFigures& out) : out_(out) {}
  void figure(std::string_view name, double, std::string_view unit, double,
              const sdk::FigureRole&) override {
    out_.figures.emplace_back(name, unit);
  }

 private:
  SensorFigures& out_;
};

class NamedCurves final : public sdk::ReportSink {
 public:
  explicit NamedCurves(SensorFigures& out) : out_(out) {}
  void section(std::string_view, std::string_view) override {}
  void curve(std::string_view title, std::string_view x_label, std::string_view y_label,
             std::string_view, std::span<const double>, std::span<const double>) override {
    out_.curves.push_back({std::string(title), std::string(x_label), std::string(y_label)});
  }
  void row(std::string_view, std::span<const std::string>, std::span<const double>) override {}

 private:
  SensorFigures& out_;
};

/// A figure of one size class: such figures come with the first grains.
bool is_of_class(const std::string& figure) {
  return figure.starts_with("class_") || figure.find("/class_") != std::string::npos;
}

/// The same of all sizes: "drop_140_mm/class_300_um/median" is "drop_140_mm/median" of one class.
std::string without_class(const std::string& figure) {
  const std::size_t begin = figure.starts_with("class_") ? 0 : figure.find("/class_") + 1;
  const std::size_t end = figure.find('/', begin);
  return figure.substr(0, begin) + (end == std::string::npos ? "" : figure.substr(end + 1));
}

/// Reads one reference of the list.
class ReferenceReader {
 public:
  ReferenceReader(const Node& node, std::string path, const std::vector<SensorFigures>& sensors,
                  Diagnostics& diagnostics)
      : reader_(node, std::move(path), node.where, diagnostics),
        sensors_(sensors),
        diagnostics_(diagnostics) {}

  /// Nothing where something is wrong or the sensor is switched off.
  std::optional<ReferenceSpec> read(Node& written) {
    const auto values = reader_.values(ReferenceBlock::schema());
    const Entry* value = reader_.required("value", "the number, with its unit");
    const Entry* uncertainty = reader_.optional("uncertainty");
    reader_.finish();
    if (!reader_.is_good() || value == nullptr) return std::nullopt;
    const auto block = sdk::parameters_from<ReferenceBlock>(ReferenceBlock::schema(), values);
    ReferenceSpec spec;
    spec.source = block.source;
    if (!find(block.quantity, spec)) return std::nullopt;
    const auto number = read_number(*value, spec.unit);
    if (!number) return std::nullopt;
    spec.value = *number;
    if (uncertainty != nullptr) {
      const auto scatter = read_number(*uncertainty, spec.unit);
      if (!scatter) return std::nullopt;
      if (*scatter < 0.0) {
        diagnostics_.error(uncertainty->value.where, reader_.path_of("uncertainty") + ": " +
                                                         number_text(*scatter) + " is below 0");
        return std::nullopt;
      }
      spec.uncertainty = *scatter;
    }
    written = write(block, spec);
    if (!is_enabled_) return std::nullopt;
    return spec;
  }

 private:
  void error(const char* key, const std::string& text) {
    const Entry* entry = reader_.node().find(key);
    diagnostics_.error(entry != nullptr ? entry->value.where : reader_.where(),
                       reader_.path_of(key) + ": " + text);
  }

  /// Splits sensors.NAME.FIGURE and looks both up.
  bool find(const std::string& quantity, ReferenceSpec& spec) {
    const std::string head = "sensors.";
    const std::size_t dot = quantity.find('.', head.size());
    if (!quantity.starts_with(head) || dot == std::string::npos) {
      error("quantity", in_quotes(quantity) + " is not of the form sensors.NAME.FIGURE");
      return false;
    }
    spec.sensor = quantity.substr(head.size(), dot - head.size());
    spec.figure = quantity.substr(dot + 1);
    const auto sensor = std::find_if(sensors_.begin(), sensors_.end(),
                                     [&](const auto& s) { return s.sensor == spec.sensor; });
    if (sensor == sensors_.end()) {
      std::vector<std::string> names;
      for (const SensorFigures& s : sensors_) names.push_back(s.sensor);
      error("quantity", "there is no sensor " + in_quotes(spec.sensor) +
                            suggestion(spec.sensor, names, "the sensors are"));
      return false;
    }
    is_enabled_ = sensor->is_enabled;
    const bool is_class = is_of_class(spec.figure);
    const std::string known = is_class ? without_class(spec.figure) : spec.figure;
    std::vector<std::string> names;
    for (const auto& [name, unit] : sensor->figures) {
      if (name == spec.figure || name == known) {
        spec.unit = unit;
        return true;
      }
      names.push_back(name);
    }
    if (is_class) return true;
    // A sensor that could not be made has told its own problem.
    if (!names.empty()) {
      error("quantity", "the sensor '" + spec.sensor + "' has no figure " + in_quotes(spec.figure) +
                            suggestion(spec.figure, names, "its figures are"));
    }
    return false;
  }

  /// The number in `unit`, in which the figure is reported; a bare one is SI, as everywhere.
  std::optional<double> read_number(const Entry& entry, std::string& unit) {
    const std::string path = reader_.path_of(entry.key) + ": ";
    const auto fail = [&](const std::string& text) {
      diagnostics_.error(entry.value.where, path + text);
      return std::nullopt;
    };
    if (!entry.value.is_text()) {
      return fail("a number with its unit is expected, not " + kind_text(entry.value));
    }
    std::string problem;
    const auto given = split_number(entry.value.text, problem);
    if (!given) return fail(problem);
    // The unit of what there is of single size classes alone is taken as it is written.
    if (unit.empty()) unit = given->unit.empty() ? "1" : given->unit;
    const bool is_bare = unit == "1" || unit == "-";
    if (given->unit == unit || (is_bare && given->unit.empty())) return given->number;
    const auto from = given->unit.empty() ? std::optional<Unit>(Unit{}) : parse_unit(given->unit);
    const auto to = is_bare ? std::optional<Unit>(Unit{}) : parse_unit(unit);
    if (!from) return fail("unknown unit " + in_quotes(given->unit) + ": the figure is in " + unit);
    if (!to || (!given->unit.empty() && !(from->dimension == to->dimension))) {
      return fail("'" + printable(given->unit) + "' is the unit of " +
                  dimension_name(from->dimension) + ": the figure is in " +
                  (is_bare ? "bare numbers" : unit));
    }
    return given->number * (from->numerator * to->denominator) /
           (from->denominator * to->numerator);
  }

  static Node write(const ReferenceBlock& block, const ReferenceSpec& spec) {
    const auto number = [&](double value) {
      const bool is_bare = spec.unit == "1" || spec.unit == "-";
      return is_bare ? written_value(value)
                     : Node::make_text(number_text(value) + " " + spec.unit, true);
    };
    Node map = Node::make_map();
    add(map, "quantity", written_value(block.quantity));
    add(map, "value", number(spec.value));
    if (spec.uncertainty >= 0.0) add(map, "uncertainty", number(spec.uncertainty));
    add(map, "source", written_value(block.source));
    return map;
  }

  MapReader reader_;
  const std::vector<SensorFigures>& sensors_;
  Diagnostics& diagnostics_;
  bool is_enabled_ = true;
};

}  // namespace

SensorFigures figures_of(const std::string& name, bool is_enabled, const sdk::Model* model) {
  SensorFigures out{name, is_enabled, {}, {}};
  if (model == nullptr) return out;
  const auto& sensor = static_cast<const sdk::Sensor&>(*model);
  // A guard refuses what no file can hold.
  IgnoredFigures columns;
  sensor.series(columns);
  IgnoredFields fields;
  sensor.fields(fields);
  NamedFigures figures(out);
  sensor.summary(figures);
  NamedCurves curves(out);
  sensor.report(curves);
  return out;
}

std::vector<ReferenceSpec> read_references(MapReader& top,
                                           const std::vector<SensorFigures>& sensors,
                                           Node& resolved, Diagnostics& diagnostics) {
  std::vector<ReferenceSpec> found;
  const Entry* entry = top.optional("references");
  if (entry == nullptr) return found;
  if (!entry->value.is_list()) {
    diagnostics.error(entry->value.where,
                      "references: a list of '- quantity: sensors.NAME.FIGURE' is expected, not " +
                          kind_text(entry->value));
    return found;
  }
  Node list = Node::make_list();
  for (std::size_t n = 0; n < entry->value.items.size(); ++n) {
    Node written;
    ReferenceReader reader(entry->value.items[n], "references[" + std::to_string(n) + "]", sensors,
                           diagnostics);
    auto spec = reader.read(written);
    if (written.is_map()) list.items.push_back(std::move(written));
    if (spec) found.push_back(std::move(*spec));
  }
  if (!list.items.empty()) add(resolved, "references", std::move(list));
  return found;
}

}  // namespace dust::scenario
