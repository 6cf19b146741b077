// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/overview.hpp"
#include "dust/sdk/sensor.hpp"

#include <string_view>

namespace dust::sdk {

/// Passes figures on, one of them as what a reader asks of the sensor before anything else: the
/// first screen of the report and the table of `engine compare` show it (overview).
class MainFigure final : public FigureSink {
 public:
  /// `sink` is kept by reference, `name` is that of the figure.
  MainFigure(FigureSink& sink, std::string_view name) : sink_(sink), name_(name) {}

  using FigureSink::figure;
  void figure(std::string_view name, double value, std::string_view unit, double uncertainty,
              const FigureRole& role) override {
    sink_.figure(name, value, unit, uncertainty, name == name_ ? overview(role.quantity, 1) : role);
  }

 private:
  FigureSink& sink_;
  std::string_view name_;
};

}  // namespace dust::sdk
