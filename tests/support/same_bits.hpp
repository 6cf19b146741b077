// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/run_summary.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dust::test {

/// Where a run is cut in two, and where it ends.
struct Cut {
  std::string at, end;  ///< with their unit
};

/// Runs a scenario with these arguments on one thread, on two, and cut in two, each part on another
/// number of threads; checks that the state, the series and these blocks of the summary are the
/// same each time, and returns the summary of the first run.
inline nlohmann::json check_same_bits(const std::string& scenario,
                                      const std::vector<std::string>& arguments, const Cut& cut,
                                      const std::vector<std::string>& blocks) {
  const TemporaryFolder folder;
  const auto run = [&](const char* to, const std::string& end, std::vector<std::string> more) {
    more.insert(more.end(), arguments.begin(), arguments.end());
    more.insert(more.end(), {"--set", "time.end=" + end});
    return run_summary(scenario, folder / to, more);
  };
  const nlohmann::json whole = run("whole", cut.end, {"--threads", "1"});
  const nlohmann::json other = run("threads", cut.end, {"--threads", "2"});
  run("parts", cut.at, {"--threads", "2"});
  const nlohmann::json resumed = run("parts", cut.end, {"--threads", "1", "--resume"});
  for (const nlohmann::json& again : {other, resumed}) {
    CHECK(again["state_sha256"] == whole["state_sha256"]);
    for (const std::string& block : blocks) {
      CAPTURE(block);
      REQUIRE(whole.contains(block));
      CHECK(again[block] == whole[block]);
    }
  }
  const std::string series = read_file(folder / "whole" / "series.csv");
  REQUIRE(!series.empty());
  for (const char* again : {"threads", "parts"}) {
    CHECK(read_file(folder / again / "series.csv") == series);
  }
  return whole;
}

}  // namespace dust::test
