// SPDX-License-Identifier: Apache-2.0
#include "base/log.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace dust::base;

TEST_CASE("a line shall stand in the log as soon as it is logged") {
  // Who follows a run reads it while the run goes on, and of one that was killed it is all there
  // is.
  const auto file = std::filesystem::temp_directory_path() /
                    ("dust-log-test-" + std::to_string(::getpid()) + ".log");
  log_to_file(file, false);
  log_info("t = 0.05 s: 2166 grains");
  std::ifstream in(file);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  CHECK(text.ends_with(" info t = 0.05 s: 2166 grains\n"));
  std::filesystem::remove(file);
}
