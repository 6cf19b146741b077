// SPDX-License-Identifier: Apache-2.0
#include "fake_run.hpp"
#include "report/facts/fast_dust.hpp"
#include "report/run_document.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using dust::test::approx;
using dust::test::fake_figure;
using dust::test::fake_summary;
using dust::test::RunFolder;
using dust::test::with_role;
using nlohmann::json;

namespace {

/// Quartz of 10 um: 2650 pi / 6 (10 um)^3 [kg].
constexpr double k_grain = 1.38754e-12;

/// Two openings watched for 0.19 s: 100 and 20 grains a second of 10 um.
json run_with_openings() {
  json summary = fake_summary();
  const auto opening = [](double grams_per_tonne, double error, double rate) {
    const json all = fake_figure(grams_per_tonne, "g/t", error);
    return json{
        {"a", with_role(fake_figure(0.19, "s"), "observed_time", "time")},
        {"b", with_role(all, "opening", "mass_per_load", "net")},
        {"c", with_role(fake_figure(rate, "1/s"), "opening", "number_rate", "forward", 10e-6)},
        {"d",
         with_role(fake_figure(rate * k_grain, "kg/s"), "opening", "mass_rate", "forward", 10e-6)},
        {"e", with_role(all, "opening", "mass_per_load", "net", 10e-6)}};
  };
  const auto place = [](int index, const char* quantity, json figure) {
    figure = with_role(std::move(figure), "low_pressure", quantity);
    figure["index"] = index;
    return figure;
  };
  summary["sensors"] = {{"x", opening(0.5, 0.03, 100.0)},
                        {"top", opening(0.1, 0.04, 20.0)},
                        {"suction",
                         {{"a", place(1, "x", fake_figure(0.9, "m"))},
                          {"b", place(1, "z", fake_figure(0.9, "m"))},
                          {"c", place(1, "depth_of_pressure", fake_figure(0.4, "Pa", 0.01))},
                          {"d", place(2, "x", fake_figure(0.25, "m"))},
                          {"e", place(2, "z", fake_figure(0.75, "m"))},
                          {"f", place(2, "depth_of_pressure", fake_figure(0.3, "Pa", 0.01))}}}};
  summary["size_classes"] = {{{"diameter_m", 10e-6}, {"mass_kg", {{"emitted", 1e-9}}}},
                             {{"diameter_m", 500e-6}, {"mass_kg", {{"emitted", 1e-3 - 1e-9}}}}};
  return summary;
}

/// What the page of the run is made of.
json document_of(const RunFolder& folder) { return dust::report::run_document(folder.path()); }

std::size_t touched(const json& document) {
  const json& limits = document["limits"];
  return static_cast<std::size_t>(std::count_if(
      limits.begin(), limits.end(), [](const json& l) { return l["is_touched"] == true; }));
}

}  // namespace

TEST_CASE("a sensor of any name with the role of an opening shall be in the headline") {
  const RunFolder folder;
  json summary = run_with_openings();
  folder.write("summary.json", summary.dump());
  const json dust = document_of(folder)["dust"];
  CHECK(dust["spoken_of"] == "openings");
  REQUIRE(dust["openings"].size() == 2);
  CHECK(dust["openings"][0]["sensor"] == "x");
  // The same figures without the role of an opening: the name alone says nothing.
  summary["sensors"]["dust_out_left"] = summary["sensors"]["x"];
  summary["sensors"].erase("x");
  summary["sensors"].erase("top");
  for (auto& entry : summary["sensors"]["dust_out_left"]) entry["role"] = "detail";
  folder.write("summary.json", summary.dump());
  CHECK(document_of(folder)["dust"].is_null());
}

TEST_CASE("the first screen shall tell how much, from where, how sure and where to extract") {
  const RunFolder folder;
  folder.write("summary.json", run_with_openings().dump());
  folder.write_h5({});
  const json document = document_of(folder);
  const json& dust = document["dust"];
  // Errors of independent counts add in squares: 0.05 of 0.6 g/t.
  CHECK(dust["headline"]["value"].get<double>() == approx(0.6));
  CHECK(dust["headline"]["uncertainty"].get<double>() == approx(0.05));
  CHECK(dust["openings"][0]["sensor"] == "x");
  CHECK(dust["openings"][1]["sensor"] == "top");
  CHECK(dust["fed"].get<double>() == approx(1.0));
  CHECK(dust["observed_s"].get<double>() == approx(0.19));
  CHECK(dust["counted"].get<double>() == approx(22.8));
  // 16.28 um aerodynamic: 0.5 (1 + exp(-0.9767)) = 68.8 %; of that 1 - F(ln(16.28 / 11.64) /
  // ln 1.5).
  CHECK(dust["fractions"]["inhalable"].get<double>() == approx(0.688).epsilon(1e-3));
  CHECK(dust["fractions"]["thoracic"].get<double>() == approx(0.14).epsilon(0.02));
  REQUIRE(dust["classes"].size() == 1);
  CHECK(dust["classes"][0]["out"]["value"].get<double>() == approx(0.6));
  CHECK(dust["classes"][0]["density"].get<double>() == approx(2650).epsilon(1e-4));
  // The dust of the frames lies at (0.25, 0.75): ring 2, not the deepest.
  const json& extraction = document["extraction"];
  REQUIRE(extraction["places"].size() == 2);
  CHECK(extraction["first"] == 1);
  CHECK(extraction["places"][1]["name"] == "2");
  CHECK(extraction["places"][1]["x"].get<double>() == approx(0.25));
  CHECK(extraction["places"][1]["dust_share"].get<double>() == approx(1.0));
}

TEST_CASE("a place whose pressure is not surely below zero shall not be the one to extract first") {
  const RunFolder folder;
  json summary = run_with_openings();
  folder.write_h5({});
  summary["sensors"]["suction"]["f"]["uncertainty"] = nullptr;
  folder.write("summary.json", summary.dump());
  CHECK(document_of(folder)["extraction"]["first"] == 0);  // the dust is at the other
  summary["sensors"]["suction"]["f"]["uncertainty"] = 0.2;
  folder.write("summary.json", summary.dump());
  CHECK(document_of(folder)["extraction"]["first"] == 0);
}

TEST_CASE("dust near a place shall be near it in depth as well, where the domain is deep") {
  const RunFolder folder;
  json summary = run_with_openings();
  auto& suction = summary["sensors"]["suction"];
  const auto set = [&](const char* name, int index, const char* quantity, double value) {
    suction[name] = with_role(fake_figure(value, "m"), "low_pressure", quantity);
    suction[name]["index"] = index;
  };
  for (const int index : {1, 2}) {
    const std::string n = std::to_string(index);
    set(("x" + n).c_str(), index, "x", 0.5);
    set(("y" + n).c_str(), index, "y", index == 1 ? 0.1 : 0.9);
    set(("z" + n).c_str(), index, "z", 0.5);
  }
  for (const char* name : {"a", "b", "d", "e"}) suction.erase(name);
  folder.write("summary.json", summary.dump());
  folder.write("scenario.yaml", "domain: {min: [0, 0, 0], max: [1, 1, 1]}\n");
  folder.write_tracks({{{1, 10e-6, 0.5, 0.5, 0.0, 0.9}, {2, 500e-6, 0.1, 0.1, 0.0, 0.1}}});
  const json extraction = document_of(folder)["extraction"];
  REQUIRE(extraction["places"].size() == 2);
  CHECK(extraction["places"][0]["dust_share"] == 0.0);
  CHECK(extraction["places"][1]["dust_share"].get<double>() == approx(1.0));
  CHECK(extraction["first"] == 1);
}

TEST_CASE("an amount that rests on few grains or is not steady shall say so instead of an error") {
  const RunFolder folder;
  json summary = run_with_openings();
  for (const char* name : {"b", "e"}) {
    summary["sensors"]["top"][name]["uncertainty"] = nullptr;
    summary["sensors"]["top"][name]["no_error"] = "not steady";
  }
  folder.write("summary.json", summary.dump());
  const json dust = document_of(folder)["dust"];
  CHECK(dust["headline"]["value"].get<double>() == approx(0.6));
  CHECK(dust["headline"]["uncertainty"].is_null());
  CHECK(dust["headline"]["no_error"] == "not steady");
  CHECK(dust["openings"][1]["no_error"] == "not steady");
  CHECK(!dust["openings"][0].contains("no_error"));
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
  const json partings = document_of(folder)["dust"]["partings"];
  REQUIRE(partings.size() == 1);
  CHECK(partings[0]["x"].get<double>() == approx(0.31));
  CHECK(partings[0]["z"].get<double>() == approx(0.21));
  CHECK(partings[0]["share"].get<double>() == approx(1.0));
  // One grain of quartz in the load of 0.25 kg.
  CHECK(partings[0]["amount"]["value"].get<double>() == approx(1e6 * k_grain / 0.25).epsilon(1e-3));
}

TEST_CASE("a flux that is still changing shall be called so") {
  const RunFolder folder;
  json summary = run_with_openings();
  summary["series_roles"] = {
      {"x/net/mass_rate [kg/s]",
       {{"role", "opening"}, {"quantity", "mass_rate"}, {"direction", "net"}}},
      {"inside/net/mass_rate [kg/s]",
       {{"role", "passage"}, {"quantity", "mass_rate"}, {"direction", "net"}}}};
  folder.write("summary.json", summary.dump());
  const auto write = [&](double last_tenth) {
    std::string rows = "time [s],x/net/mass_rate [kg/s],inside/net/mass_rate [kg/s]\n";
    for (int k = 0; k <= 100; ++k) {
      rows +=
          std::to_string(0.01 * k) + (k > 90 ? "," + std::to_string(last_tenth) : ",1") + ",7\n";
    }
    folder.write("series.csv", rows);
  };
  write(3.0);
  CHECK(document_of(folder)["dust"]["later_over_earlier"].get<double>() ==
        approx(3.0).epsilon(0.1));
  write(1.0);
  CHECK(document_of(folder)["dust"]["later_over_earlier"].get<double>() == approx(1.0));
}

TEST_CASE("limits of validity that a run went beyond shall be counted") {
  const RunFolder folder;
  json summary = run_with_openings();
  summary["health"] = {{"largest_diameter_over_spacing", 0.49},
                       {"smallest_void_fraction", 0.3},
                       {"contacts_seen_late", 2},
                       {"largest_overlap_over_radius", 0.01}};
  folder.write("summary.json", summary.dump());
  const json document = document_of(folder);
  CHECK(touched(document) == 2);
  CHECK(document["limits"][0]["key"] == "largest_diameter_over_spacing");
  CHECK(document["limits"][0]["value"] == 0.5);
  summary["health"] = {{"largest_diameter_over_spacing", 0.5}, {"contacts_seen_late", 0}};
  folder.write("summary.json", summary.dump());
  CHECK(touched(document_of(folder)) == 0);
}

TEST_CASE("overlaps of coarse and of fine grains shall be told apart") {
  const RunFolder folder;
  json summary = run_with_openings();
  summary["health"] = {{"largest_overlap_over_radius", 0.02},
                       {"largest_overlap_over_radius_coarse", 0.02},
                       {"largest_overlap_over_radius_fine", 0.0}};
  folder.write("summary.json", summary.dump());
  CHECK(touched(document_of(folder)) == 0);
  CHECK(document_of(folder)["limits"].size() == 1);
  summary["health"]["largest_overlap_over_radius_fine"] = 1.4;
  folder.write("summary.json", summary.dump());
  const json document = document_of(folder);
  CHECK(touched(document) == 1);
  CHECK(document["limits"].back()["key"] == "largest_overlap_over_radius_fine");
  CHECK(document["crushed"]["overlap"] == 1.4);
}

TEST_CASE("dust that was thrown shall be counted by what is faster than its carriers") {
  const RunFolder folder;
  folder.write("summary.json", run_with_openings().dump());
  folder.write_tracks(
      {{{1, 500e-6, 0.1, 0.2, 2.0}, {2, 10e-6, 0.1, 0.2, 2.3}},
       {{1, 500e-6, 0.3, 0.2, 1.0}, {2, 10e-6, 0.3, 0.2, 9.0}, {3, 10e-6, 0.9, 0.9, 0.0}}});
  const dust::report::H5Source source(folder.path() / "results.h5");
  // 1.2 times the fastest coarse grain, 2 m/s; with faster air 1.2 times that.
  const auto without_air = dust::report::fast_dust_of(source, {}, 0.0);
  CHECK(without_air.limit == approx(2.4));
  CHECK(without_air.fast == 1);
  CHECK(without_air.all == 3);
  CHECK(dust::report::fast_dust_of(source, {}, 8.0).fast == 0);
  // Stokes: 10 m/s for 2650 (10 um)^2 / (18 x 1.8e-5) s are 8.18 mm.
  CHECK(dust::report::stopping_distance(10e-6, 2650.0, 1.8e-5) == approx(8.179e-3).epsilon(1e-3));
  CHECK(dust::report::stopping_distance(10e-6, 0.0, 1.8e-5) == 0.0);
}

TEST_CASE("a run without dust shall have no questions about it") {
  const RunFolder folder;
  json summary = fake_summary();
  summary["sensors"] = json::object();
  folder.write("summary.json", summary.dump());
  const json document = document_of(folder);
  CHECK(document["dust"].is_null());
  CHECK(document["extraction"].is_null());
  CHECK(document["summary"]["particles"]["emitted"] == 100);
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
  const json references = document_of(folder)["references"];
  REQUIRE(references.size() == 1);
  CHECK(references[0]["difference_share"].get<double>() == approx(0.025));
  CHECK(references[0]["in_errors"].get<double>() == approx(2.0));  // 1 deg over 0.5 deg
  // Without their error that of the difference is not known.
  summary["references"][0]["uncertainty"] = nullptr;
  folder.write("summary.json", summary.dump());
  CHECK(document_of(folder)["references"][0]["in_errors"].is_null());
}
