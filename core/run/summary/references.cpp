// SPDX-License-Identifier: Apache-2.0
#include "run/summary/references.hpp"

#include "base/text.hpp"
#include "scenario/text/units.hpp"

#include <cmath>
#include <optional>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;

/// A number with its uncertainty, "-" for none.
std::string shown(const Json& value, const Json& uncertainty) {
  if (!value.is_number()) return "-";
  const std::string text = base::digits_text(value.get<double>(), 4);
  if (!uncertainty.is_number()) return text;
  return text + " +- " + base::digits_text(uncertainty.get<double>(), 2);
}

scenario::Unit unit_named(const std::string& name) {
  return scenario::parse_unit(name).value_or(scenario::Unit{});
}

/// What a number in the unit of the reference is multiplied by to be in that of the figure: 1 as a
/// rule. Nothing where the units are not of one dimension.
std::optional<double> factor_between(const std::string& written, const std::string& reported) {
  if (written == reported) return 1.0;
  const scenario::Unit from = unit_named(written);
  const scenario::Unit to = unit_named(reported);
  if (!(from.dimension == to.dimension)) return std::nullopt;
  return (from.numerator * to.denominator) / (from.denominator * to.numerator);
}

/// Our figure beside the reference, in its unit.
void add_ours(const scenario::ReferenceSpec& r, const Json& figure, Json& one) {
  const auto factor = factor_between(r.unit, figure["unit"].get<std::string>());
  if (!factor) {
    one["problem"] = "the figure is in " + figure["unit"].get<std::string>() + ", not in " + r.unit;
    return;
  }
  const double value = *factor * r.value;
  one["unit"] = figure["unit"];
  one["value"] = value;
  if (r.uncertainty >= 0.0) one["uncertainty"] = *factor * r.uncertainty;
  one["ours"] = figure["value"];
  one["our_uncertainty"] = figure["uncertainty"];
  if (!figure["value"].is_number() || value == 0.0) return;
  one["error_percent"] = 100.0 * std::abs((value - figure["value"].get<double>()) / value);
}

}  // namespace

Json references_json(std::span<const scenario::ReferenceSpec> references, const Json& sensors) {
  Json list = Json::array();
  for (const scenario::ReferenceSpec& r : references) {
    Json one = {{"quantity", "sensors." + r.sensor + "." + r.figure},
                {"unit", r.unit},
                {"value", r.value},
                {"uncertainty", r.uncertainty < 0.0 ? Json(nullptr) : Json(r.uncertainty)},
                {"ours", nullptr},
                {"our_uncertainty", nullptr},
                {"error_percent", nullptr},
                {"source", r.source}};
    if (sensors.contains(r.sensor) && sensors[r.sensor].contains(r.figure)) {
      add_ours(r, sensors[r.sensor][r.figure], one);
    } else {
      one["problem"] = "the run has no such figure: a class of sizes that never came, or its name";
    }
    list.push_back(one);
  }
  return list;
}

std::vector<std::string> reference_lines(const Json& references) {
  std::vector<std::string> lines;
  for (const Json& r : references) {
    const std::string unit = r["unit"] == "1" ? "" : " " + r["unit"].get<std::string>();
    std::string line = r["quantity"].get<std::string>() + ": ours " +
                       shown(r["ours"], r["our_uncertainty"]) + unit + ", reference " +
                       shown(r["value"], r["uncertainty"]) + unit;
    if (r["error_percent"].is_number()) {
      line += ", " + base::fixed_text(r["error_percent"].get<double>(), 1) + " % off";
    }
    line += " (" + r["source"].get<std::string>() + ")";
    if (r.contains("problem")) line += "; not compared: " + r["problem"].get<std::string>();
    lines.push_back(line);
  }
  return lines;
}

}  // namespace dust::run
