// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"
#include "base/error.hpp"
#include "fake_run.hpp"
#include "report/h5_source.hpp"
#include "support/approx.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <regex>
#include <vector>

using dust::report::write_report;
using dust::test::approx;
using dust::test::fake_figure;
using dust::test::fake_summary;
using dust::test::FakeRun;
using dust::test::holds;
using dust::test::page_data;
using dust::test::RunFolder;
using dust::test::unpacked;
using dust::test::with_role;
using nlohmann::json;

namespace {

std::string page_of(const RunFolder& folder) {
  write_report(folder.path());
  return folder.read("report.html");
}

/// A whole run: every file there is.
void fill(const RunFolder& folder) {
  folder.write("summary.json", fake_summary().dump());
  folder.write("scenario.yaml", "name: transfer_point\n");
  folder.write("series.csv", "time [s],lip/mass_flow [kg/s]\n0,0\n0.1,0.006\n");
  folder.write("report.json",
               json{{"title", "A run"},
                    {"outline",
                     {{{"body", "belt"}, {"polygons", {{{0.0, 0.0}, {0.25, 0.0}, {0.25, 0.3}}}}}}},
                    {"classes", {10e-6, 500e-6}},
                    {"graph_dot", "digraph run { a -> b; }"}}
                   .dump());
  folder.write_h5({});
}

unsigned byte_at(const std::string& bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes.at(at));
}

}  // namespace

TEST_CASE("the report shall ask no other machine for anything") {
  const RunFolder folder;
  fill(folder);
  const std::string page = page_of(folder);
  CHECK(holds(page, "default-src 'none'"));
  CHECK_FALSE(std::regex_search(page, std::regex("(src|href)\\s*=\\s*[\"']?(https?:)?//")));
  CHECK_FALSE(holds(page, "@import"));
  CHECK_FALSE(holds(page, "<link"));
  CHECK_FALSE(std::regex_search(page, std::regex("url\\(\\s*[\"']?https?:")));
  CHECK(holds(page, "uPlot=function"));  // the plotting library is inside
  CHECK_FALSE(holds(page, "{{file:"));
  CHECK(holds(page, "Dust.Picture = class"));  // and so are the page's own scripts
  CHECK_FALSE(std::filesystem::exists(folder.path() / "report.html.part"));
}

TEST_CASE("report.json shall hold the numbers of the summary and what is made of them") {
  const RunFolder folder;
  fill(folder);
  const json page = page_data(page_of(folder));
  const json document = json::parse(folder.read("report.json"));
  CHECK(page == document);
  CHECK(document["schema"] == "dust.report/1");
  CHECK(document["summary"]["state_sha256"] == "0123456789abcdef");
  CHECK(document["scenario"] == "name: transfer_point\n");
  CHECK(document["title"] == "A run");
  CHECK(document["dust"]["headline"]["value"] == 0.01372);
  CHECK(document["dust"]["headline"]["uncertainty"] == 0.0021);
  CHECK(document["stream"][0]["median"]["value"] == 0.128404);
  CHECK(document["stream"][0]["sensor"] == "stream");
  for (const json& row : document["balance"]) CHECK(row["is_closed"] == true);
  // Nodes of a group are listed one by one, not with their sum.
  CHECK(document["cost"]["nodes"].size() == 2);
  CHECK(document["cost"]["grain_steps_per_dem_second"].get<double>() == approx(987654 / 60.0));
  // Made once more, it is the same: what the run left is not lost.
  CHECK(page_data(page_of(folder)) == document);
}

TEST_CASE("the speed of a branch shall be that of its own steps") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["start_from"] = {{"time_s", 0.5}, {"particle_steps", 487654}, {"fluid_steps", 100}};
  folder.write("summary.json", summary.dump());
  const json cost = page_data(page_of(folder))["cost"];
  CHECK(cost["grain_steps_per_dem_second"].get<double>() == approx(500000 / 60.0));
}

TEST_CASE("an open balance shall be called open") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["particles"]["left"] = 49;
  folder.write("summary.json", summary.dump());
  const json balance = page_data(page_of(folder))["balance"];
  CHECK(balance[0]["is_closed"] == false);
  CHECK(balance[0]["difference"] == 1.0);
  CHECK(balance[2]["is_closed"] == true);
}

TEST_CASE("a folder of one's own shall stand before the engine's templates") {
  const RunFolder folder, own;
  fill(folder);
  own.write("run.html",
            "<p>Firm</p><img src=\"{{image:logo}}\">{{file:firm.css}}<script "
            "type=\"application/json\" id=\"run-data\">{{data}}</script>");
  own.write("firm.css", "p { color: red; }");
  own.write("logo.png", "abc");
  write_report(folder.path(), dust::report::Templates(own.path()));
  const std::string page = folder.read("report.html");
  CHECK(holds(page, "<p>Firm</p><img src=\"data:image/png;base64,YWJj\">p { color: red; }"));
  CHECK(page_data(page)["title"] == "A run");
  // What is named but not there is a clear error.
  own.write("run.html", "{{file:missing.js}}");
  CHECK_THROWS_AS(write_report(folder.path(), dust::report::Templates(own.path())),
                  dust::base::UserError);
  CHECK_THROWS_AS(dust::report::Templates(own.path() / "nothing"), dust::base::UserError);
}

TEST_CASE("names from files shall not become markup or script") {
  const RunFolder folder;
  const std::string hostile =
      "</script><script>document.title='taken'</script><img src=x onerror=y>\"'";
  json summary = fake_summary();
  summary["scenario"] = hostile;
  summary["version"] = hostile;
  summary["status"] = hostile;
  summary["timers_s"][hostile] = 1.0;
  summary["sensors"][hostile] = {{hostile, {{"value", 1.0}, {"unit", hostile}}}};
  summary[hostile] = {{hostile, hostile}};
  folder.write("summary.json", summary.dump());
  folder.write("scenario.yaml", "name: '" + hostile + "'\n");
  folder.write("series.csv", "time [s]," + hostile + " [" + hostile + "]\n0,1\n1,2\n");
  folder.write("report.json",
               json{{"title", hostile},
                    {"graph_dot", hostile},
                    {"outline", {{{"body", hostile}, {"segments", {{0.0, 0.0, 1.0, 1.0}}}}}},
                    {"tables",
                     {{{"sensor", hostile},
                       {"title", hostile},
                       {"columns", {hostile}},
                       {"rows", {{hostile}}}}}},
                    {"curves",
                     {{{"sensor", hostile},
                       {"title", hostile},
                       {"x_label", hostile},
                       {"y_label", hostile},
                       {"series", hostile},
                       {"x", {0, 1}},
                       {"y", {0, 1}}}}}}
                   .dump());
  const std::string page = page_of(folder);
  CHECK_FALSE(holds(page, "<script>document"));
  CHECK_FALSE(holds(page, "<img src=x"));
  CHECK(page_data(page)["curves"][0]["title"] == hostile);
}

TEST_CASE("a run without fluid shall have a report without maps of the air") {
  const RunFolder folder;
  fill(folder);
  folder.write_h5({.has_fluid = false});
  const json document = page_data(page_of(folder));
  CHECK(document["air"].is_null());
  CHECK(document["grains"]["frames"].size() == 3);
}

TEST_CASE("a run without fluid shall be shown over the domain of its scenario") {
  const RunFolder folder;
  fill(folder);
  folder.write_h5({.has_fluid = false});
  folder.write("scenario.yaml", "domain: {min: [-10, 0, 0 mm], max: [2, 0.011, 3]}\n");
  const json view = page_data(page_of(folder))["view"];
  CHECK(view[0].get<double>() == approx(-0.01));
  CHECK(view[2].get<double>() == approx(2.0));
  CHECK(view[3].get<double>() == approx(3.0));
  // Without a readable scenario: grains at x 0.25 and 0.5, the belt's outline, a margin of 4 %.
  folder.write("scenario.yaml", "domain: [[[");
  const json found = page_data(page_of(folder))["view"];
  CHECK(found[0].get<double>() == approx(-0.04 * 0.75));
  CHECK(found[2].get<double>() == approx(0.5 + 0.04 * 0.75));
}

TEST_CASE("coarse grains carried along shall not be called dust") {
  const RunFolder folder;
  json summary = fake_summary();
  const auto passage = [](double value, double diameter) {
    return with_role(fake_figure(value, "g/t"), "passage", "mass_per_load", "net", diameter);
  };
  summary["sensors"] = {{"carry_back",
                         {{"all", passage(310.0, 0.0)},
                          {"fine", passage(0.25, 10e-6)},
                          {"coarse", passage(309.75, 300e-6)}}}};
  folder.write("summary.json", summary.dump());
  const json dust = page_data(page_of(folder))["dust"];
  CHECK(dust["spoken_of"] == "passages");
  CHECK(dust["headline"]["value"] == 0.25);
}

TEST_CASE("what lies in a box shall be called dust only where all of it is fine") {
  const auto page_with = [](double size) {
    const RunFolder folder;
    json summary = fake_summary();
    // A sum over classes, and the classes of another figure.
    summary["sensors"] = {{"box",
                           {{"all", with_role(fake_figure(310.0, "g/t"), "stock", "mass_per_load")},
                            {"class", with_role(fake_figure(2.0, "kg/m3"), "stock",
                                                "mass_concentration", "", size)}}}};
    folder.write("summary.json", summary.dump());
    return page_data(page_of(folder))["dust"];
  };
  CHECK(page_with(0.0)["headline"]["value"] == 310.0);
  CHECK(page_with(4e-3).is_null());
}

TEST_CASE("coarse grains shall be painted from the back to the front") {
  const RunFolder folder;
  fill(folder);
  folder.write("scenario.yaml", "domain: {min: [0, 0, 0], max: [1, 1, 1]}\n");
  const auto at = [](std::int64_t id, double x, double y) {
    return dust::test::FakeGrain{.id = id, .diameter = 500e-6, .x = x, .z = 0.5, .y = y};
  };
  folder.write_tracks({{at(1, 0.2, 0.1), at(2, 0.4, 0.9), at(3, 0.6, 0.5), at(4, 0.8, 0.3)}});
  const json frame = page_data(page_of(folder))["grains"]["frames"][0];
  const std::string bytes = unpacked(frame["data"]);
  REQUIRE(frame["n"] == 4);
  std::vector<double> across;
  for (std::size_t k = 0; k < 4; ++k) {
    across.push_back((byte_at(bytes, 2 * k) + 256.0 * byte_at(bytes, 2 * k + 1)) / 65535.0);
  }
  // The eye looks along y.
  const double expected[] = {0.4, 0.6, 0.8, 0.2};
  for (std::size_t k = 0; k < 4; ++k) CHECK(across[k] == approx(expected[k]).epsilon(1e-4));
}

TEST_CASE("dust shall be summed over the openings and set against the dust in the load") {
  const RunFolder folder;
  json summary = fake_summary();
  const auto passage = [&](const char* role, double value, double error) {
    const json other = fake_figure(9.0, "g/t", 1.0), own = fake_figure(value, "g/t", error);
    return json{{"a", with_role(other, role, "mass_per_load", "forward")},
                {"b", with_role(other, role, "mass_per_load", "net")},
                {"c", with_role(other, role, "mass_per_load", "forward", 10e-6)},
                {"d", with_role(own, role, "mass_per_load", "net", 10e-6)}};
  };
  summary["sensors"] = {
      {"left", passage("opening", 0.3, 0.03)},
      {"right", passage("opening", 0.1, 0.04)},
      {"kept", passage("passage", 0.25, 0.01)},
      {"cloud", {{"a", with_role(fake_figure(0.125, "g/t", 0.01), "stock", "mass_per_load")}}}};
  summary["size_classes"] = {{{"diameter_m", 10e-6}, {"mass_kg", {{"emitted", 1e-9}}}},
                             {{"diameter_m", 500e-6}, {"mass_kg", {{"emitted", 1e-3 - 1e-9}}}}};
  folder.write("summary.json", summary.dump());
  const json dust = page_data(page_of(folder))["dust"];
  // Errors add in squares: 0.05. One part in a million is 1 g/t.
  CHECK(dust["headline"]["value"].get<double>() == approx(0.4));
  CHECK(dust["headline"]["uncertainty"].get<double>() == approx(0.05));
  CHECK(dust["fed"].get<double>() == approx(1.0));
  CHECK(dust["openings"].size() == 2);
  CHECK(dust["passages"].size() == 1);
  CHECK(dust["stocks"].size() == 1);
}

TEST_CASE("a run that counted no dust shall say so") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["sensors"] = {
      {"left", {{"a", with_role(fake_figure(0.0, "g/t"), "opening", "mass_per_load", "net")}}}};
  folder.write("summary.json", summary.dump());
  const json dust = page_data(page_of(folder))["dust"];
  CHECK(dust["spoken_of"] == "openings");
  CHECK(dust["headline"]["value"] == 0.0);
}

TEST_CASE("frames shall be shown evenly over the run, the last among them") {
  using Frames = std::vector<std::size_t>;
  CHECK(dust::report::spread_frames(0, 4).empty());
  CHECK(dust::report::spread_frames(4, 0).empty());
  CHECK(dust::report::spread_frames(3, 4) == Frames{0, 1, 2});
  CHECK(dust::report::spread_frames(8, 4) == Frames{1, 3, 5, 7});
  CHECK(dust::report::spread_frames(9, 4) == Frames{2, 5, 8});
}

TEST_CASE("frames without grains shall be shown empty") {
  const RunFolder folder;
  fill(folder);
  folder.write_h5({.coarse_grains = 0, .dust_grains = 0});
  const json grains = page_data(page_of(folder))["grains"];
  REQUIRE(grains["frames"].size() == 3);
  CHECK(grains["frames"][2]["n"] == 0);
  CHECK(unpacked(grains["frames"][2]["data"]).empty());
}

TEST_CASE("a report shall be made of the summary alone") {
  const RunFolder folder;
  folder.write("summary.json", "{}");
  CHECK(holds(page_of(folder), "</html>"));
}

TEST_CASE("damaged side files shall be named in the report, not end it") {
  const RunFolder folder;
  fill(folder);
  folder.write("report.json", "{ \"curves\": [");
  folder.write("results.h5", "not an HDF5 file");
  const json notes = page_data(page_of(folder))["notes"];
  REQUIRE(notes.size() == 2);
  CHECK(holds(notes[0], "report.json is damaged"));
  CHECK(holds(notes[1], "results.h5 cannot be read"));
}

TEST_CASE("frames that are missing shall be told, on the page and to whoever makes it") {
  const RunFolder folder;
  fill(folder);
  CHECK(write_report(folder.path()).empty());
  folder.write("results.h5", "not an HDF5 file");
  CHECK(write_report(folder.path()) ==
        std::vector<std::string>{"results.h5 cannot be read: the pictures are missing."});
}

TEST_CASE("a folder that is no run shall be refused with a remedy") {
  const RunFolder folder;
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      write_report(path);
    } catch (const dust::base::UserError& error) {
      return error.lines().at(0);
    }
    return "";
  };
  const std::string missing = message(folder.path());
  CHECK(holds(missing, folder.path().string()));
  CHECK(holds(missing, "summary.json"));
  CHECK(holds(missing, "engine run"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "report.html"));
  CHECK(holds(message(folder.path() / "nothing"), "not a folder"));
  folder.write("summary.json", "[1, 2");
  CHECK(holds(message(folder.path()), "damaged"));
}

TEST_CASE("grains shall come back from the page where they were") {
  const RunFolder folder;
  fill(folder);
  const json grains = page_data(page_of(folder))["grains"];
  const json& frame = grains["frames"][1];
  CHECK(frame["t"].get<double>() == approx(0.1));
  REQUIRE(frame["n"] == 45);
  REQUIRE(frame["dust"] == 5);
  const std::string bytes = unpacked(frame["data"]);
  REQUIRE(bytes.size() == 5 * 4 + 45 * 8);
  const auto word = [&](std::size_t at) {
    return byte_at(bytes, at) + 256 * byte_at(bytes, at + 1);
  };
  // Half a step of 16 bits over a view of 1 m; dust stands last, at (0.25, 0.75).
  CHECK(word(20) == approx(0.5 * 65535).epsilon(1e-4));
  CHECK(word(20 + 2 * 44) == approx(0.25 * 65535).epsilon(1e-4));
  CHECK(word(20 + 90 + 2 * 44) == approx(0.75 * 65535).epsilon(1e-4));
  CHECK(byte_at(bytes, 20 + 180) == 1);       // 500 um
  CHECK(byte_at(bytes, 20 + 180 + 44) == 0);  // 10 um
}

TEST_CASE("crowded frames shall be thinned, the dust kept and the reader told") {
  const RunFolder folder;
  fill(folder);
  folder.write_h5({.frames = 1, .coarse_grains = 50000, .dust_grains = 30, .has_fluid = false});
  const json grains = page_data(page_of(folder))["grains"];
  const int shown = grains["frames"][0]["n"];
  CHECK(grains["frames"][0]["dust"] == 30);
  CHECK(grains["frames"][0]["all"] == 50030);
  // 20,000 expected; five standard deviations of the draw are 550.
  CHECK(shown - 30 > 19450);
  CHECK(shown - 30 < 20550);
  CHECK(grains["share"].get<double>() == approx(0.4));
}

TEST_CASE("the air map shall hold the mean over the depth and mask bodies") {
  const RunFolder folder;
  fill(folder);
  const json air = page_data(page_of(folder))["air"];
  REQUIRE(air["nx"] == 4);
  REQUIRE(air["nz"] == 3);
  CHECK(air["speed"].get<double>() == approx(2.0));
  CHECK(air["low"].get<double>() == approx(-1.0));
  CHECK(air["high"].get<double>() == approx(1.0));
  std::string codes = unpacked(air["frames"][0]["data"]);
  REQUIRE(codes.size() == 4 * 12);  // speed, pressure, and the direction on the same cells
  std::array<std::array<unsigned, 12>, 4> fields{};
  for (std::size_t f = 0; f < 4; ++f) {
    unsigned sum = 0;
    for (std::size_t k = 0; k < 12; ++k)
      fields[f][k] = sum = (sum + byte_at(codes, 12 * f + k)) & 255;
  }
  CHECK(fields[0][0] == 255);
  CHECK(fields[0][1] == 254);  // 2 m/s is the end of the scale
  CHECK(fields[1][0] == 255);
  CHECK(fields[1][1] == 0);    // -1 Pa; z = 0 and the first row of z = 1 lie in the low half
  CHECK(fields[1][5] == 127);  // the middle layer: -1 Pa in one row of the depth, +1 in the other
  CHECK(fields[1][11] == 254);
  CHECK(fields[2][1] == 254);
  CHECK(fields[3][1] == 127);
}

TEST_CASE("a plot of fewer points than rows shall keep what means are means of") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["series"] = {{"plate/force_z [N]", "mean"}, {"plate/contacts [1]", "instant"}};
  folder.write("summary.json", summary.dump());
  constexpr int k_rows = 8000;  // four times as many as are plotted
  std::string text = "time [s],plate/force_z [N],plate/contacts [1]\n0,0,0\n";
  for (int k = 1; k <= k_rows; ++k) {
    // One row in 40 holds a blow.
    text += std::to_string(0.001 * k) + "," + (k % 40 == 1 ? "40" : "0") + "," +
            std::to_string(k % 7) + "\n";
  }
  folder.write("series.csv", text);
  dust::report::write_report(folder.path());
  const json series = page_data(folder.read("report.html"))["series"];
  REQUIRE(series.size() == 3);
  const auto& force = series[1]["values"];
  REQUIRE(force.size() < 2100);
  const double interval =
      series[0]["values"][2].get<double>() - series[0]["values"][1].get<double>();
  double impulse = 0.0;
  for (const auto& value : force) impulse += value.get<double>() * interval;
  CHECK(impulse == approx(0.001 * 40 * k_rows / 40).epsilon(1e-4));
  CHECK(series[2]["values"].back() == k_rows % 7);
}
