// SPDX-License-Identifier: Apache-2.0
#include "scenario/reference_curves.hpp"

#include "scenario/blocks.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace dust::scenario {
namespace {

/// "m/s" of "velocity [m/s]"; empty for bare numbers.
std::string unit_of(const std::string& label) {
  const auto open = label.rfind('['), close = label.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  const std::string unit = label.substr(open + 1, close - open - 1);
  return unit == "1" || unit == "-" ? "" : unit;
}

std::optional<Unit> parsed(const std::string& unit) {
  return unit.empty() ? std::optional<Unit>(Unit{}) : parse_unit(unit);
}

/// Numbers as they are written, with the unit that holds for all of them.
struct WrittenList {
  std::vector<double> numbers;
  std::string unit;  ///< of the last one; others may repeat it
};

class CurveReader {
 public:
  CurveReader(const Node& node, std::string path, const std::vector<SensorFigures>& sensors,
              Diagnostics& diagnostics)
      : reader_(node, std::move(path), node.where, diagnostics),
        sensors_(sensors),
        diagnostics_(diagnostics) {}

  /// Nothing where something is wrong or the sensor is switched off.
  std::optional<ReferenceCurve> read(Node& written) {
    const auto values = reader_.values(ReferenceCurveBlock::schema());
    const Entry* x = reader_.required("x", "the places, with their unit");
    const Entry* y = reader_.required("y", "the numbers, with their unit");
    reader_.finish();
    if (!reader_.is_good() || x == nullptr || y == nullptr) return std::nullopt;
    const auto block =
        sdk::parameters_from<ReferenceCurveBlock>(ReferenceCurveBlock::schema(), values);
    const SensorFigures* sensor = find(block.sensor);
    const auto xs = read_list(*x);
    const auto ys = read_list(*y);
    if (sensor == nullptr || !xs || !ys) return std::nullopt;
    if (xs->numbers.size() != ys->numbers.size()) {
      error(*y, std::to_string(ys->numbers.size()) + " numbers for " +
                    std::to_string(xs->numbers.size()) + " places; one for each is expected");
      return std::nullopt;
    }
    if (std::adjacent_find(xs->numbers.begin(), xs->numbers.end(), std::greater_equal<>()) !=
        xs->numbers.end()) {
      error(*x, "the places shall rise from each to the next");
      return std::nullopt;
    }
    ReferenceCurve curve{sensor->sensor, {}, {}, {}, block.source};
    if (!match(*sensor, *xs, *ys, curve)) return std::nullopt;
    written = write(block, curve);
    if (!sensor->is_enabled) return std::nullopt;
    return curve;
  }

 private:
  void error(const Entry& entry, const std::string& text) {
    diagnostics_.error(entry.value.where, reader_.path_of(entry.key) + ": " + text);
  }

  const SensorFigures* find(const std::string& name) {
    std::vector<std::string> names;
    for (const SensorFigures& s : sensors_) {
      if (s.sensor == name) return &s;
      names.push_back(s.sensor);
    }
    if (const Entry* entry = reader_.node().find("sensor")) {
      error(*entry,
            "there is no sensor " + in_quotes(name) + suggestion(name, names, "the sensors are"));
    }
    return nullptr;
  }

  std::optional<WrittenList> read_list(const Entry& entry) {
    if (!entry.value.is_list() || entry.value.items.size() < 2) {
      error(entry, "a list of at least two numbers is expected, the last with the unit of all");
      return std::nullopt;
    }
    WrittenList list;
    std::vector<std::string> units;
    for (const Node& item : entry.value.items) {
      std::string problem = "a number is expected, not " + kind_text(item);
      const auto given = item.is_text() ? split_number(item.text, problem) : std::nullopt;
      if (!given) {
        diagnostics_.error(item.where, reader_.path_of(entry.key) + ": " + problem);
        return std::nullopt;
      }
      list.numbers.push_back(given->number);
      units.push_back(given->unit);
    }
    list.unit = units.back();
    for (std::size_t n = 0; n < units.size(); ++n) {
      if (units[n].empty() || units[n] == list.unit) continue;
      diagnostics_.error(entry.value.items[n].where,
                         reader_.path_of(entry.key) + ": one unit for the whole list, " +
                             in_quotes(list.unit) + " or " + in_quotes(units[n]));
      return std::nullopt;
    }
    if (!parsed(list.unit)) {
      diagnostics_.error(
          entry.value.items.back().where,
          reader_.path_of(entry.key) + ": unknown unit " + in_quotes(list.unit) +
              "; behind the last number stands the unit of all, like s, mm or kg/m3");
      return std::nullopt;
    }
    return list;
  }

  /// Takes the axes of the first curve of that sensor that fits, and the numbers in their units.
  bool match(const SensorFigures& sensor, const WrittenList& xs, const WrittenList& ys,
             ReferenceCurve& curve) {
    const auto into = [](const WrittenList& list, const std::string& label, bool bare_is_si) {
      const auto from = parsed(list.unit), to = parsed(unit_of(label));
      std::optional<std::vector<double>> numbers;
      const bool is_same = to && from->dimension == to->dimension;
      if (!to || !(is_same || (bare_is_si && list.unit.empty()))) return numbers;
      numbers.emplace();
      for (const double v : list.numbers) {
        numbers->push_back(v * (from->numerator * to->denominator) /
                           (from->denominator * to->numerator));
      }
      return numbers;
    };
    // Curves of bare numbers come before those for which a bare number is SI, as everywhere.
    for (const bool bare_is_si : {false, true}) {
      for (const CurveAxes& axes : sensor.curves) {
        const auto x = into(xs, axes.x_label, bare_is_si), y = into(ys, axes.y_label, bare_is_si);
        if (!x || !y) continue;
        curve.axes = axes;
        curve.x = *x;
        curve.y = *y;
        return true;
      }
    }
    std::string there;
    for (const CurveAxes& axes : sensor.curves) {
      there += (there.empty() ? "" : "; ") + axes.y_label + " against " + axes.x_label;
    }
    const Entry* entry = reader_.node().find("y");
    // A sensor that could not be made has told its own problem.
    if (sensor.figures.empty() && sensor.curves.empty()) return false;
    error(*entry, "the sensor '" + sensor.sensor + "' draws no curve of [" + ys.unit +
                      "] against [" + xs.unit + "]" +
                      (there.empty() ? std::string(", nor any other") : "; it draws " + there));
    return false;
  }

  static Node write(const ReferenceCurveBlock& block, const ReferenceCurve& curve) {
    const auto list = [](const std::vector<double>& numbers, const std::string& unit) {
      Node node = Node::make_list();
      for (const double v : numbers) {
        node.items.push_back(unit.empty() ? written_value(v)
                                          : Node::make_text(number_text(v) + " " + unit, true));
      }
      return node;
    };
    Node map = Node::make_map();
    add(map, "sensor", written_value(block.sensor));
    add(map, "x", list(curve.x, unit_of(curve.axes.x_label)));
    add(map, "y", list(curve.y, unit_of(curve.axes.y_label)));
    add(map, "source", written_value(block.source));
    return map;
  }

  MapReader reader_;
  const std::vector<SensorFigures>& sensors_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<ReferenceCurve> read_reference_curves(MapReader& top,
                                                  const std::vector<SensorFigures>& sensors,
                                                  Node& resolved, Diagnostics& diagnostics) {
  std::vector<ReferenceCurve> found;
  const Entry* entry = top.optional("reference_curves");
  if (entry == nullptr) return found;
  if (!entry->value.is_list()) {
    diagnostics.error(
        entry->value.where,
        "reference_curves: a list of '- sensor: NAME' is expected, not " + kind_text(entry->value));
    return found;
  }
  Node list = Node::make_list();
  for (std::size_t n = 0; n < entry->value.items.size(); ++n) {
    Node written;
    CurveReader reader(entry->value.items[n], "reference_curves[" + std::to_string(n) + "]",
                       sensors, diagnostics);
    auto curve = reader.read(written);
    if (written.is_map()) list.items.push_back(std::move(written));
    if (curve) found.push_back(std::move(*curve));
  }
  if (!list.items.empty()) add(resolved, "reference_curves", std::move(list));
  return found;
}

}  // namespace dust::scenario
