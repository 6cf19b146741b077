// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "study/hoods/hood_results.hpp"
#include "study/hoods/hood_site.hpp"
#include "study/hoods/hood_study.hpp"
#include "study/hoods/ranked_places.hpp"
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace dust;
using sdk::Vec3;

namespace {

constexpr double k_cell = 5e-3;  // m

/// 200 x 10 x 100 mm in cells of 5 mm.
const report::FluidGrid k_grid{{0, 0, 0}, {k_cell, k_cell, k_cell}, {40, 2, 20}};

/// Marks the cells of a box of whole cells.
void take(std::vector<char>& taken, std::array<int, 3> low, std::array<int, 3> high) {
  for (int k = low[2]; k < high[2]; ++k) {
    for (int j = low[1]; j < high[1]; ++j) {
      for (int i = low[0]; i < high[0]; ++i) {
        taken[static_cast<std::size_t>(i + 40 * (j + 2 * k))] = 1;
      }
    }
  }
}

study::HoodTrial trial(double flow, double drawn, double escaping) {
  return {.flow = flow, .drawn = {drawn, 0.1 * drawn}, .escaping = {escaping, 0.2 * escaping}};
}

/// A point of a study: 1 kg/s of load and a dust field, of which 1 mg/s leaves by a side; each hood
/// draws out so many mg/s, of the field.
struct DrawingHood {
  std::string name;
  double rate;
};
void write_point(const std::filesystem::path& folder, const std::string& bodies,
                 const std::vector<DrawingHood>& hoods) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "scenario.yaml") << bodies;
  std::ofstream summary(folder / "summary.json");
  summary << R"({"status": "finished"})";
  std::ofstream series(folder / "series.csv");
  series << "time [s],mass_emitted [kg]";
  for (const DrawingHood& hood : hoods) {
    series << ",hoods/" << hood.name << "/dust [kg],hoods/" << hood.name << "/field_dust [kg]";
  }
  series << ",dust_field/10_um/left [kg],dust_field/10_um/hoods [kg]\n";
  for (int row = 0; row <= 60; ++row) {
    const double time = 0.05 * row;
    series << time << ',' << time;
    double drawn = 0.0;
    for (const DrawingHood& hood : hoods) {
      const double mass = 1e-6 * hood.rate * time;
      series << ',' << mass << ',' << mass;
      drawn += mass;
    }
    series << ',' << 1e-6 * time << ',' << drawn << '\n';
  }
}

/// A finished study of a plant that has a hood of its own.
void write_study(const std::filesystem::path& folder) {
  write_point(folder / "points" / "p", "bodies: {hood: {shape: box}}\n", {{"hood", 3.0}});
  write_point(folder / "points" / "h",
              "bodies:\n  hood: {shape: box}\n  suggested_hood: {shape: box, group: place_1, "
              "suction: {flow: 60 l/min}}\n",
              {{"hood", 2.0}, {"suggested_hood", 0.25}});
  std::ofstream(folder / "study.csv") << "point,case,status,hash\n1,plain,finished,p\n"
                                         "2,place_1_at_60_l_min,finished,h\n";
}

}  // namespace

TEST_CASE("a hood shall stand at its place, span a narrow domain and open towards the dust") {
  const std::vector<char> taken(40 * 2 * 20, 0);
  // Dust on the right of the place.
  const study::HoodScene scene(k_grid, taken, {{{0.13, 5e-3, 0.05}, 1e-9}}, {});
  const auto site = study::site_at({1, {0.1, 5e-3, 0.05}, 0.4}, 0.02, scene);
  REQUIRE(site.has_value());
  CHECK(site->moved == 0.0);
  CHECK(site->axis == 0);
  // Spanned along y; the duct lies on the left of its opening.
  CHECK(site->opening_min.x == test::approx(0.1));
  CHECK(site->opening_max.x == test::approx(0.1));
  CHECK(site->opening_min.z == test::approx(0.04));
  CHECK(site->opening_max.z == test::approx(0.06));
  CHECK(site->body_min.x == test::approx(0.09));
  CHECK(site->body_max.x == test::approx(0.1));
  // The opening ends at the sides; the duct reaches beyond them by half an opening.
  CHECK(site->opening_min.y == 0.0);
  CHECK(site->opening_max.y == test::approx(0.01));
  CHECK(site->body_min.y == test::approx(-0.01));
  CHECK(site->body_max.y == test::approx(0.02));
  CHECK(site->area() == test::approx(0.02 * 0.01));
  // With the dust above, the opening looks up.
  const study::HoodScene above(k_grid, taken, {{{0.1, 5e-3, 0.08}, 1e-9}}, {});
  const auto up = study::site_at({1, {0.1, 5e-3, 0.05}, 0.4}, 0.02, above);
  REQUIRE(up.has_value());
  CHECK(up->axis == 2);
  CHECK(up->body_max.z == test::approx(0.05));
}

TEST_CASE("a hood shall be moved clear of bodies and the stream, or be left out") {
  std::vector<char> taken(40 * 2 * 20, 0);
  take(taken, {0, 0, 0}, {40, 2, 8});  // a bed up to z = 40 mm
  const study::LowPressurePlace place{2, {0.1, 5e-3, 0.0475}, 0.4};
  const study::HoodScene scene(k_grid, taken, {}, {});
  const auto site = study::site_at(place, 0.02, scene);
  REQUIRE(site.has_value());
  CHECK(site->place == 2);
  CHECK(site->moved > 0.0);
  // A cell stays clear beside the duct, two before its opening.
  CHECK(site->body_min.z > 0.045 - 1e-9);
  // Too wide for what is left between bed and lid.
  CHECK_FALSE(study::site_at(place, 0.07, scene).has_value());
  // A coarse grain that lies there at the end has to be avoided as well, dust has not.
  const Vec3 middle = 0.5 * (site->body_min + site->body_max);
  const study::HoodScene with_grain(k_grid, taken, {}, {{middle, 1e-3}});
  const auto other = study::site_at(place, 0.02, with_grain);
  REQUIRE(other.has_value());
  CHECK_FALSE(with_grain.is_clear(site->body_min, site->body_max));
  CHECK(with_grain.is_clear(other->body_min, other->body_max));
  const study::HoodScene with_dust(k_grid, taken, {{middle, 1e-12}}, {});
  CHECK(with_dust.is_clear(site->body_min, site->body_max));
}

TEST_CASE("a hood shall keep a grain's diameter from periodic sides, or span what lies between") {
  // 200 x 50 x 100 mm.
  const report::FluidGrid grid{{0, 0, 0}, {k_cell, k_cell, k_cell}, {40, 10, 20}};
  const std::vector<char> taken(40 * 10 * 20, 0);
  study::HoodScene scene(grid, taken, {}, {});
  const study::LowPressurePlace at_side{1, {0.1, 0.011, 0.05}, 0.4};
  const auto beside = study::site_at(at_side, 0.02, scene);
  REQUIRE(beside.has_value());
  CHECK(beside->body_min.y == test::approx(0.001));
  // Grains of 8 mm pass front and back.
  scene.set_periodic_clearance({0.0, 0.008, 0.0});
  const auto moved = study::site_at(at_side, 0.02, scene);
  REQUIRE(moved.has_value());
  CHECK(moved->body_min.y >= 0.008);
  CHECK(moved->body_max.y <= 0.042);
  // Of 22 mm: no duct is so far from both. It reaches as far beyond them instead.
  scene.set_periodic_clearance({0.0, 0.022, 0.0});
  const auto spanning = study::site_at(at_side, 0.02, scene);
  REQUIRE(spanning.has_value());
  CHECK(spanning->opening_min.y == 0.0);
  CHECK(spanning->opening_max.y == test::approx(0.05));
  CHECK(spanning->body_min.y == test::approx(-0.022));
  CHECK(spanning->body_max.y == test::approx(0.072));
  CHECK(spanning->axis != 1);
}

TEST_CASE("two places that are moved to one site shall have one hood, and the other be named") {
  std::vector<char> taken(40 * 2 * 20, 0);
  take(taken, {0, 0, 0}, {40, 2, 8});  // a bed up to z = 40 mm
  const study::HoodScene scene(k_grid, taken, {}, {});
  // Both are too near to the bed and moved up; the third has a site of its own.
  const std::vector<study::LowPressurePlace> places = {
      {1, {0.1, 5e-3, 0.0475}, 0.4}, {2, {0.1, 5e-3, 0.0525}, 0.3}, {3, {0.15, 5e-3, 0.07}, 0.2}};
  const study::HoodSites found = study::sites_at(places, 3, 0.02, scene);
  REQUIRE(found.sites.size() == 2);
  CHECK(found.sites[0].place == 1);
  CHECK(found.sites[1].place == 3);
  REQUIRE(found.shared.size() == 1);
  CHECK(found.shared[0].place == 2);
  CHECK(found.shared[0].with == 1);
  CHECK(found.without_room.empty());
  // As many as are asked for, those left out not counted.
  CHECK(study::sites_at(places, 1, 0.02, scene).sites.size() == 1);
  CHECK(study::sites_at(places, 2, 0.02, scene).sites.back().place == 3);
}

TEST_CASE(
    "places shall be ranked by the dust round them, and left out where a hood draws already") {
  const std::vector<char> taken(40 * 2 * 20, 0);
  // The deepest lies at the intake, the next in clean air, the shallowest in the cloud.
  const std::vector<study::LowPressurePlace> places = {
      {1, {0.19, 5e-3, 0.05}, 5.0}, {2, {0.05, 5e-3, 0.05}, 0.4}, {3, {0.1, 5e-3, 0.05}, 0.1}};
  // A cloud of 4 ug within an opening of the third place, a wisp beside the second.
  const study::HoodScene scene(k_grid, taken,
                               {{{0.11, 5e-3, 0.06}, 4e-9}, {{0.045, 5e-3, 0.04}, 1e-12}}, {});
  const std::vector<study::ExistingHood> hoods = {{"right", {0.2, 0.0, 0.03}, {0.2, 0.01, 0.07}}};
  const auto ranked = study::ranked_places(places, hoods, 0.02, scene);
  REQUIRE(ranked.places.size() == 2);
  CHECK(ranked.places[0].number == 3);
  CHECK(ranked.places[1].number == 2);
  // A box of 40 x 10 x 40 mm.
  CHECK(ranked.places[0].dust_near == test::approx(4e-9 / 16e-6));
  REQUIRE(ranked.reached.size() == 1);
  CHECK(ranked.reached[0].place == 1);
  CHECK(ranked.reached[0].hood == "right");
  CHECK(study::sites_at(ranked.places, 1, 0.02, scene).sites.front().place == 3);
  // Without dust and hoods the deepest comes first.
  const study::HoodScene clean(k_grid, taken, {}, {});
  CHECK(study::ranked_places(places, {}, 0.02, clean).places.front().number == 1);
}

TEST_CASE("a hood shall reach as far as its opening is wide, whatever its frame") {
  // 100 x 400 mm, flat: the root of its area is 200 mm.
  study::ExistingHood hood{"hood", {0.0, 0.0, 1.0}, {0.1, 0.4, 1.0}};
  CHECK(study::is_within_reach({0.05, 0.2, 1.19}, hood));
  CHECK_FALSE(study::is_within_reach({0.05, 0.2, 1.21}, hood));
  CHECK(study::is_within_reach({0.05, 0.55, 1.0}, hood));
  CHECK_FALSE(study::is_within_reach({0.25, 0.55, 1.0}, hood));
  // Turned by a right angle about y: z becomes x.
  hood.frame = scenario::FrameSpec{"turned", {}, {0, 1, 0}, 0.5 * std::numbers::pi};
  CHECK(study::is_within_reach({1.19, 0.2, -0.05}, hood));
  CHECK_FALSE(study::is_within_reach({0.05, 0.2, 1.19}, hood));
}

TEST_CASE("all flows of a table shall have one unit, that of the largest") {
  study::HoodResults results;
  results.places.push_back({"place_1", {trial(20.0 / 3600.0, 1.0, 1.0)}});
  CHECK(study::hood_table(results, 0.9).find("333 l/min") != std::string::npos);
  results.places.push_back({"place_2", {trial(100.0 / 3600.0, 1.0, 1.0)}});
  const std::string text = study::hood_table(results, 0.9);
  INFO(text);
  CHECK(text.find("20 m3/h") != std::string::npos);
  CHECK(text.find("100 m3/h") != std::string::npos);
  CHECK(text.find("l/min") == std::string::npos);
  for (const double area : {2e-4, 1e-2, 1.0}) {
    const auto flows = study::usual_flows(area);
    const auto unit = [](const std::string& flow) { return flow.substr(flow.find(' ')); };
    for (const study::HoodFlow& flow : flows) CHECK(unit(flow.text) == unit(flows[0].text));
  }
}

TEST_CASE("flows shall be read with a unit that holds for all, and wrong ones be refused") {
  const auto flows = study::flows_of("120, 20, 60 l/min");
  REQUIRE(flows.size() == 3);
  CHECK(flows[0].text == "20 l/min");
  CHECK(flows[2].value == test::approx(2e-3));
  CHECK(study::flows_of("1 m3/h, 60 l/min")[0].text == "1 m3/h");
  const auto message = [](const std::string& text) {
    try {
      static_cast<void>(study::flows_of(text));
    } catch (const base::UserError& error) {
      return error.lines().front();
    }
    return std::string();
  };
  CHECK(message("20, 60 mm").find("--flows: 'mm' is the unit of a length") != std::string::npos);
  CHECK(message("20, , 60 l/min").find("--flows: ") != std::string::npos);
  CHECK(message("0, 60 l/min").find("above 0 is expected") != std::string::npos);
  // Bare numbers would be of m3/s: 100 of these nobody draws.
  CHECK(message("100").ends_with("--flows: 100: give a unit, e.g. 100 m3/h"));
  CHECK(message("20, 60").ends_with("give a unit, e.g. 20, 60 m3/h"));
  CHECK(message("20 l/min, 60").find("give a unit") != std::string::npos);
  // 2 cm2: 0.5 m/s is 6 l/min; 1 m2: 1800 m3/h.
  CHECK(study::usual_flows(2e-4).front().text == "6 l/min");
  CHECK(study::usual_flows(1.0).front().text == "1800 m3/h");
  CHECK(study::usual_flows(1.0).back().text == "14000 m3/h");
}

TEST_CASE("capture shall be what is drawn over all that gets loose, with the errors of both") {
  const auto capture = trial(1.0, 3.0, 1.0).capture();
  REQUIRE(capture.has_value());
  CHECK(capture->value == test::approx(0.75));
  // c = d / (d + e): by differences of both, as if of independent counts.
  const auto share = [](double d, double e) { return d / (d + e); };
  const double h = 1e-6;
  const double of_drawn = 0.3 * (share(3.0 + h, 1.0) - share(3.0 - h, 1.0)) / (2.0 * h);
  const double of_escaping = 0.2 * (share(3.0, 1.0 + h) - share(3.0, 1.0 - h)) / (2.0 * h);
  CHECK(capture->error == test::approx(std::hypot(of_drawn, of_escaping)).epsilon(1e-6));
  CHECK_FALSE(trial(1.0, 0.0, 0.0).capture().has_value());
}

TEST_CASE("capture shall have no error where one of its rates has none") {
  study::HoodTrial unsettled = trial(1.0, 3.0, 1.0);
  unsettled.drawn.error = -1.0;
  CHECK(unsettled.capture()->value == test::approx(0.75));
  CHECK(unsettled.capture()->error < 0.0);
  unsettled = trial(1.0, 3.0, 1.0);
  unsettled.escaping.error = -1.0;
  CHECK(unsettled.capture()->error < 0.0);
  // Of what is not there nothing has to settle.
  unsettled.escaping.value = 0.0;
  CHECK(unsettled.capture()->error == 0.0);
}

TEST_CASE("replicas shall be known to their scatter, and no better than each by itself") {
  std::vector<study::HoodTrial> trials;
  for (const double drawn : {3.0, 4.0, 5.0}) {
    trials.push_back({.flow = 1.0, .drawn = {drawn, 0.1}, .escaping = {1.0, 0.02}, .load = 2.0});
  }
  const study::HoodTrial mean = study::mean_of(trials);
  CHECK(mean.replicas == 3);
  CHECK(mean.load == test::approx(2.0));
  CHECK(mean.drawn.value == test::approx(4.0));
  // Deviations of -1, 0 and 1: s = 1.
  CHECK(mean.drawn.error == test::approx(1.0 / std::sqrt(3.0)));
  // They escape at one rate: none knows it better than to 0.02.
  CHECK(mean.escaping.error == test::approx(0.02));
  const double a = 3.0 / 4.0, b = 4.0 / 5.0, c = 5.0 / 6.0, m = (a + b + c) / 3.0;
  const double squares = (a - m) * (a - m) + (b - m) * (b - m) + (c - m) * (c - m);
  CHECK(mean.capture()->value == test::approx(0.8));
  CHECK(mean.capture()->error == test::approx(std::sqrt(squares / 6.0)));
  // Two alone scatter by chance: their own errors count.
  CHECK(study::mean_of(std::span(trials).first(2)).drawn.error == test::approx(0.1));
  trials[1].drawn.error = -1.0;
  CHECK(study::mean_of(trials).drawn.error < 0.0);
  CHECK(study::mean_of(trials).capture()->error < 0.0);
}

TEST_CASE("the flow needed shall lie between two trials, be a bound, or not be reached") {
  const study::HoodPlace place{
      "place_1", {trial(1e-3, 1.0, 3.0), trial(2e-3, 3.0, 1.0), trial(4e-3, 9.0, 1.0)}};
  const auto half = study::needed_flow(place, 0.5);
  REQUIRE(half.has_value());
  CHECK(half->flow == test::approx(1.5e-3));
  CHECK_FALSE(half->is_bound);
  const auto little = study::needed_flow(place, 0.2);
  REQUIRE(little.has_value());
  CHECK(little->flow == test::approx(1e-3));
  CHECK(little->is_bound);
  CHECK_FALSE(study::needed_flow(place, 0.95).has_value());
  // A flow at which nothing was seen tells nothing.
  study::HoodPlace gap = place;
  gap.trials[1] = trial(2e-3, 0.0, 0.0);
  CHECK(study::needed_flow(gap, 0.5)->flow == test::approx(1e-3 + 3e-3 * 0.25 / 0.65));
}

TEST_CASE("a hood that stands there anyway shall count in the capture, in a column of its own") {
  const test::TemporaryFolder folder;
  write_study(folder / "study");
  const study::HoodResults results = study::hood_results(folder / "study");
  REQUIRE(results.places.size() == 1);
  const study::HoodTrial& tried = results.places[0].trials.at(0);
  CHECK(tried.drawn.value == test::approx(0.25e-6).epsilon(1e-5));
  CHECK(tried.drawn_by_others.value == test::approx(2e-6).epsilon(1e-5));
  CHECK(tried.capture()->value == test::approx(2.25 / 3.25).epsilon(1e-5));
  // The plain run has a hood of its own: 3 mg/s of 1 kg/s, and 1 mg/s leaves. One more is of no use
  // here, which a capture of its own would not show.
  REQUIRE(results.plain.has_value());
  CHECK(results.plain->drawn.value == 0.0);
  CHECK(results.plain->drawn_by_others.value == test::approx(3e-6).epsilon(1e-5));
  CHECK(results.plain->capture()->value == test::approx(0.75).epsilon(1e-5));
  const std::string text = study::hood_table(results, 0.9);
  INFO(text);
  CHECK(text.find("by other hoods [g/t]") != std::string::npos);
  CHECK(text.find("plain    -         -                3") != std::string::npos);
  const auto json = study::hoods_json(results);
  CHECK(json["has_others"] == true);
  CHECK(json["plain"]["drawn_by_others"]["value"].get<double>() == test::approx(3.0).epsilon(1e-5));
}

TEST_CASE("the page of a study of hoods shall get the answer: where, and from which flow on") {
  study::HoodResults results;
  results.places.push_back({"place_1",
                            {trial(1e-3, 1.0, 1.0), trial(2e-3, 9.5, 0.5)},
                            dust::sdk::Vec3{0.1, 0.005, 0.02}});
  results.places.push_back({"place_2", {trial(1e-3, 1.0, 3.0)}});
  const auto json = study::hoods_json(results);
  CHECK(json["wanted"] == 0.9);
  // From a half to 0.95: 8/9 of the way.
  CHECK(json["places"][0]["needed"]["flow_m3_per_s"].get<double>() ==
        test::approx(1e-3 + 1e-3 * 0.4 / 0.45));
  CHECK(json["places"][0]["opening"][0] == 0.1);
  CHECK(json["places"][1]["needed"].is_null());
  CHECK(json["places"][1]["opening"].is_null());
}

TEST_CASE("the table shall say what few grains tell, and where the capture is not reached") {
  study::HoodResults results;
  results.plain = {.escaping = {2e-9, 1e-9}, .load = 1e-3, .computed = 0.0};
  study::HoodTrial few = trial(1e-3, 1e-9, 1e-9);
  few.load = 1e-3;
  few.computed = 7.0;
  study::HoodTrial many = trial(2e-3, 3e-9, 1e-9);
  many.load = 1e-3;
  many.computed = 900.0;
  results.places.push_back({"place_1", {few, many}});
  const std::string text = study::hood_table(results, 0.9);
  INFO(text);
  CHECK(text.find("plain") != std::string::npos);
  CHECK(text.find("2.0 ± 1.0") != std::string::npos);  // g/t: 2e-9 of 1e-3 kg/s
  CHECK(text.find("50 % (by 7 grains)") != std::string::npos);
  CHECK(text.find("75.0 ± 4.2 %") != std::string::npos);
  CHECK(text.find("place_1: not reached (at most 75.0 ± 4.2 %, at 120 l/min)") !=
        std::string::npos);
  CHECK(study::hood_table(results, 0.6).find("place_1: 84 l/min") != std::string::npos);
  results.places[0].trials[1].flow = 60.0 / 3600.0;
  CHECK(study::hood_table(results, 0.9).find("at 60 m3/h)") != std::string::npos);
}

TEST_CASE("what escapes as grains shall count also where the feed has ended") {
  const test::TemporaryFolder folder;
  const auto study = folder / "study";
  const auto point = study / "points" / "h";
  std::filesystem::create_directories(point);
  std::ofstream(point / "scenario.yaml")
      << "bodies:\n  suggested_hood: {shape: box, group: place_1, suction: {flow: 60 l/min}}\n"
         "dust: {finer_than: 100 um}\n";
  // 8 mg/s through the opening; per tonne there is nothing.
  const std::string role =
      R"("role": "opening", "direction": "net", "diameters_m": [1e-05, 1e-05])";
  std::ofstream(point / "summary.json")
      << R"({"status": "finished", "sensors": {"mouth": {)"
      << R"("class_10_um/net/grams_per_tonne": {"value": null, "unit": "g/t", "uncertainty": null, )"
      << R"("no_error": "feed not even", "quantity": "mass_per_load", )" << role << "}, "
      << R"("class_10_um/net/mass_rate": {"value": 8e-6, "unit": "kg/s", "uncertainty": 4e-7, )"
      << R"("quantity": "mass_rate", )" << role << "}}}}";
  std::ofstream series(point / "series.csv");
  series << "time [s],mass_emitted [kg],hoods/suggested_hood/dust [kg]\n";
  for (int row = 0; row <= 60; ++row) {
    series << 0.05 * row << ",1," << 2e-6 * 0.05 * row << '\n';
  }
  series.close();
  std::ofstream(study / "study.csv")
      << "point,case,status,hash\n1,place_1_at_60_l_min,finished,h\n";
  const study::HoodResults results = study::hood_results(study);
  REQUIRE(results.places.size() == 1);
  const study::HoodTrial& tried = results.places[0].trials.at(0);
  CHECK(tried.escaping.value == test::approx(8e-6).epsilon(1e-9));
  CHECK(tried.capture()->value == test::approx(0.2).epsilon(1e-5));
}
