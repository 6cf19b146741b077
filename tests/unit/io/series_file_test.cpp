// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/run_files.hpp"
#include "unit/io/synthetic_frame.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

using dust::io::SeriesFile;
using dust::test::TemporaryFolder;
using dust::test::text_of;

namespace {

const std::vector<std::string> k_names = {"time [s]", "mass [kg]"};

void append(SeriesFile& file, double a, double b) {
  const double values[] = {a, b};
  file.append(k_names, values);
}

}  // namespace

TEST_CASE("the series shall hold numbers that read back as the same double") {
  const TemporaryFolder folder;
  SeriesFile file(folder.path() / "series.csv", -1);
  const double values[] = {0.1,  1.0 / 3.0,          5e-324, 1.7976931348623157e308,
                           -0.0, 12345678901234567.0};
  for (const double v : values) append(file, v, v);
  std::istringstream in(text_of(folder.path() / "series.csv"));
  std::string line;
  std::getline(in, line);
  CHECK(line == "time [s],mass [kg]");
  for (const double v : values) {
    std::getline(in, line);
    const double back = std::strtod(line.c_str(), nullptr);
    CHECK(back == v);
    CHECK(std::signbit(back) == std::signbit(v));
  }
  CHECK(file.rows() == 6);
}

TEST_CASE("what has no value shall be an empty field of the series") {
  const TemporaryFolder folder;
  SeriesFile file(folder.path() / "series.csv", -1);
  append(file, 1.0, std::nan(""));
  append(file, 2.0, 3.0);
  CHECK(text_of(folder.path() / "series.csv") == "time [s],mass [kg]\n1,\n2,3\n");
}

TEST_CASE("columns that change shall be told by their names, also after a resume") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  const std::vector<double> values(3, 0.0);
  const auto problem = [&](std::int64_t rows, const std::vector<std::string>& names) {
    try {
      SeriesFile file(path, rows);
      if (rows < 0) append(file, 1.0, 2.0);
      file.append(names, std::span(values).first(names.size()));
    } catch (const dust::base::RunError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  for (const std::int64_t rows : {-1, 1}) {
    CAPTURE(rows);
    CHECK(problem(rows, {"time [s]", "mass [kg]", "probe/m, n [kg]"})
              .find("changed during the run: 'probe/m, n [kg]' is new; a sensor's columns") !=
          std::string::npos);
    CHECK(problem(rows, {"time [s]"}).find("'mass [kg]' is gone") != std::string::npos);
    CHECK(problem(rows, {"time [s]", "probe/q [kg]"}).find("'mass [kg]' is 'probe/q [kg]' now") !=
          std::string::npos);
    CHECK(problem(rows, k_names).empty());
  }
}

TEST_CASE("a resumed series shall be cut back to the checkpoint, half a row included") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  {
    SeriesFile file(path, -1);
    for (int i = 0; i < 5; ++i) append(file, i, i);
  }
  std::ofstream(path, std::ios::app) << "5,";
  {
    SeriesFile file(path, 3);
    CHECK(file.rows() == 3);
    append(file, 30, 31);
  }
  CHECK(text_of(path) == "time [s],mass [kg]\n0,0\n1,1\n2,2\n30,31\n");
  {
    SeriesFile file(path, 0);
    append(file, 7, 8);
  }
  CHECK(text_of(path) == "time [s],mass [kg]\n7,8\n");
}

TEST_CASE("a series with fewer rows than the checkpoint knows shall be refused") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  {
    SeriesFile file(path, -1);
    append(file, 1, 2);
  }
  CHECK_THROWS_AS(SeriesFile(path, 2), dust::base::UserError);
}

TEST_CASE("columns that change during a run shall be an error") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  SeriesFile file(path, -1);
  append(file, 1, 2);
  const std::vector<std::string> other = {"time [s]", "energy [J]"};
  const double values[] = {1, 2};
  CHECK_THROWS_AS(file.append(other, values), dust::base::RunError);
}

TEST_CASE("a name with a comma shall stay one column") {
  const TemporaryFolder folder;
  SeriesFile file(folder.path() / "series.csv", -1);
  const std::vector<std::string> names = {"a, b [1]"};
  const double values[] = {2.0};
  file.append(names, values);
  CHECK(text_of(folder.path() / "series.csv") == "\"a, b [1]\"\n2\n");
}

TEST_CASE("a text shall be replaced whole and leave nothing beside it") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "summary.json";
  dust::io::write_text(path, "first, and longer");
  dust::io::write_text(path, "second");
  CHECK(text_of(path) == "second");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
  }
  CHECK(files == 1);
  CHECK_THROWS_AS(dust::io::write_text(folder.path() / "no" / "folder", "x"), dust::base::RunError);
}

TEST_CASE("rows that are missing before the checkpoint shall be told with how the state goes on") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  {
    SeriesFile file(path, -1);
    append(file, 0.0, 1.0);
  }
  std::string problem;
  try {
    SeriesFile file(path, 2);
  } catch (const dust::base::UserError& e) {
    problem = e.what();
  }
  const auto way = problem.find("--set start_from=" + folder.path().string());
  CHECK_MESSAGE(way != std::string::npos, problem);
  CHECK(way < problem.find("--force"));
}
