// SPDX-License-Identifier: Apache-2.0
#include "report/dust_sizes.hpp"
#include "fake_run.hpp"
#include "report/report.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

using dust::report::DustSizes;
using dust::test::approx;
using nlohmann::json;

TEST_CASE("without a rule of the run dust shall be what is finer than 100 um") {
  for (const DustSizes& sizes : {DustSizes(), DustSizes(json::object()), DustSizes(json(7))}) {
    CHECK(sizes.limit() == 100e-6);
    CHECK(sizes.is_dust(99e-6));
    CHECK_FALSE(sizes.is_dust(100e-6));
  }
}

TEST_CASE("dust shall be judged by the rule that the run wrote") {
  const DustSizes finer(json{{"finer_than_m", 500e-6}, {"classes_m", json::array()}});
  CHECK(finer.limit() == 500e-6);
  CHECK(finer.is_dust(300e-6));
  // Grains of 200 um that stand for some of 50 um, beside others of 80 um that are what they are.
  const DustSizes graining(
      json{{"finer_than_m", 60e-6},
           {"size_classes",
            {{{"diameter_m", 200e-6}, {"represented_diameter_m", 50e-6}, {"is_dust", true}},
             {{"diameter_m", 80e-6}, {"represented_diameter_m", 80e-6}, {"is_dust", false}}}}});
  CHECK(graining.is_dust(200e-6));
  CHECK(graining.is_dust(static_cast<double>(200e-6F)));
  CHECK_FALSE(graining.is_dust(80e-6));
  // Sizes that are named, without a limit.
  const DustSizes named(json{{"classes_m", {20e-6, 40e-6}},
                             {"size_classes",
                              {{{"diameter_m", 20e-6}, {"is_dust", true}},
                               {{"diameter_m", 40e-6}, {"is_dust", true}},
                               {{"diameter_m", 3e-3}, {"is_dust", false}}}}});
  CHECK(named.limit() == 3e-3);
  CHECK(named.is_dust(40e-6));
  CHECK_FALSE(named.is_dust(30e-6));
}

TEST_CASE("pictures and headline shall call dust what the scenario calls so") {
  const dust::test::RunFolder folder;
  json summary = dust::test::fake_summary();
  summary["size_classes"] = {{{"diameter_m", 500e-6}, {"mass_kg", {{"emitted", 1.0}}}},
                             {{"diameter_m", 5e-3}, {"mass_kg", {{"emitted", 3.0}}}}};
  folder.write("summary.json", summary.dump());
  folder.write("scenario.yaml", "domain: {min: [0, 0, 0], max: [1, 1, 1]}\n");
  folder.write_tracks({{{.id = 1, .diameter = 500e-6, .x = 0.5, .z = 0.5, .y = 0.5},
                        {.id = 2, .diameter = 5e-3, .x = 0.4, .z = 0.5, .y = 0.5}}});
  const auto document = [&](const json& report) {
    folder.write("report.json", report.dump());
    dust::report::write_report(folder.path());
    return dust::test::page_data(folder.read("report.html"));
  };
  const json usual = document(json::object());
  CHECK(usual["grains"]["frames"][0]["dust"] == 0);
  CHECK(usual["grains"]["is_dust"] == json{false, false});
  const json stated = document({{"dust_rule", {{"finer_than_m", 1e-3}}}});
  CHECK(stated["grains"]["frames"][0]["dust"] == 1);
  CHECK(stated["grains"]["is_dust"] == json{true, false});
  CHECK(stated["grains"]["dust_below"] == 1e-3);
  CHECK(stated["dust"]["limit_m"] == 1e-3);
  CHECK(stated["dust"]["fed"].get<double>() == approx(250000.0));
}
