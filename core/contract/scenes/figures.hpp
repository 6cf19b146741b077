// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What a sensor reports, as a table.
namespace dust::contract {

struct Figure {
  double value = 0.0;
  std::string unit;
  double uncertainty = -1.0;
  sdk::FigureRole role;  ///< without its texts
  std::string species;
  std::string towards;
};

/// Figures in the order given; `at` throws for an unknown name.
class Figures final : public sdk::FigureSink {
 public:
  void figure(std::string_view name, double value, std::string_view unit, double uncertainty,
              const sdk::FigureRole& role) override;
  [[nodiscard]] const Figure& at(const std::string& name) const;
  [[nodiscard]] double operator[](const std::string& name) const { return at(name).value; }
  [[nodiscard]] const std::vector<std::pair<std::string, Figure>>& all() const { return figures_; }
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::vector<std::pair<std::string, Figure>> figures_;
};
Figures summary_of(const sdk::Sensor& sensor);
Figures series_of(const sdk::Sensor& sensor);

}  // namespace dust::contract
