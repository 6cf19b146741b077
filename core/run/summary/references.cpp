// SPDX-License-Identifier: Apache-2.0
#include "run/summary/references.hpp"

#include "base/text.hpp"

#include <cmath>

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
      const Json& figure = sensors[r.sensor][r.figure];
      one["unit"] = figure["unit"];
      one["ours"] = figure["value"];
      one["our_uncertainty"] = figure["uncertainty"];
      if (figure["value"].is_number() && r.value != 0.0) {
        const double error = std::abs((r.value - figure["value"].get<double>()) / r.value);
        one["error_percent"] = 100.0 * error;
      }
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
    lines.push_back(line + " (" + r["source"].get<std::string>() + ")");
  }
  return lines;
}

}  // namespace dust::run
