// SPDX-License-Identifier: Apache-2.0
#include "study/launchers/launcher.hpp"

#include <doctest/doctest.h>

#include <unistd.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace study = dust::study;
namespace fs = std::filesystem;

namespace {

/// A folder with a program in the engine's place: it notes when it begins and ends, and what others
/// are running in between.
class Bench {
 public:
  Bench() : folder_(fs::temp_directory_path() / ("dust_launcher_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "points");
    const fs::path engine = folder_ / "engine";
    // $2 is the scenario. mkdir is atomic: a folder per run that is under way.
    std::ofstream(engine) << "#!/bin/sh\n"
                          << "cd " << folder_ << "\n"
                          << "mkdir run_$(basename \"$2\" .yaml)\n"
                          << "sleep 0.6\n"
                          << "ls -d run_* | wc -l >> together\n"
                          << "sleep 0.6\n"
                          << "rmdir run_$(basename \"$2\" .yaml)\n";
    fs::permissions(engine, fs::perms::owner_all);
  }
  ~Bench() {
    std::error_code code;
    fs::remove_all(folder_, code);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// The most runs that saw each other, of points that need so much memory each.
  int most_together(const std::vector<double>& needs, double budget, int jobs) {
    std::vector<study::Point> points;
    for (std::size_t n = 0; n < needs.size(); ++n) {
      study::Point point;
      point.hash = "p" + std::to_string(n);
      point.memory_bytes = needs[n];
      points.push_back(point);
    }
    const study::PointStore store(folder_);
    const auto launcher =
        study::make_local_launcher(store, {folder_ / "engine", {}, jobs, 1, budget});
    std::size_t ended = 0;
    const int signal = launcher->run(points, [&](const study::JobResult& result) {
      CHECK_MESSAGE(result.is_good, result.reason);
      ++ended;
      return true;
    });
    CHECK(signal == 0);
    CHECK(ended == needs.size());
    int most = 0;
    std::ifstream stream(folder_ / "together");
    for (int seen = 0; stream >> seen;) most = std::max(most, seen);
    return most;
  }

 private:
  fs::path folder_;
};

}  // namespace

TEST_CASE("points shall run side by side where cores and memory allow it") {
  CHECK(Bench().most_together({100, 100, 100}, 300, 3) == 3);
}

TEST_CASE("points that would exceed the memory together shall be held back") {
  CHECK(Bench().most_together({100, 100, 100}, 150, 3) == 1);
  CHECK(Bench().most_together({100, 100, 100, 100}, 250, 4) == 2);
}

TEST_CASE("a point that needs more than there is shall run alone, not never") {
  CHECK(Bench().most_together({400, 100, 100}, 250, 3) == 2);
  CHECK(Bench().most_together({100, 400}, 250, 2) == 1);
}

TEST_CASE("no more points shall run than there are jobs") {
  CHECK(Bench().most_together({1, 1, 1}, 1e9, 2) == 2);
}
