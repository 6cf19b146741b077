// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace dust::registry {

/// What a sensor of others has given that no file can hold: the first fault, for after the call.
/// It is not thrown through the sensor, which might catch it.
class SinkFaults {
 public:
  /// "gives a figure 'a,b'; expected: ..."; empty while all is well.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] bool is_well() const { return fault_.empty(); }

 protected:
  /// The name and the unit of a figure or field, `what`. A name of words has '/' between them.
  void check_name(const char* what, std::string_view name, bool has_words);
  void check_unit(const char* what, std::string_view name, std::string_view unit);
  void check(bool is_kept, const std::string& fault) {
    if (is_well() && !is_kept) fault_ = fault;
  }

 private:
  std::set<std::string, std::less<>> names_;
  std::string fault_;
};

class CheckedFigures final : public sdk::FigureSink, public SinkFaults {
 public:
  explicit CheckedFigures(sdk::FigureSink& sink) : sink_(sink) {}
  void figure(std::string_view name, double value, std::string_view unit, double uncertainty,
              const sdk::FigureRole& role) override;

 private:
  sdk::FigureSink& sink_;
};

class CheckedFields final : public sdk::FieldSink, public SinkFaults {
 public:
  explicit CheckedFields(sdk::FieldSink& sink) : sink_(sink) {}
  void field(std::string_view name, std::string_view unit, const sdk::GridShape& grid,
             std::span<const double> values, const sdk::FigureRole& role) override;

 private:
  sdk::FieldSink& sink_;
};

class CheckedReport final : public sdk::ReportSink, public SinkFaults {
 public:
  explicit CheckedReport(sdk::ReportSink& sink) : sink_(sink) {}
  void section(std::string_view heading, std::string_view text) override;
  void curve(std::string_view title, std::string_view x_label, std::string_view y_label,
             std::string_view series, std::span<const double> x,
             std::span<const double> y) override;
  void row(std::string_view title, std::span<const std::string> columns,
           std::span<const double> values) override;

 private:
  sdk::ReportSink& sink_;
};

}  // namespace dust::registry
