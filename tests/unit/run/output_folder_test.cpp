// SPDX-License-Identifier: Apache-2.0
#include "run/folder/output_folder.hpp"

#include "base/error.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("a run shall leave a folder alone that another one has taken since it was chosen") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  dust::run::RunOptions options;
  options.output = out;
  // No other run, or one that has left nothing but its lock.
  CHECK_NOTHROW(dust::run::OutputFolder(options, "s", {}).open());
  fs::remove(out / "run.log");
  {
    dust::run::OutputFolder chosen(options, "s", {});
    std::ofstream(out / "run.log") << "";
    CHECK_NOTHROW(chosen.open());
  }
  for (const char* file : {"summary.json", "run.log"}) {
    CAPTURE(file);
    fs::remove_all(out);
    dust::run::OutputFolder chosen(options, "s", {});
    fs::create_directories(out);
    std::ofstream(out / file) << "of the other run";
    CHECK_THROWS_AS(chosen.open(), dust::base::UserError);
    CHECK(read_file(out / file) == "of the other run");
  }
  // Who replaces it, or goes on in it, has said so.
  std::ofstream(out / "checkpoint.h5") << "of the other run";
  options.resume = true;
  CHECK_NOTHROW(dust::run::OutputFolder(options, "s", {}).open());
  options.resume = false;
  options.force = true;
  CHECK_NOTHROW(dust::run::OutputFolder(options, "s", {}).open());
  CHECK_FALSE(fs::exists(out / "checkpoint.h5"));
}
