// SPDX-License-Identifier: Apache-2.0
#include "fake_run.hpp"
#include "report/report.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using dust::report::write_report;
using dust::test::approx;
using dust::test::fake_summary;
using dust::test::FakeGrain;
using dust::test::FakeSurface;
using dust::test::page_data;
using dust::test::RunFolder;
using dust::test::unpacked;
using nlohmann::json;

namespace {

/// A run in the box (0, 0, 0) to (2, 1, 1) m.
void fill_box(const RunFolder& folder, const char* far_corner = "[2, 1, 1]") {
  folder.write("summary.json", fake_summary().dump());
  folder.write("scenario.yaml", std::string("domain: {min: [0, 0, 0], max: ") + far_corner + "}\n");
}

json page_document(const RunFolder& folder) {
  write_report(folder.path());
  return page_data(folder.read("report.html"));
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, int width) {
  std::uint32_t value = 0;
  for (int k = width; k-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(k)));
  }
  return value;
}

/// Corners of a set as the page reads them, as shares of the box.
std::vector<std::array<double, 3>> corners_of(const json& set) {
  const std::string bytes = unpacked(set["data"]);
  const std::size_t points = set["points"], triangles = set["triangles"];
  std::vector<std::array<double, 3>> corners;
  for (std::size_t k = 0; k < 3 * triangles; ++k) {
    const std::size_t at = number_at(bytes, 4 * k, 4);
    std::array<double, 3> corner{};
    for (std::size_t d = 0; d < 3; ++d) {
      corner[d] = number_at(bytes, 12 * triangles + 2 * (d * points + at), 2) / 65535.0;
    }
    corners.push_back(corner);
  }
  return corners;
}

/// Two triangles, of body 0 at x = 0.5 m and of body 2 at z = `height` [m].
FakeSurface two_bodies(float height) {
  return {{0.5F, 0.0F, 0.0F, 0.5F, 1.0F, 0.0F, 0.5F, 0.0F, 1.0F,  //
           0.0F, 0.0F, height, 2.0F, 0.0F, height, 2.0F, 1.0F, height},
          {0, 1, 2, 3, 4, 5},
          {0, 2}};
}

/// A square of 2 n^2 triangles that bulges a little, all of body 0.
FakeSurface fine_square(int n) {
  FakeSurface square;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(n);
      const float y = static_cast<float>(j) / static_cast<float>(n);
      square.points.insert(square.points.end(), {2.0F * x, y, 0.5F + 0.1F * x * y});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      for (const int corner : {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1}) {
        square.triangles.push_back(corner);
      }
      square.body.insert(square.body.end(), {0, 0});
    }
  }
  return square;
}

}  // namespace

TEST_CASE("surfaces shall come back from the page where they were, body by body") {
  const RunFolder folder;
  fill_box(folder);
  folder.write_surfaces({two_bodies(0.25F)}, {"belt", "hood", "spoon"});
  const json surfaces = page_document(folder)["space"]["surfaces"];
  CHECK(surfaces["names"] == json{"belt", "hood", "spoon"});
  REQUIRE(surfaces["sets"].size() == 1);
  CHECK(surfaces["coarsened"] == false);
  const json& set = surfaces["sets"][0];
  CHECK(set["bodies"] == json{{0, 0, 1}, {2, 1, 1}});
  const auto corners = corners_of(set);
  REQUIRE(corners.size() == 6);
  // Half a step of 16 bits.
  constexpr double k_step = 0.5 / 65535.0;
  CHECK(std::abs(corners[0][0] - 0.25) <= k_step);
  CHECK(std::abs(corners[1][1] - 1.0) <= k_step);
  CHECK(std::abs(corners[5][0] - 1.0) <= k_step);
  CHECK(std::abs(corners[5][2] - 0.25) <= k_step);
}

TEST_CASE(
    "surfaces that reach out of the domain shall end at its sides and not be pressed flat there") {
  const RunFolder folder;
  fill_box(folder);
  // A strip along x from 1 m inside the box (2, 1, 1) m to far outside, and one wholly below it.
  const FakeSurface strips = {{1.0F, 0.2F, 0.5F, 5.0F, 0.2F, 0.5F, 5.0F, 0.8F, 2.5F,  //
                               0.0F, 0.0F, -0.3F, 1.0F, 0.0F, -0.3F, 1.0F, 1.0F, -0.1F},
                              {0, 1, 2, 3, 4, 5},
                              {0, 1}};
  folder.write_surfaces({strips}, {"belt", "return_run"});
  const json set = page_document(folder)["space"]["surfaces"]["sets"][0];
  REQUIRE(set["bodies"].size() == 1);
  CHECK(set["bodies"][0][0] == 0);
  bool reaches_side = false;
  for (const auto& corner : corners_of(set)) {
    // The plane of the strip: z - 0.5 = (y - 0.2) 2 / 0.6 [m]; x, y, z are shares of 2, 1 and 1 m.
    CHECK(corner[2] - 0.5 == approx((corner[1] - 0.2) * 2.0 / 0.6).scale(1.0).epsilon(1e-4));
    reaches_side = reaches_side || corner[0] == 1.0;
  }
  CHECK(reaches_side);
}

TEST_CASE("surfaces that stay shall be stored once, those that move frame by frame") {
  const RunFolder folder;
  fill_box(folder);
  folder.write_surfaces({two_bodies(0.2F), two_bodies(0.2F), two_bodies(0.4F)}, {"a", "b", "c"});
  const json surfaces = page_document(folder)["space"]["surfaces"];
  REQUIRE(surfaces["sets"].size() == 2);
  CHECK(surfaces["shown"] == json{0, 0, 1});
  CHECK(corners_of(surfaces["sets"][1])[3][2] == approx(0.4).epsilon(1e-4));
}

TEST_CASE("surfaces too fine for a page shall be coarsened and the reader told") {
  const RunFolder folder;
  fill_box(folder);
  folder.write_surfaces({fine_square(180)}, {"liner"});
  const json surfaces = page_document(folder)["space"]["surfaces"];
  const std::size_t shown = surfaces["sets"][0]["triangles"];
  CHECK(surfaces["coarsened"] == true);
  CHECK(shown <= 40000);
  CHECK(shown >= 5000);
  double highest = 0.0;
  for (const auto& corner : corners_of(surfaces["sets"][0])) highest = std::max(highest, corner[2]);
  CHECK(highest == approx(0.6).epsilon(0.01));
}

TEST_CASE("damaged surfaces shall be left out") {
  const RunFolder folder;
  fill_box(folder);
  FakeSurface damaged = two_bodies(0.2F);
  damaged.triangles[4] = 99;
  folder.write_surfaces({damaged}, {"a", "b", "c"});
  CHECK(page_document(folder)["space"]["surfaces"].is_null());
}

TEST_CASE("grains shall have their depth") {
  const RunFolder folder;
  fill_box(folder);
  folder.write_tracks({{FakeGrain{.id = 1, .diameter = 5e-4, .x = 0.5, .z = 0.5, .y = 0.25}}});
  const json data = page_document(folder);
  CHECK(data["space"]["is_thin"] == false);
  REQUIRE(data["grains"]["depth_bytes"] == 2);
  // x, z of two bytes, size and speed of one; then y, the higher byte first.
  const std::string bytes = unpacked(data["grains"]["frames"][0]["data"]);
  REQUIRE(bytes.size() == 8);
  const double y = 256.0 * number_at(bytes, 6, 1) + number_at(bytes, 7, 1);
  CHECK(y / 65535.0 == approx(0.25).epsilon(1e-4));
}

TEST_CASE("a thin domain shall be seen from the side first and carry no air in three dimensions") {
  const RunFolder folder;
  fill_box(folder, "[2, 0.1, 1]");
  folder.write_tracks({{FakeGrain{.id = 1, .diameter = 5e-4, .x = 0.5, .z = 0.5, .y = 0.025}}});
  const json data = page_document(folder);
  CHECK(data["space"]["is_thin"] == true);
  CHECK(data["space"]["air"].is_null());
  const std::string bytes = unpacked(data["grains"]["frames"][0]["data"]);
  REQUIRE(bytes.size() == 7);
  CHECK(std::abs(number_at(bytes, 6, 1) / 256.0 - 0.25) <= 1.0 / 256.0);
}

TEST_CASE("the air in three dimensions shall be that of the cells") {
  const RunFolder folder;
  fill_box(folder);
  folder.write_h5({});  // 4 x 2 x 3 cells, u = 2 m/s, the column x = z = 0 in a body
  const json air = page_document(folder)["space"]["air"];
  REQUIRE(air["frames"].size() == 3);
  CHECK(air["count"] == json{4, 2, 3});
  CHECK(air["step"][1].get<double>() == approx(0.1));
  CHECK(air["speed"].get<double>() == approx(2.0));
  std::string bytes = unpacked(air["frames"][2]["data"]);
  REQUIRE(bytes.size() == 3 * 24);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    if (k % 24 != 0) bytes[k] = static_cast<char>(bytes[k] + bytes[k - 1]);
  }
  CHECK(number_at(bytes, 0, 1) == 255);   // in the body
  CHECK(number_at(bytes, 4, 1) == 255);   // its second row
  CHECK(number_at(bytes, 1, 1) == 254);   // u: the end of the scale
  CHECK(number_at(bytes, 25, 1) == 127);  // v: none
  CHECK(number_at(bytes, 71, 1) == 127);
}
