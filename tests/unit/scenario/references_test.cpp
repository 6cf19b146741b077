// SPDX-License-Identifier: Apache-2.0
#include "run/summary/references.hpp"

#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using dust::test::approx;

namespace scenario = dust::scenario;
using Json = nlohmann::ordered_json;

namespace {

std::vector<scenario::ReferenceSpec> read_list(const std::string& list) {
  const Folder folder;
  return read(folder.write("s.yaml", k_small + "references:\n" + list)).references;
}

}  // namespace

TEST_CASE("a reference shall be kept in the unit of its figure") {
  const auto list = read_list(
      "  - {quantity: sensors.stream.angle, value: 41.6 deg, uncertainty: 0.01 rad, source: t}\n"
      "  - {quantity: sensors.stream.angle, value: 0.5, source: bare is SI}\n"
      "  - {quantity: sensors.stream.rate, value: 6 g/s, source: t}\n"
      "  - {quantity: sensors.stream.drop_5_mm/median, value: 12 mm, source: t}\n"
      "  - {quantity: sensors.stream.count, value: 12, source: t}\n");
  REQUIRE(list.size() == 5);
  CHECK(list[0].sensor == "stream");
  CHECK(list[0].figure == "angle");
  CHECK(list[0].value == 41.6);  // as written
  CHECK(list[0].unit == "deg");
  CHECK(list[0].uncertainty == approx(1.8 / std::numbers::pi).epsilon(1e-14));
  CHECK(list[1].value == approx(90.0 / std::numbers::pi).epsilon(1e-14));
  CHECK(list[1].uncertainty < 0.0);
  CHECK(list[2].value == approx(6e-3).epsilon(1e-14));
  CHECK(list[3].figure == "drop_5_mm/median");
  CHECK(list[3].value == approx(12e-3).epsilon(1e-14));
  CHECK(list[4].value == 12.0);
}

TEST_CASE("a reference curve shall take the axes of the sensor's curve that it fits") {
  const Folder folder;
  const auto curves =
      read(folder.write(
               "s.yaml",
               k_small +
                   "reference_curves:\n"
                   "  - {sensor: stream, x: [0, 20, 40 ms], y: [0, 0.1, 0.2 rad], source: t}\n"
                   "  - {sensor: stream, x: [1, 2], y: [3 cm, 4 cm], source: bare is SI}\n"
                   "  - {sensor: stream, x: [0, 1 s], y: [0.5, 1], source: t}\n"))
          .reference_curves;
  REQUIRE(curves.size() == 3);
  CHECK(curves[0].sensor == "stream");
  CHECK(curves[0].axes.title == "Angle");
  CHECK(curves[0].axes.y_label == "angle [deg]");
  CHECK(curves[0].x[1] == approx(0.02).epsilon(1e-14));
  CHECK(curves[0].y[2] == approx(36.0 / std::numbers::pi).epsilon(1e-14));
  CHECK(curves[0].source == "t");
  CHECK(curves[1].axes.title == "Path");
  CHECK(curves[1].x[1] == 2.0);
  CHECK(curves[1].y[1] == approx(0.04).epsilon(1e-14));
  CHECK(curves[2].axes.title == "Share");
  CHECK(curves[2].y[0] == 0.5);
}

TEST_CASE("a reference curve of a sensor that is switched off shall be left out") {
  const Folder folder;
  const auto file =
      folder.write("s.yaml", k_small +
                                 "reference_curves:\n"
                                 "  - {sensor: stream, x: [0, 1 s], y: [0, 1 deg], source: t}\n");
  CHECK(read(file).reference_curves.size() == 1);
  CHECK(read(file, {{"sensors.stream.enabled", "false"}}).reference_curves.empty());
}

TEST_CASE("a figure of a size class shall have the unit of that of all sizes") {
  const auto list = read_list(
      "  - {quantity: sensors.stream.class_10_um/rate, value: 5 g/s, source: t}\n"
      "  - {quantity: sensors.stream.drop_5_mm/class_10_um/median, value: 12 mm, source: t}\n");
  REQUIRE(list.size() == 2);
  CHECK(list[0].unit == "kg/s");
  CHECK(list[0].value == approx(5e-3).epsilon(1e-14));
  CHECK(list[1].unit == "m");
  CHECK(list[1].value == approx(12e-3).epsilon(1e-14));
}

TEST_CASE("a figure that there is of size classes alone shall be taken on trust") {
  const auto list =
      read_list("  - {quantity: sensors.stream.class_10_um/spread, value: 0.05 g/t, source: t}\n");
  REQUIRE(list.size() == 1);
  CHECK(list[0].unit == "g/t");
  CHECK(list[0].value == 0.05);
}

TEST_CASE("a reference to a sensor that is switched off shall be left out") {
  const Folder folder;
  const auto file = folder.write(
      "s.yaml",
      k_small + "references:\n  - {quantity: sensors.stream.count, value: 1, source: t}\n");
  CHECK(read(file).references.size() == 1);
  CHECK(read(file, {{"sensors.stream.enabled", "false"}}).references.empty());
}

TEST_CASE("a reference shall be compared in the unit of the figure") {
  const std::vector<scenario::ReferenceSpec> references{
      {"slope", "class_10_um/width", 60.1, "mm", 0.2, "t"},
      {"slope", "class_10_um/width", 3.0, "kg", -1.0, "t"}};
  const Json sensors = {
      {"slope",
       {{"class_10_um/width", {{"value", 0.0601}, {"unit", "m"}, {"uncertainty", nullptr}}}}}};
  const Json list = dust::run::references_json(references, sensors);
  CHECK(list[0]["unit"] == "m");
  CHECK(list[0]["value"].get<double>() == approx(0.0601).epsilon(1e-12));
  CHECK(list[0]["uncertainty"].get<double>() == approx(2e-4).epsilon(1e-12));
  CHECK(list[0]["error_percent"].get<double>() < 1e-9);
  CHECK(list[1]["ours"].is_null());  // a mass is no width
  CHECK(list[1]["unit"] == "kg");
  CHECK(list[1]["problem"] == "the figure is in m, not in kg");
  CHECK(!list[0].contains("problem"));
}

TEST_CASE("ours shall stand beside the reference with the difference in per cent") {
  const std::vector<scenario::ReferenceSpec> references{
      {"slope", "angle", 41.6, "deg", 1.1, "thesis"},
      {"slope", "count", 0.0, "1", -1.0, "zero"},
      {"slope", "class_10_um/rate", 2.0, "g/t", -1.0, "never seen"}};
  const Json sensors = {{"slope",
                         {{"angle", {{"value", 39.52}, {"unit", "deg"}, {"uncertainty", 0.4}}},
                          {"count", {{"value", 3.0}, {"unit", "1"}, {"uncertainty", nullptr}}}}}};
  const Json list = dust::run::references_json(references, sensors);
  REQUIRE(list.size() == 3);
  CHECK(list[0]["quantity"] == "sensors.slope.angle");
  CHECK(list[0]["ours"] == 39.52);
  CHECK(list[0]["our_uncertainty"] == 0.4);
  CHECK(list[0]["value"] == 41.6);
  CHECK(list[0]["uncertainty"] == 1.1);
  CHECK(list[0]["error_percent"].get<double>() == approx(5.0).epsilon(1e-9));
  CHECK(list[1]["error_percent"].is_null());  // per cent of nothing
  CHECK(list[1]["uncertainty"].is_null());
  CHECK(list[2]["ours"].is_null());
  const auto lines = dust::run::reference_lines(list);
  REQUIRE(lines.size() == 3);
  CHECK(
      lines[0] ==
      "sensors.slope.angle: ours 39.52 +- 0.4 deg, reference 41.6 +- 1.1 deg, 5.0 % off (thesis)");
  CHECK(lines[1] == "sensors.slope.count: ours 3, reference 0 (zero)");
  CHECK(lines[2] ==
        "sensors.slope.class_10_um/rate: ours - g/t, reference 2 g/t (never seen); not "
        "compared: the run has no such figure: a class of sizes that never came, or "
        "its name");
}
