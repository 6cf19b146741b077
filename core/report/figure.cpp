// SPDX-License-Identifier: Apache-2.0
#include "report/figure.hpp"

#include "report/run_text.hpp"

#include <cmath>

namespace dust::report {
namespace {

using nlohmann::json;

Figure figure_at(const std::string& sensor, const std::string& path, const json& entry) {
  Figure figure;
  figure.sensor = sensor;
  figure.name = path;
  figure.value = number_at(entry, "value").value_or(std::nan(""));
  figure.unit = text_at(entry, "unit");
  figure.uncertainty = number_at(entry, "uncertainty").value_or(-1.0);
  figure.no_error = text_at(entry, "no_error");
  figure.role = text_at(entry, "role");
  figure.quantity = text_at(entry, "quantity");
  figure.direction = text_at(entry, "direction");
  figure.towards = text_at(entry, "towards");
  const json& diameters = list_at(entry, "diameters_m");
  if (diameters.size() == 2) {
    figure.smallest = diameters[0].is_number() ? diameters[0].get<double>() : 0.0;
    figure.largest = diameters[1].is_number() ? diameters[1].get<double>() : 0.0;
  }
  figure.probability = number_at(entry, "probability").value_or(0.0);
  figure.drop = number_at(entry, "drop_m").value_or(0.0);
  figure.index = static_cast<int>(number_at(entry, "index").value_or(0.0));
  return figure;
}

void collect(const std::string& sensor, const std::string& path, const json& value,
             std::vector<Figure>& figures) {
  if (value.is_number()) {
    Figure figure;
    figure.sensor = sensor;
    figure.name = path;
    figure.value = value.get<double>();
    figures.push_back(std::move(figure));
  } else if (value.is_object() && value.contains("value")) {
    figures.push_back(figure_at(sensor, path, value));
  } else if (value.is_object()) {
    for (const auto& [key, part] : value.items()) {
      collect(sensor, path.empty() ? key : path + "/" + key, part, figures);
    }
  }
}

}  // namespace

std::vector<Figure> figures_of(const json& sensors) {
  std::vector<Figure> figures;
  for (const auto& [sensor, values] : sensors.items()) collect(sensor, "", values, figures);
  return figures;
}

}  // namespace dust::report
