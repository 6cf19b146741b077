// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/figures.hpp"

#include <stdexcept>

namespace dust::contract {

void Figures::figure(std::string_view name, double value, std::string_view unit, double uncertainty,
                     const sdk::FigureRole& role) {
  Figure figure{value, std::string(unit),         uncertainty,
                role,  std::string(role.species), std::string(role.towards)};
  figure.role.species = figure.role.towards = {};
  figures_.emplace_back(std::string(name), std::move(figure));
}
const Figure& Figures::at(const std::string& name) const {
  for (const auto& [known, figure] : figures_) {
    if (known == name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}
std::vector<std::string> Figures::names() const {
  std::vector<std::string> names;
  for (const auto& [name, figure] : figures_) names.push_back(name + " [" + figure.unit + "]");
  return names;
}
Figures summary_of(const sdk::Sensor& sensor) {
  Figures figures;
  sensor.summary(figures);
  return figures;
}
Figures series_of(const sdk::Sensor& sensor) {
  Figures figures;
  sensor.series(figures);
  return figures;
}

}  // namespace dust::contract
