// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dust::report {

/// One figure of a sensor as summary.json holds it. What it is, its role says (figure_role.hpp of
/// the plugin interface), and never its name.
struct Figure {
  std::string sensor;
  std::string name;  ///< path of snake_case words
  double value = 0.0;
  std::string unit;
  double uncertainty = -1.0;  ///< one standard error; negative: none given
  std::string no_error;       ///< why there is none: "few grains", "not steady"; "" = not said
  std::string role;
  std::string quantity;
  std::string direction;
  std::string towards;
  double smallest = 0.0;     ///< [m] diameters counted
  double largest = 0.0;      ///< [m] 0 = no limit
  double probability = 0.0;  ///< of a quantile
  double drop = 0.0;         ///< [m] of a quantile
  int index = 0;

  [[nodiscard]] bool is_of_class() const { return smallest > 0.0 && smallest == largest; }
  /// The diameter of its size class [m]; negative where it is of several.
  [[nodiscard]] double size_class() const { return is_of_class() ? largest : -1.0; }
  /// Whether nothing it counts is as large as `limit` [m]; a class is one diameter, a range ends
  /// below its end.
  [[nodiscard]] bool is_finer_than(double limit) const {
    return largest > 0.0 && (is_of_class() ? largest < limit : largest <= limit);
  }
  /// What passes, gets out or is there, per tonne of load; of ways to and fro what is left of both.
  [[nodiscard]] bool is_per_load() const { return quantity == "mass_per_load" && is_part(); }
  /// The same per time.
  [[nodiscard]] bool is_per_time() const { return quantity == "mass_rate" && is_part(); }
  [[nodiscard]] bool is_part() const {
    return direction.empty() || direction == "net" || !towards.empty();
  }
};

/// Every figure below `sensors` of summary.json, in its order.
[[nodiscard]] std::vector<Figure> figures_of(const nlohmann::json& sensors);

}  // namespace dust::report
