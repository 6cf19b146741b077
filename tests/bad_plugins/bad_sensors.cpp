// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/plugin.hpp"

#include <stdexcept>
#include <string>

/// A sensor that is well until it is asked for one thing.
enum class Fault { none, summary, report, columns, late, comma, nameless, twice, unitless, cells };

template <Fault fault>
struct BadSensor final : dust::sdk::Sensor {
  struct Parameters {};
  static dust::sdk::ModelInfo describe() {
    const char* const names[] = {"well",         "broken_summary", "broken_report", "other_columns",
                                 "late_summary", "comma",          "nameless",      "twice",
                                 "unitless",     "cells"};
    return {.kind = "",
            .name = names[static_cast<int>(fault)],
            .version = "1.0",
            .summary = "Counts its looks.",
            .equation = "",
            .source = "",
            .parameters = {}};
  }
  static dust::sdk::ParameterSchema schema() { return {}; }
  explicit BadSensor(const Parameters&) {}
  void observe(const dust::sdk::WorldView&) override { looks_ += 1.0; }
  void series(dust::sdk::FigureSink& sink) const override {
    sink.figure(fault == Fault::columns && looks_ > 5.0 ? "gazes" : "looks", looks_, "1");
    if (fault == Fault::comma) sink.figure("left, right", looks_, "1");
    if (fault == Fault::twice) sink.figure("looks", looks_, "s");
  }
  void summary(dust::sdk::FigureSink& sink) const override {
    const bool is_late = fault == Fault::late && looks_ > 5.0;
    if (fault == Fault::summary || is_late) throw std::runtime_error("broken sum");
    sink.figure("looks", looks_, "1");
    if (fault == Fault::nameless) sink.figure("", looks_, "1");
    if (fault == Fault::unitless) sink.figure("times", looks_, "");
  }
  void fields(dust::sdk::FieldSink& sink) const override {
    const double values[] = {1.0, 2.0};
    if (fault == Fault::cells) sink.field("map", "1", {{}, {1.0, 1.0, 1.0}, {2, 2, 2}}, values);
  }
  void report(dust::sdk::ReportSink&) const override {
    if (fault == Fault::report) throw std::runtime_error("broken report");
  }
  void save(dust::sdk::ArchiveWriter& archive) const override { archive.number("looks", looks_); }
  void load(dust::sdk::ArchiveReader& archive) override { looks_ = archive.number("looks"); }

 private:
  double looks_ = 0.0;
};

DUST_PLUGIN(registrar) {
  registrar.add<BadSensor<Fault::summary>>();
  registrar.add<BadSensor<Fault::report>>();
  registrar.add<BadSensor<Fault::columns>>();
  registrar.add<BadSensor<Fault::late>>();
  registrar.add<BadSensor<Fault::comma>>();
  registrar.add<BadSensor<Fault::nameless>>();
  registrar.add<BadSensor<Fault::twice>>();
  registrar.add<BadSensor<Fault::unitless>>();
  registrar.add<BadSensor<Fault::cells>>();
}
