// SPDX-License-Identifier: Apache-2.0
#include "study/study_folder.hpp"

#include "base/error.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

using dust::test::TemporaryFolder;
namespace fs = std::filesystem;
namespace study = dust::study;

TEST_CASE("a study shall leave a folder alone that another one has taken since it was chosen") {
  const TemporaryFolder folder;
  study::StudyOptions options;
  options.output = folder / "out";
  const fs::path chosen = study::choose_study_folder(options, "s", {});
  fs::create_directories(chosen);
  const study::FolderLock lock(chosen);
  CHECK_NOTHROW(study::check_still_unused(options, chosen));
  std::ofstream(chosen / "study.csv") << "x\n";
  CHECK_THROWS_AS(study::check_still_unused(options, chosen), dust::base::UserError);
  options.resume = true;
  CHECK_NOTHROW(study::check_still_unused(options, chosen));
}
