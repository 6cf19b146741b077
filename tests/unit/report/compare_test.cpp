// SPDX-License-Identifier: Apache-2.0
#include "report/compare.hpp"
#include "base/error.hpp"
#include "fake_run.hpp"
#include "support/approx.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

using dust::report::compare_runs;
using dust::report::comparison_text;
using dust::report::QuantityPair;
using dust::report::scenario_differences;
using dust::test::approx;
using dust::test::fake_summary;
using dust::test::holds;
using dust::test::page_data;
using dust::test::RunFolder;
using nlohmann::json;

namespace {

void fill(const RunFolder& folder, double dust, const std::string& speed) {
  json summary = fake_summary();
  summary["sensors"]["loose_dust"]["liberated"]["value"] = dust;
  folder.write("summary.json", summary.dump());
  folder.write("scenario.yaml", "bodies:\n  belt: {speed: " + speed + ", radius: 0.039}\n");
  folder.write("series.csv", "time [s],kinetic_energy [J]\n0,0\n0.1," + speed + "\n");
  folder.write("report.json", json{{"curves",
                                    {{{"sensor", "lip"},
                                      {"title", "Flux"},
                                      {"x_label", "time [s]"},
                                      {"y_label", "rate [kg/s]"},
                                      {"series", "all"},
                                      {"x", {0, 1}},
                                      {"y", {0, dust}}}}}}
                                  .dump());
  folder.write_h5({});
}

/// A run that has nothing to tell but its summary.
void fill_with(const RunFolder& folder, const json& summary) {
  folder.write("summary.json", summary.dump());
  folder.write("scenario.yaml", "name: run\n");
  folder.write("series.csv", "time [s]\n0\n");
  folder.write("report.json", "{}");
  folder.write_h5({});
}

std::string page_of(const RunFolder& first, const RunFolder& second) {
  const auto target = first.path() / "compare.html";
  write_comparison(compare_runs(first.path(), second.path()), first.path(), second.path(), target);
  return first.read("compare.html");
}

}  // namespace

TEST_CASE("scenarios shall differ by path, lists of plain values as one") {
  const auto list = scenario_differences("a: 1\nb: {c: [1, 2, 3], d: x}\ne: [{f: 1}, {f: 2}]\n",
                                         "a: 1\nb: {c: [1, 2, 4], g: y}\ne: [{f: 1}, {f: 3}]\n");
  REQUIRE(list.size() == 4);
  CHECK(list[0].path == "b.c");
  CHECK(list[0].second == "[1, 2, 4]");
  CHECK(list[1].path == "b.d");
  CHECK(list[1].second.empty());
  CHECK(list[2].path == "b.g");
  CHECK(list[2].first.empty());
  CHECK(list[3].path == "e[1].f");
  CHECK(scenario_differences("a: [", "a: 1").empty());
}

TEST_CASE("a difference shall be told in the errors of both runs") {
  const QuantityPair pair{"s", "q", "m", 1.0, 0.3, 2.0, 0.4};
  CHECK(pair.difference() == 1.0);
  CHECK(pair.in_errors() == approx(2.0));
  CHECK(std::isnan(QuantityPair{"s", "q", "m", 1.0, -1.0, 2.0, -1.0}.in_errors()));
  // What one of them scatters is not known: it may be all of the difference.
  CHECK(std::isnan(QuantityPair{"s", "q", "m", 1.0, -1.0, 2.0, 0.5}.in_errors()));
  CHECK(QuantityPair{"s", "q", "m", 1.0, 0.0, 2.0, 0.5}.in_errors() == approx(2.0));
  CHECK(std::isnan(QuantityPair{"s", "q", "m", 1.0, 0.0, 2.0, 0.0}.in_errors()));
}

TEST_CASE("two runs shall stand side by side in text and on a page") {
  const RunFolder first, second;
  fill(first, 0.0137, "0.8");
  fill(second, 0.0237, "0.4");
  const auto comparison = compare_runs(first.path(), second.path());
  const std::string text = comparison_text(comparison);
  CHECK(holds(text, "bodies.belt.speed: 0.8 | 0.4"));
  CHECK_FALSE(holds(text, "radius"));
  CHECK(holds(text, "+0.01"));
  CHECK(holds(text, "+3.4"));  // 0.01 over sqrt(2) 0.0021
  CHECK(holds(text, "bit for bit"));
  // What is the same to the last bit is of one seed.
  CHECK_FALSE(holds(text, dust::report::k_errors_of_one_run));
  auto of_another_seed = comparison;
  of_another_seed.is_same_state = false;
  CHECK(holds(comparison_text(of_another_seed), dust::report::k_errors_of_one_run));

  const std::string page = page_of(first, second);
  const json data = page_data(page);
  CHECK(data["errors_of_one_run"] == dust::report::k_errors_of_one_run);
  CHECK(data["scenario"][0]["path"] == "bodies.belt.speed");
  CHECK(data["runs"][0]["grains"]["frames"].size() == 3);
  CHECK(data["runs"][1]["air"]["frames"].size() == 3);
  REQUIRE(data["plots"]["curves"].size() == 1);
  CHECK(data["plots"]["curves"][0]["unit"] == "kg/s");
  CHECK(data["plots"]["curves"][0]["lines"][1]["y"][1] == 0.0237);
  CHECK(data["plots"]["series"][0]["title"] == "kinetic_energy");
  CHECK_FALSE(std::regex_search(page, std::regex("(src|href)\\s*=\\s*[\"']?(https?:)?//")));
  CHECK(holds(page, "default-src 'none'"));
}

TEST_CASE("places of low pressure shall be compared where they are, whatever their rank") {
  const auto write = [](const RunFolder& folder, const std::vector<std::array<double, 3>>& places) {
    json summary = fake_summary();
    json sensors = json::object();
    for (std::size_t n = 0; n < places.size(); ++n) {
      const auto entry = [&](double value, const char* unit, const char* quantity) {
        json figure = dust::test::with_role(dust::test::fake_figure(value, unit, -1.0),
                                            "low_pressure", quantity, "", 0.0);
        figure["index"] = n + 1;
        return figure;
      };
      sensors["suction"]["place_" + std::to_string(n + 1)] = {
          {"x", entry(places[n][0], "m", "x")},
          {"z", entry(places[n][1], "m", "z")},
          {"depth", entry(places[n][2], "Pa", "depth_of_pressure")}};
    }
    summary["sensors"] = sensors;
    fill_with(folder, summary);
  };
  const RunFolder first, second;
  write(first, {{0.1, 0.2, 9.0}, {0.5, 0.6, 8.0}});
  // The other one is the deeper now, and a third has come.
  write(second, {{0.51, 0.6, 9.5}, {0.1, 0.21, 8.5}, {0.9, 0.9, 1.0}});
  const auto found = compare_runs(first.path(), second.path());
  const auto pair_of = [&](const std::string& name) {
    const auto at = std::find_if(found.headline.begin(), found.headline.end(),
                                 [&](const QuantityPair& pair) { return pair.name == name; });
    REQUIRE(at != found.headline.end());
    return *at;
  };
  CHECK(pair_of("place 1, x").second == 0.1);
  CHECK(pair_of("place 1, depth").second == 8.5);
  CHECK(pair_of("place 2, x").second == 0.51);
  CHECK(pair_of("place 2, depth").difference() == 1.5);
  CHECK(std::isnan(pair_of("place 3, x").first));
  CHECK(pair_of("place 3, x").second == 0.9);
  // In the terminal, where a place is: a coordinate is no amount that would be more or less.
  const std::string text = comparison_text(found);
  CAPTURE(text);
  CHECK(holds(text, "low pressure: place 1, depth"));
  CHECK_FALSE(holds(text, "low pressure: place 1, x"));
  CHECK(holds(text, "place 2: (500, 600) mm | (510, 600) mm"));
  CHECK(holds(text, "place 3: (none) | (900, 900) mm"));
}

TEST_CASE("a figure without an error shall say why, and less than an atom shall be nothing") {
  const auto write = [](const RunFolder& folder, double value, const char* reason) {
    json summary = fake_summary();
    json figure = dust::test::fake_figure(value, "kg", -1.0);
    figure["no_error"] = reason;
    figure["towards"] = "overview";
    summary["sensors"]["lip"]["lost"] = figure;
    fill_with(folder, summary);
  };
  const RunFolder first, second;
  write(first, 1e-168, "");
  write(second, 0.25, "not steady");
  const std::string text = comparison_text(compare_runs(first.path(), second.path()));
  CAPTURE(text);
  CHECK(holds(text, "0.25 (not steady)"));
  CHECK_FALSE(holds(text, "e-168"));
  const json page = page_data(page_of(first, second));
  const bool has_reason =
      std::any_of(page["headline"].begin(), page["headline"].end(), [](const json& pair) {
        return pair["name"] == "lost" && pair["second_reason"] == "not steady";
      });
  CHECK(has_reason);
}

TEST_CASE("runs that share nothing shall be compared all the same") {
  const RunFolder first, second;
  first.write("summary.json", "{}");
  json summary = fake_summary();
  summary["state_sha256"] = "other";
  second.write("summary.json", summary.dump());
  const auto comparison = compare_runs(first.path(), second.path());
  CHECK_FALSE(comparison.is_same_state);
  CHECK(holds(comparison_text(comparison), "-"));
  CHECK(holds(page_of(first, second), "</html>"));
}

TEST_CASE("names of compared runs shall not become markup") {
  const RunFolder first, second;
  json summary = fake_summary();
  summary["sensors"]["<img src=x>"] = {{"<b>", {{"value", 1.0}, {"unit", "<i>"}}}};
  first.write("summary.json", summary.dump());
  second.write("summary.json", summary.dump());
  first.write("scenario.yaml", "'<script>': 1\n");
  second.write("scenario.yaml", "'<script>': '</script>'\n");
  const std::string page = page_of(first, second);
  CHECK_FALSE(holds(page, "<img"));
  CHECK(page_data(page)["scenario"][0]["path"] == "<script>");
}

TEST_CASE("dust of a field shall be compared: where it goes, what got out, what grains carry") {
  const RunFolder first, second;
  const auto fill_dust = [](const RunFolder& folder, double rate) {
    const auto figure = [](double value, const char* unit) {
      return json{{"value", value}, {"unit", unit}, {"uncertainty", 0.1 * value}};
    };
    json summary = fake_summary();
    summary["dust_rates"] = {{"observed", figure(1.0, "s")},
                             {"left/all/rate", figure(rate, "kg/h")},
                             {"left/all/per_load", figure(10.0 * rate, "g/t")},
                             {"left/back/per_load", figure(8.0 * rate, "g/t")},
                             {"left/back/class/10_um/per_load", figure(rate, "g/t")},
                             {"deposited/belt/per_load", figure(3.0, "g/t")}};
    summary["dust_outflow"] = {{"back", {{"kg_per_h", rate}, {"g_per_tonne", 5.0 * rate}}},
                               {"roof", {{"kg_per_h", 2.0 * rate}}}};
    summary["hoods"] = {{"roof", {{"dust_kg", 1e-3 * rate}}}};
    summary["sensors"]["load"]["mass_flow"] = {{"value", 80.0 * rate},    {"unit", "kg/s"},
                                               {"uncertainty", 3.0},      {"role", "detail"},
                                               {"quantity", "mass_rate"}, {"towards", "overview"}};
    summary["dust_on_grains"] = {
        {"classes", {{"10_um", {{"on_grains_kg", 0.5}, {"set_free_kg", 0.25}}}}},
        {"kept_back_kg", 0.0}};
    folder.write("summary.json", summary.dump());
  };
  fill_dust(first, 1.0);
  fill_dust(second, 2.0);
  const auto comparison = compare_runs(first.path(), second.path());
  const auto find = [](const std::vector<QuantityPair>& list, const std::string& name) {
    for (const QuantityPair& pair : list) {
      if (pair.name == name) return pair;
    }
    return QuantityPair{};
  };
  CHECK(find(comparison.headline, "left, all").second == 20.0);
  CHECK(find(comparison.headline, "left, all").unit == "g/t");
  CHECK(find(comparison.headline, "left, back").in_errors() > 0.0);
  CHECK(find(comparison.headline, "got out, back").unit == "kg/h");
  CHECK(find(comparison.headline, "caught, roof").second == 4.0);
  // What a sensor shows on the first screen compares there, too.
  CHECK(find(comparison.headline, "mass flow").second == 160.0);
  CHECK(find(comparison.headline, "set free, 10 um").first == 0.25);
  CHECK(find(comparison.headline, "deposited, belt").unit.empty());
  CHECK(find(comparison.quantities, "deposited/belt/per_load").first == 3.0);
  CHECK(find(comparison.quantities, "back/g_per_tonne").unit == "g/t");
  CHECK(holds(comparison_text(comparison), "dust rate: left, back"));
}

TEST_CASE("the indices of practice shall be compared, and say why one has no error") {
  const RunFolder first, second;
  const auto fill_indices = [](const RunFolder& folder, double impact) {
    const auto figure = [](double value, const char* unit) {
      return json{{"value", value}, {"unit", unit}, {"uncertainty", 0.1 * value}};
    };
    json summary = fake_summary();
    json air = figure(0.2, "m3/s");
    air["uncertainty"] = nullptr;
    air["no_error"] = "not steady";
    summary["stream_indices"] = {{"observed", figure(1.0, "s")},
                                 {"impact/all/power", figure(30.0 * impact, "W")},
                                 {"impact/all/per_load", figure(impact, "J/kg")},
                                 {"impact/hood/per_load", figure(0.5 * impact, "J/kg")},
                                 {"impact/hood/power", figure(15.0 * impact, "W")},
                                 {"entrained_air/flow", air},
                                 {"entrained_air/height", figure(1.5, "m")},
                                 {"looseness/void_fraction", figure(0.8, "1")}};
    fill_with(folder, summary);
  };
  fill_indices(first, 4.0);
  fill_indices(second, 6.0);
  const auto comparison = compare_runs(first.path(), second.path());
  const std::string text = comparison_text(comparison);
  CAPTURE(text);
  CHECK(holds(text, "index of practice: impact, all, per load"));
  CHECK(holds(text, "index of practice: impact, hood, per load"));
  CHECK(holds(text, "index of practice: looseness, void fraction"));
  CHECK(holds(text, "0.2 (not steady)"));
  CHECK_FALSE(holds(text, "height"));
  CHECK_FALSE(holds(text, "impact, hood, power"));
  const json page = page_data(page_of(first, second));
  const auto has = [&](const char* list, const std::string& name) {
    return std::any_of(page[list].begin(), page[list].end(),
                       [&](const json& pair) { return pair["name"] == name; });
  };
  CHECK(has("headline", "impact, all, per load"));
  CHECK(has("quantities", "entrained_air/height"));
}

TEST_CASE("what counts through the run that a branch started from shall say so") {
  const RunFolder first, second;
  const auto fill_dust = [](const RunFolder& folder, double since) {
    json summary = fake_summary();
    summary["dust_outflow"] = {{"back", {{"kg", 0.5}, {"kg_per_h", 2.0}}}};
    summary["dust_on_grains"] = {
        {"classes", {{"10_um", {{"on_grains_kg", 0.5}, {"set_free_kg", 0.25}}}}}};
    if (since >= 0.0) summary["start_from"] = {{"time_s", 2.0}, {"rates_since_s", since}};
    fill_with(folder, summary);
  };
  const auto names_of = [&] {
    const auto comparison = compare_runs(first.path(), second.path());
    std::vector<std::string> names;
    for (const auto* list : {&comparison.headline, &comparison.quantities}) {
      for (const QuantityPair& pair : *list) names.push_back(pair.name);
    }
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  fill_dust(first, -1.0);
  fill_dust(second, 0.0);  // the same plant since the very beginning
  CHECK(has(names_of(), "set free, 10 um"));
  fill_dust(second, 2.0);
  const auto names = names_of();
  for (const char* sum : {"set free, 10 um", "back/kg", "mass released", "simulated time"}) {
    CAPTURE(sum);
    CHECK_FALSE(has(names, sum));
    CHECK(has(names, std::string(sum) + " since t = 0"));
  }
  CHECK(has(names, "got out, back"));
  CHECK(has(names, "on grains, 10 um"));
  // Results of before, whose rates go on through the branch as well.
  json old = json::parse(second.read("summary.json"));
  old["start_from"] = {{"time_s", 2.0}, {"is_same_scenario", false}};
  fill_with(second, old);
  CHECK(has(names_of(), "got out, back since t = 0"));
  CHECK(has(names_of(), "back/kg_per_h since t = 0"));
}

TEST_CASE("amounts per load shall never be compared with rates") {
  const RunFolder loaded, empty;
  const auto fill_rates = [](const RunFolder& folder, const json& rates) {
    json summary = fake_summary();
    summary["dust_rates"] = rates;
    folder.write("summary.json", summary.dump());
  };
  const auto figure = [](double value, const char* unit) {
    return json{{"value", value}, {"unit", unit}, {"uncertainty", 0.1 * value}};
  };
  fill_rates(loaded, {{"deposited/all/rate", figure(2.0, "kg/h")},
                      {"deposited/all/per_load", figure(8.0494, "g/t")}});
  fill_rates(empty, {{"deposited/all/rate", figure(1.38e-6, "kg/h")}});
  for (const bool is_turned : {false, true}) {
    const auto comparison =
        compare_runs((is_turned ? empty : loaded).path(), (is_turned ? loaded : empty).path());
    const auto of_dust = [](const QuantityPair& pair) { return pair.name == "deposited, all"; };
    const auto& headline = comparison.headline;
    REQUIRE(std::count_if(headline.begin(), headline.end(), of_dust) == 1);
    const auto pair = *std::find_if(headline.begin(), headline.end(), of_dust);
    CHECK(pair.unit == "kg/h");
    CHECK(pair.first == (is_turned ? 1.38e-6 : 2.0));
    CHECK(pair.second == (is_turned ? 2.0 : 1.38e-6));
  }
}

TEST_CASE("a figure that two runs tell in different units shall be told of each by itself") {
  const RunFolder first, second;
  for (const auto& [folder, unit] : {std::pair{&first, "kg"}, std::pair{&second, "kg/s"}}) {
    json summary = fake_summary();
    summary["sensors"]["scale"] = {{"load", {{"value", 3.0}, {"unit", unit}}}};
    folder->write("summary.json", summary.dump());
  }
  const auto pairs = compare_runs(first.path(), second.path()).quantities;
  std::vector<QuantityPair> loads;
  for (const QuantityPair& pair : pairs) {
    if (pair.name == "load") loads.push_back(pair);
  }
  REQUIRE(loads.size() == 2);
  CHECK(loads[0].unit == "kg");
  CHECK(loads[0].first == 3.0);
  CHECK(std::isnan(loads[0].second));
  CHECK(loads[1].unit == "kg/s");
  CHECK(std::isnan(loads[1].first));
  CHECK(loads[1].second == 3.0);
}

TEST_CASE("a run that has not ended shall be told to be one, with how it goes on") {
  const RunFolder first, second;
  first.write("summary.json", "{}");
  second.write("scenario.yaml", "name: a\n");
  const auto message_of = [&] {
    try {
      (void)compare_runs(first.path(), second.path());
    } catch (const dust::base::UserError& error) {
      return error.lines().at(0);
    }
    return std::string();
  };
  const std::string folder = second.path().string();
  CHECK(holds(message_of(), folder + " holds a run that has not ended"));
  CHECK(holds(message_of(), "--force', from the start"));
  second.write("checkpoint.h5", "");
  CHECK(holds(message_of(), "engine run " + folder + "/scenario.yaml -o " + folder + " --resume'"));
}

TEST_CASE("a folder that is no run shall be refused by name") {
  const RunFolder first, second;
  first.write("summary.json", "{}");
  std::string message;
  try {
    (void)compare_runs(first.path(), second.path());
  } catch (const dust::base::UserError& error) {
    message = error.lines().at(0);
  }
  CHECK(holds(message, second.path().string()));
  CHECK(holds(message, "summary.json"));
}
