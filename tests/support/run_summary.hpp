// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace dust::test {

/// Runs a scenario into a folder, with these arguments besides, and returns its summary.
inline nlohmann::json run_summary(const std::string& scenario, const std::filesystem::path& out,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run", scenario, "-o", out, "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto done = engine(arguments);
  INFO(done.err);
  REQUIRE(done.status == 0);
  return nlohmann::json::parse(read_file(out / "summary.json"));
}

}  // namespace dust::test
