// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/engine.hpp"

#include <nlohmann/json.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dust::test {

/// A shipped scenario of scenarios/verification, run to its end on one thread.
class BulkRun {
 public:
  explicit BulkRun(const std::string& name, const std::vector<std::string>& settings = {}) {
    const auto out = folder_ / "out";
    std::vector<std::string> arguments{
        "run",       std::string(DUST_SOURCE) + "/scenarios/verification/" + name + ".yaml",
        "-o",        out.string(),
        "--threads", "1",
        "--quiet"};
    for (const std::string& setting : settings) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
    const Outcome outcome = engine(arguments);
    REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    summary = nlohmann::json::parse(read_file(out / "summary.json"));
    series_ = read_file(out / "series.csv");
  }
  [[nodiscard]] double figure(const std::string& sensor, const std::string& name) const {
    return summary["sensors"][sensor][name]["value"].get<double>();
  }
  /// A column of series.csv by its whole heading.
  [[nodiscard]] std::vector<double> column(const std::string& heading) const {
    std::istringstream lines(series_);
    std::string line;
    std::getline(lines, line);
    const auto headings = cells(line);
    std::size_t at = 0;
    while (at < headings.size() && headings[at] != heading) ++at;
    REQUIRE(at < headings.size());
    std::vector<double> values;
    while (std::getline(lines, line)) values.push_back(std::stod(cells(line).at(at)));
    return values;
  }
  nlohmann::json summary;

 private:
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> parts;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) parts.push_back(cell);
    return parts;
  }
  TemporaryFolder folder_;
  std::string series_;
};

}  // namespace dust::test
