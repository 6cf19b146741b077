// SPDX-License-Identifier: Apache-2.0
#include "fake_run.hpp"
#include "io/report.hpp"
#include "io/report_fast_dust.hpp"

#include <doctest/doctest.h>

#include <regex>

using dust::test::fake_summary;
using dust::test::RunFolder;
using nlohmann::json;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

json figure(double value, const char* unit, double error = -1.0) {
  json f = {{"value", value}, {"unit", unit}, {"uncertainty", nullptr}};
  if (error >= 0.0) f["uncertainty"] = error;
  return f;
}

/// Quartz of 10 um: 2650 pi / 6 (10 um)^3 [kg].
constexpr double k_grain = 1.38754e-12;

/// Two openings watched for 0.19 s: 100 and 20 grains a second of 10 um.
json run_with_openings() {
  json summary = fake_summary();
  const auto opening = [](double grams_per_tonne, double error, double rate) {
    return json{{"observed_time", figure(0.19, "s")},
                {"net/grams_per_tonne", figure(grams_per_tonne, "g/t", error)},
                {"class_10_um/forward/number_rate", figure(rate, "1/s")},
                {"class_10_um/forward/mass_rate", figure(rate * k_grain, "kg/s")},
                {"class_10_um/net/grams_per_tonne", figure(grams_per_tonne, "g/t", error)}};
  };
  summary["sensors"] = {{"dust_out_left", opening(0.5, 0.03, 100.0)},
                        {"dust_out_top", opening(0.1, 0.04, 20.0)},
                        {"suction",
                         {{"place_1/x", figure(0.9, "m")},
                          {"place_1/z", figure(0.9, "m")},
                          {"place_1/depth", figure(0.4, "Pa", 0.01)},
                          {"place_2/x", figure(0.25, "m")},
                          {"place_2/z", figure(0.75, "m")},
                          {"place_2/depth", figure(0.3, "Pa", 0.01)}}}};
  summary["size_classes"] = {{{"diameter_m", 10e-6}, {"mass_kg", {{"emitted", 1e-9}}}},
                             {{"diameter_m", 500e-6}, {"mass_kg", {{"emitted", 1e-3 - 1e-9}}}}};
  return summary;
}

/// The part of the page before the first section below the header.
std::string first_screen(const RunFolder& folder) {
  dust::io::write_report(folder.path());
  const std::string page = folder.read("report.html");
  return page.substr(page.find("<header>"), page.find("</header>") - page.find("<header>"));
}

}  // namespace

TEST_CASE("the first screen shall tell how much, from where, how sure and where to extract") {
  const RunFolder folder;
  folder.write("summary.json", run_with_openings().dump());
  folder.write_h5({});
  const std::string screen = first_screen(folder);
  // Errors of independent counts add in squares: 0.05 of 0.6 g/t, 8.3 %.
  CHECK(has(screen, "0.600\u00a0\u00b1\u00a00.050"));
  CHECK(has(screen, "<em>left</em>"));
  CHECK(has(screen, "<em>top</em>"));
  CHECK(has(screen, "\u00b1\u202f8.3\u202f%"));
  CHECK(has(screen, "22.8 real grains"));
  // 16.28 um aerodynamic: 0.5 (1 + exp(-0.9767)) = 68.8 %; of that 1 - F(ln(16.28 / 11.64) /
  // ln 1.5).
  CHECK(has(screen, "69\u202f% inhalable, 14\u202f% thoracic"));
  // The dust of the frames lies at (0.25, 0.75): ring 2, not the deepest.
  CHECK(has(screen, "x\u202f250, z\u202f750"));
  CHECK(has(screen, "100\u202f% of the dust"));
  // Bars in shares of the 1 g/t that the load holds: 0.5 with 0.03, 0.1 with 0.04 to either side.
  const std::string page = folder.read("report.html");
  CHECK(has(page, "style=\"width:50.0%\"></i><s style=\"left:47.0%;width:6.0%\"></s>"));
  CHECK(has(page, "style=\"width:10.0%\"></i><s style=\"left:6.0%;width:8.0%\"></s>"));
  // The only size class gets out with 0.6, 0.05.
  CHECK(has(page, "style=\"width:60.0%\"></i><s style=\"left:55.0%;width:10.0%\"></s>"));
}

TEST_CASE("dust shall be told by where it parted from the coarse grains") {
  const RunFolder folder;
  folder.write("summary.json", run_with_openings().dump());
  // Three frames: dust beside a coarse grain at (0.1, 0.2), at (0.3, 0.2), then away from all.
  // A second one stays with its coarse grain, a third was never near one.
  folder.write_tracks(
      {{{1, 500e-6, 0.1, 0.2},
        {2, 10e-6, 0.1005, 0.2},
        {3, 500e-6, 0.6, 0.6},
        {4, 10e-6, 0.6, 0.6005},
        {5, 10e-6, 0.9, 0.9}},
       {{1, 500e-6, 0.3, 0.2},
        {2, 10e-6, 0.3, 0.2009},
        {4, 10e-6, 0.6, 0.6},
        {3, 500e-6, 0.6, 0.6}},
       {{1, 500e-6, 0.5, 0.1}, {2, 10e-6, 0.2, 0.4}, {3, 500e-6, 0.6, 0.6}, {4, 10e-6, 0.6, 0.6}}});
  folder.write("scenario.yaml", "domain: {min: [0, 0, 0], max: [1, 1, 1]}\n");
  const std::string screen = first_screen(folder);
  CHECK(has(screen, "near x\u202f310, z\u202f210\u202fmm: 100"));
  // One grain of quartz in 1 g of load.
  const std::string page = folder.read("report.html");
  CHECK(has(page, "x\u202f300 to 320, z\u202f200 to 220\u202fmm"));
  CHECK_FALSE(has(page, "x\u202f600 to 620"));
  CHECK_FALSE(has(page, "x\u202f900 to 920"));
}

TEST_CASE("a flux that is still changing shall be called so") {
  const RunFolder folder;
  folder.write("summary.json", run_with_openings().dump());
  json times = json::array(), rates = json::array(), same = json::array();
  for (int k = 0; k <= 100; ++k) {
    times.push_back(0.01 * k);
    rates.push_back(k > 90 ? 3e-10 : 1e-10);
    same.push_back(1e-10);
  }
  const auto write = [&](const json& y) {
    folder.write("report.json", json{{"curves",
                                      {{{"sensor", "dust_out_left"},
                                        {"title", "Flux"},
                                        {"x_label", "time [s]"},
                                        {"y_label", "net mass rate [kg/s]"},
                                        {"series", "all"},
                                        {"x", times},
                                        {"y", y}}}}}
                                    .dump());
  };
  write(rates);
  CHECK(has(first_screen(folder), "brought 3 times the first"));
  write(same);
  CHECK_FALSE(has(first_screen(folder), "Still changing"));
}

TEST_CASE("limits of validity that a run went beyond shall be counted") {
  const RunFolder folder;
  json summary = run_with_openings();
  summary["health"] = {{"largest_diameter_over_spacing", 0.49},
                       {"smallest_void_fraction", 0.3},
                       {"contacts_seen_late", 2},
                       {"largest_overlap_over_radius", 0.01}};
  folder.write("summary.json", summary.dump());
  CHECK(has(first_screen(folder), "2 limits of validity touched"));
  const std::string page = folder.read("report.html");
  CHECK(has(page, "Contacts between grains that began unseen"));
  summary["health"] = {{"largest_diameter_over_spacing", 0.5}, {"contacts_seen_late", 0}};
  folder.write("summary.json", summary.dump());
  CHECK(has(first_screen(folder), "No limit of validity touched"));
}

TEST_CASE("overlaps of coarse and of fine grains shall be told apart") {
  const RunFolder folder;
  json summary = run_with_openings();
  summary["health"] = {{"largest_overlap_over_radius", 0.02},
                       {"largest_overlap_over_radius_coarse", 0.02},
                       {"largest_overlap_over_radius_fine", 0.0}};
  folder.write("summary.json", summary.dump());
  CHECK(has(first_screen(folder), "No limit of validity touched"));
  CHECK_FALSE(has(folder.read("report.html"), "smaller radius, fine grains"));
  summary["health"]["largest_overlap_over_radius_fine"] = 1.4;
  folder.write("summary.json", summary.dump());
  CHECK(has(first_screen(folder), "1 limit of validity touched"));
  const std::string page = folder.read("report.html");
  CHECK(has(page, "smaller radius, fine grains"));
  CHECK(has(page, "What an overlap of 1.4 radii means."));
  CHECK(has(page, "What it does to the dust figures:"));
}

TEST_CASE("dust that was thrown shall be counted by what is faster than its carriers") {
  const RunFolder folder;
  folder.write("summary.json", run_with_openings().dump());
  folder.write_tracks(
      {{{1, 500e-6, 0.1, 0.2, 2.0}, {2, 10e-6, 0.1, 0.2, 2.3}},
       {{1, 500e-6, 0.3, 0.2, 1.0}, {2, 10e-6, 0.3, 0.2, 9.0}, {3, 10e-6, 0.9, 0.9, 0.0}}});
  const dust::io::H5Source source(folder.path() / "results.h5");
  // 1.2 times the fastest coarse grain, 2 m/s; with faster air 1.2 times that.
  const auto without_air = dust::io::fast_dust_of(source, 0.0);
  CHECK(without_air.limit == doctest::Approx(2.4));
  CHECK(without_air.fast == 1);
  CHECK(without_air.all == 3);
  CHECK(dust::io::fast_dust_of(source, 8.0).fast == 0);
  // Stokes: 10 m/s for 2650 (10 um)^2 / (18 x 1.8e-5) s are 8.18 mm.
  const std::string text = dust::io::crushed_dust_html(1.4, without_air, 10e-6, 2650.0, 1.8e-5);
  CHECK(has(text, "within 8.179\u202f"));
  CHECK(has(text, "1 of 3 dust grains"));
}

TEST_CASE("a run without dust shall have no questions about it") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["sensors"] = json::object();
  folder.write("summary.json", summary.dump());
  const std::string screen = first_screen(folder);
  CHECK_FALSE(has(screen, "How much dust?"));
  CHECK_FALSE(has(screen, "Where to extract?"));
  CHECK(has(screen, "grains were released"));
}

TEST_CASE("published numbers shall stand beside those of the run") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["references"] = {{{"quantity", "sensors.slope.mean_angle"},
                            {"unit", "deg"},
                            {"ours", 41.0},
                            {"our_uncertainty", 0.3},
                            {"value", 40.0},
                            {"uncertainty", 0.4},
                            {"source", "a <table>"}}};
  folder.write("summary.json", summary.dump());
  dust::io::write_report(folder.path());
  const std::string page = folder.read("report.html");
  CHECK(has(page, "Beside published numbers"));
  CHECK(has(page, "slope / mean angle"));
  CHECK(has(page, "2.5\u202f%"));
  CHECK(has(page, "<td class=\"n\">2</td>"));  // 1 deg over 0.5 deg
  CHECK(has(page, "a &lt;table&gt;"));
  // And first of all.
  const std::string screen = first_screen(folder);
  CHECK(has(screen, "Slope mean angle"));
  CHECK(has(screen, "published 40.00\u00a0\u00b1\u00a00.40"));
  // Without dust it is the headline.
  summary["sensors"] = json::object();
  folder.write("summary.json", summary.dump());
  const std::string told = first_screen(folder);
  CHECK(has(told, "<p class=\"lede\">Slope mean angle <strong>41.00\u00a0\u00b1\u00a00.30"));
  CHECK(has(told, "published are 40.00\u00a0\u00b1\u00a00.40"));
  CHECK_FALSE(has(told, "grains were released in"));
}
