// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

using dust::scenario::DustRule;
using dust::scenario::DustSpec;
using dust::test::approx;

namespace {

/// The small scenario with a block behind it, which begins in line 42.
std::string with(const std::string& block) { return k_small + block; }

dust::scenario::DustSetup dust_of(const std::string& text) {
  const Folder folder;
  return read(folder.write("s.yaml", text)).dust;
}

void check(const std::string& block, const std::string& expected) {
  const Folder folder;
  const std::string all = joined(problems(folder.write("s.yaml", with(block))));
  CHECK_MESSAGE(all.find(expected) != std::string::npos, all);
}

}  // namespace

TEST_CASE("a dust block shall say by size and material what is dust") {
  const auto dust = dust_of(with("dust: {finer_than: 400 um, materials: [sand]}\n"));
  REQUIRE(dust.given);
  const DustRule rule = dust.rule();
  CHECK(rule.is_dust(300e-6, 0));
  CHECK_FALSE(rule.is_dust(500e-6, 0));
  CHECK_FALSE(rule.is_dust(300e-6, 1));
}

TEST_CASE("rules of practice shall have the height and area they take, or be refused") {
  const auto dust =
      dust_of(with("dust: {finer_than: 400 um, fall_height: 2 m, open_area: 900 cm2}\n"));
  CHECK(dust.given->fall_height == approx(2.0));
  CHECK(dust.given->open_area == approx(0.09));
  check("dust: {finer_than: 400 um, open_area: 900 cm2}\n",
        "dust.open_area: the rule of induced air takes the height of fall too: give fall_height");
  check("dust: {finer_than: 400 um, fall_height: -1 m}\n", "fall_height");
}

TEST_CASE("without a dust block all below 100 um shall be dust") {
  const DustRule rule = dust_of(k_small).rule();
  CHECK(rule.is_dust(99e-6, 0));
  CHECK_FALSE(rule.is_dust(100e-6, 1));
}

TEST_CASE("grains that stand for smaller ones shall be dust by the size of these") {
  // 300 um for 20 um: dust below 25 um.
  const auto dust =
      dust_of(changed(with("dust: {finer_than: 25 um}\n"), "poisson_ratio: 0.3}\n  glass",
                      "poisson_ratio: 0.3, coarse_graining: 15}\n  glass"));
  const DustRule rule = dust.rule();
  CHECK(rule.represented(300e-6, 0) == approx(20e-6));
  CHECK(rule.is_dust(300e-6, 0));
  CHECK_FALSE(rule.is_dust(500e-6, 0));
  CHECK_FALSE(rule.is_dust(300e-6, 1));
}

TEST_CASE("listed classes alone shall be dust, to the rounding of single precision") {
  DustSpec spec;
  spec.classes = {10e-6, 40e-6};
  const DustRule rule(spec, {1.0});
  CHECK(rule.is_dust(static_cast<double>(10e-6F), 0));
  CHECK_FALSE(rule.is_dust(20e-6, 0));
}

TEST_CASE("a dust block shall be written out so that it reads the same again") {
  const Folder folder;
  const auto first = read(folder.write("s.yaml", with("dust: {classes: [300, 500 um]}\n")));
  const auto again = read(folder.write("t.yaml", first.resolved_yaml));
  CHECK(again.resolved_yaml == first.resolved_yaml);
  REQUIRE(again.dust.given);
  CHECK(again.dust.given->classes == std::vector<double>{3e-4, 5e-4});
}

TEST_CASE("a dust block that says nothing shall be refused") {
  check("dust: {steady_after: 1 ms}\n", "says of no grain that it is dust: give finer_than");
}

TEST_CASE("openings of the dust block shall be refused for the role of a sensor") {
  check("dust: {finer_than: 1 mm, openings: [stream]}\n",
        "dust.openings: had no effect and is gone: what gets out is what sensors with a role say: "
        "give the plane_flux `role: opening`, and take openings out");
  // As a run of before wrote it out; its next does not.
  const Folder folder;
  const auto before =
      read(folder.write("s.yaml", with("dust: {finer_than: 1 mm, openings: []}\n")));
  CHECK(before.resolved_yaml.find("openings") == std::string::npos);
}

TEST_CASE("hoods that are none shall be told with what there is") {
  check("dust: {finer_than: 1 mm, hoods: [top]}\n",
        "dust.hoods[0]: 'top' extracts nothing: a hood is a body with suction, of a flow above 0, "
        "or a side whose air draws out");
  check("dust: {materials: [sans]}\n", "dust.materials[0]: there is no material 'sans'");
}

TEST_CASE("a rule that no grain meets shall be warned of") {
  const Folder folder;
  const auto result = read(folder.write("s.yaml", with("dust: {finer_than: 50 um}\n")));
  CHECK(joined(result.warnings).find("no grain of any emitter is dust by this rule") !=
        std::string::npos);
}

namespace {

const std::string k_field =
    "dust: {field: {classes: [5, 20 um], material: sand, "
    "sources: {nozzle: {min: [1, 1, 1 mm], max: [5, 5, 5 mm], mass_flow: [1, 2 mg/s]}}}}\n";

}  // namespace

TEST_CASE("a dust field shall be read with its sources and written out the same") {
  const Folder folder;
  const auto first = read(folder.write("s.yaml", with(k_field)));
  REQUIRE(first.dust.field);
  CHECK(first.dust.field->diameters == std::vector<double>{5e-6, 20e-6});
  CHECK(first.dust.field->density == 2650.0);
  REQUIRE(first.dust.field->sources.size() == 1);
  CHECK(first.dust.field->sources[0].mass_flow == std::vector<double>{1e-6, 2e-6});
  CHECK(first.dust.rule().limit() == DustRule::k_usual_limit);
  CHECK(read(folder.write("t.yaml", first.resolved_yaml)).resolved_yaml == first.resolved_yaml);
}

TEST_CASE("a dust field that cannot be shall be refused with a remedy") {
  const auto field = [](const std::string& classes, const std::string& flows) {
    return changed(changed(k_field, "[5, 20 um]", classes), "[1, 2 mg/s]", flows);
  };
  check(field("[20, 5 um]", "[1, 2 mg/s]"), "write them ascending, each once");
  check(field("[5, 20 um]", "[1 mg/s]"), "1 numbers for 2 classes; give one for each");
  check(field("[5, 40 um]", "[1, 2 mg/s]"), "is more than a tenth of the smallest grain");
  check(field("[]", "[]"), "dust.field.classes");
  const Folder folder;
  const std::string wet = changed(with(k_field), "fluid:\n",
                                  "fluid:\n  regions: {water: {min: [0, 0, 0], max: [1, 1, 1 mm], "
                                  "density: 1000, viscosity: 1 mPa s}}\n");
  const std::string refusal = joined(problems(folder.write("r.yaml", wet)));
  CHECK_MESSAGE(refusal.find("take fluid.regions or dust.field out") != std::string::npos, refusal);
  std::string text = with(k_field);
  const std::size_t fluid = text.find("fluid:");
  text = text.substr(0, fluid) + "fluid: none\n" + text.substr(text.find("sensors:"));
  const std::string all = joined(problems(folder.write("s.yaml", text)));
  CHECK_MESSAGE(all.find("dust.field: there is no fluid that carries it") != std::string::npos,
                all);
}

TEST_CASE("resuspension and deposition shall be read, and refused where they say nothing") {
  const Folder folder;
  const auto field = [](const std::string& more) {
    return changed(k_field, "material: sand,", "material: sand, " + more + ",");
  };
  const auto first = read(folder.write(
      "s.yaml", with(field("resuspension: true, cohesion: 2e-4 N/m, deposition: lai_nazaroff"))));
  REQUIRE(first.dust.field);
  REQUIRE(first.dust.field->resuspension);
  CHECK(first.dust.field->resuspension->cohesion == 2e-4);
  CHECK(first.dust.field->resuspension->emission_coefficient == 1e-3);
  CHECK(first.dust.field->has_smooth_walls);
  CHECK(read(folder.write("t.yaml", first.resolved_yaml)).resolved_yaml == first.resolved_yaml);
  const std::string text =
      changed(with(field("resuspension: true")), "gravity: [0, 0, -9.81]", "gravity: [0, 0, 0]");
  const std::string all = joined(problems(folder.write("v.yaml", text)));
  CHECK_MESSAGE(all.find("dust.field.resuspension: its threshold is not known without gravity") !=
                    std::string::npos,
                all);
  check(field("cohesion: 2e-4 N/m"),
        "dust.field.cohesion: nothing takes dust off walls: give resuspension: true, or take "
        "cohesion out");
  check(field("deposition: turbulent"), "deposition");
}

TEST_CASE("scavenging shall be read, and refused where no grain could catch dust") {
  const Folder folder;
  const std::string block =
      changed(k_field, "material: sand,", "material: sand, scavenging: true,");
  const auto first = read(folder.write("s.yaml", with(block)));
  REQUIRE(first.dust.field);
  CHECK(first.dust.field->scavenging);
  CHECK(read(folder.write("t.yaml", first.resolved_yaml)).dust.field->scavenging);
  // Where it is not asked for, nothing is written of it.
  const auto without = read(folder.write("u.yaml", with(k_field)));
  CHECK_FALSE(without.dust.field->scavenging);
  CHECK(without.resolved_yaml.find("scavenging") == std::string::npos);
  std::string text = with(block);
  const std::size_t emitters = text.find("emitters:");
  text = text.substr(0, emitters) + text.substr(text.find("fluid:"));
  const std::string all = joined(problems(folder.write("v.yaml", text)));
  CHECK_MESSAGE(all.find("dust.field.scavenging: there are no grains that could catch dust: give "
                         "emitters, or take scavenging out") != std::string::npos,
                all);
}

namespace {

const std::string k_liberation =
    "dust: {field: {classes: [5, 20 um], material: sand}, "
    "liberation: {model: energy, binding_energy: 2 MJ/kg}}\n";

/// The scenario with more in its first material and other dust.
std::string dusty(const std::string& material, const std::string& dust = k_liberation) {
  return changed(with(dust), "sand: {", "sand: {" + material + ", ");
}

void check_text(const std::string& text, const std::string& expected) {
  const Folder folder;
  const std::string all = joined(problems(folder.write("s.yaml", text)));
  CHECK_MESSAGE(all.find(expected) != std::string::npos, all);
}

}  // namespace

TEST_CASE("loads and their law shall be read and written out the same") {
  const Folder folder;
  const auto first =
      read(folder.write("s.yaml", dusty("dust_load: [0.1 %, 0.4 %], moisture: 2 %")));
  REQUIRE(first.dust.liberation);
  CHECK(first.dust.liberation->name == "energy");
  CHECK(first.dust.loads[0].share == std::vector<double>{0.001, 0.004});
  CHECK(first.dust.loads[0].moisture == 0.02);
  CHECK(first.dust.shares_on_grains()[0] == first.dust.loads[0].share);
  CHECK(read(folder.write("t.yaml", first.resolved_yaml)).resolved_yaml == first.resolved_yaml);
  // Runs without dust do not hear of it.
  CHECK(read(folder.write("u.yaml", with(k_field))).resolved_yaml.find("dust_load") ==
        std::string::npos);
}

TEST_CASE("a field that is there but wrong shall not be told to be missing") {
  const auto lines = [](const std::string& from, const std::string& to) {
    const Folder folder;
    const std::string text = changed(dusty("dust_load: [1 %, 1 %]"), from, to);
    return problems(folder.write("s.yaml", text));
  };
  const auto density = lines("density: 2650", "density: -2650");
  REQUIRE_MESSAGE(density.size() == 1, joined(density));
  CHECK(density[0].find("materials.sand.density: -2650 is outside") != std::string::npos);
  const auto material = lines("20 um], material: sand", "20 um], material: sandy");
  REQUIRE_MESSAGE(material.size() == 1, joined(material));
  CHECK(material[0].find("dust.field.material: there is no material 'sandy'") != std::string::npos);
  const auto classes = lines("classes: [5, 20 um]", "classes: [5, 20 kg]");
  REQUIRE_MESSAGE(classes.size() == 1, joined(classes));
  CHECK(classes[0].find("'kg' is the unit of a mass") != std::string::npos);
}

TEST_CASE("the keys of a dust block shall be listed once each") {
  const Folder folder;
  const std::string all = joined(problems(folder.write("s.yaml", with("dust: {qqqqq: 1}\n"))));
  const std::size_t first = all.find("feed_zones");
  REQUIRE_MESSAGE(first != std::string::npos, all);
  CHECK_MESSAGE(all.find("feed_zones", first + 1) == std::string::npos, all);
}

TEST_CASE("loads that cannot come off shall be refused with a remedy") {
  check_text(dusty("dust_load: [0.6, 0.5]"),
             "materials.sand.dust_load: the shares of the classes make 110 % of the grain");
  check_text(dusty("dust_load: [1 %]"),
             "materials.sand.dust_load: 1 numbers for 2 classes of dust.field; give one for each");
  check_text(with(k_liberation),
             "dust.liberation: no material has a dust_load that could come off");
  check_text(dusty("dust_load: [1 %]", ""), "there is no dust.field whose classes it could mean");
  check_text(dusty("dust_load: [1 %]",
                   "dust: {finer_than: 50 um, liberation: {model: energy, "
                   "binding_energy: 2 MJ/kg}}\n"),
             "dust.liberation: there is no dust.field that takes up what comes off");
  check_text(dusty("dust_load: [1 %, 0], moisture: 3 %",
                   changed(k_liberation, "model: energy, binding_energy: 2 MJ/kg",
                           "model: given, emission: 3 g/t")),
             "materials.sand.moisture: the law of dust.liberation makes nothing of it");
  check_text(dusty("moisture: 3 %", ""),
             "materials.sand.moisture: there is no dust.liberation that makes anything of it");
  std::string text = dusty("dust_load: [1 %, 1 %]");
  const std::size_t fluid = text.find("fluid:");
  text = text.substr(0, fluid) + "fluid: none\n" + text.substr(text.find("sensors:"));
  check_text(text, "materials.sand.dust_load: there is no fluid that takes dust up");
}

TEST_CASE(
    "feed zones shall be read and written out the same, and refused where they mean nothing") {
  const auto zoned = [](const std::string& box) {
    return dusty("dust_load: [0.1 %, 0.4 %]",
                 changed(k_liberation, "dust: {", "dust: {feed_zones: {belt: " + box + "}, "));
  };
  const Folder folder;
  const auto first = read(folder.write("s.yaml", zoned("{min: [0, 0, 1 mm], max: [1, 1, 2 mm]}")));
  REQUIRE(first.dust.feed_zones.size() == 1);
  CHECK(first.dust.feed_zones[0].name == "belt");
  CHECK(first.dust.feed_zones[0].min.z == 1e-3);
  CHECK(read(folder.write("t.yaml", first.resolved_yaml)).resolved_yaml == first.resolved_yaml);
  check_text(zoned("{min: [1, 1, 2 mm], max: [0, 0, 1 mm]}"),
             "dust.feed_zones.belt: no part of the box lies in the domain; min is its lower");
  check_text(zoned("{min: [0, 0, -2 m], max: [1, 1, -1 m]}"),
             "dust.feed_zones.belt: no part of the box lies in the domain");
  check_text(zoned("{min: [0, 0, 1 mm]}"), "missing key 'max'");
  check_text(with("dust: {finer_than: 50 um, feed_zones: {belt: {min: [0, 0, 1 mm], max: [1, 1, 2 "
                  "mm]}}}\n"),
             "dust.feed_zones: nothing comes off grains anywhere: give dust: {liberation:");
}

TEST_CASE("loads without a law shall be told to stay") {
  const Folder folder;
  const auto result =
      read(folder.write("s.yaml", dusty("dust_load: [1 %, 0]",
                                        "dust: {field: {classes: [5, 20 um], material: "
                                        "sand}}\n")));
  CHECK(joined(result.warnings).find("materials.sand.dust_load: stays on the grains") !=
        std::string::npos);
  CHECK(result.dust.shares_on_grains().empty());
}

TEST_CASE("sources and clouds outside the domain, upside down or out of time shall be told") {
  const auto field = [](const std::string& kind, const std::string& rest) {
    return with("dust: {field: {classes: [5, 20 um], material: sand, " + kind + ": {s: {" + rest +
                "}}}}\n");
  };
  const std::string box = "min: [1, 1, 1 mm], max: [5, 5, 5 mm], ";
  const std::string flow = "mass_flow: [1, 2 mg/s]";
  check_text(field("sources", "min: [50, 0, 0 m], max: [60, 1, 1 m], " + flow),
             "dust.field.sources.s: no part of the box lies in the domain: in x it reaches from 50 "
             "to 60 m, the domain from ");
  check_text(field("sources", "min: [5, 1, 1 mm], max: [1, 5, 5 mm], " + flow),
             "dust.field.sources.s: min is above max in x: 0.005 m and 0.001 m; give");
  check_text(field("clouds", "min: [50, 0, 0 m], max: [60, 1, 1 m], concentration: [1, 1 g/m3]"),
             "dust.field.clouds.s: no part of the box lies in the domain");
  check_text(field("clouds", "min: [1, 5, 1 mm], max: [5, 1, 5 mm], concentration: [1, 1 g/m3]"),
             "dust.field.clouds.s: min is above max in y");
  check_text(field("sources", box + flow + ", begin: 3 ms, end: 1 ms"),
             "dust.field.sources.s.end: 0.001 s is not after begin, 0.003 s");
  const Folder folder;
  const auto late = read(folder.write("s.yaml", field("sources", box + flow + ", begin: 1 h")));
  CHECK(joined(late.warnings).find("dust.field.sources.s.begin: 3600 s is not before time.end") !=
        std::string::npos);
  // A flat box is one layer of cells.
  const std::string flat = "min: [1, 1, 1 mm], max: [5, 5, 1 mm], ";
  CHECK(joined(read(folder.write("t.yaml", field("sources", flat + flow))).warnings)
            .find("sources") == std::string::npos);
}

TEST_CASE("a load of more than a fifth of the material shall be asked for its per cent") {
  const Folder folder;
  const auto warned = [&](const std::string& load) {
    return joined(read(folder.write("s.yaml", dusty(load))).warnings)
               .find(
                   "materials.sand.dust_load: dust is 50 % of the material: numbers without a "
                   "unit are shares of one; write per cent as 0.5 %") != std::string::npos;
  };
  CHECK(warned("dust_load: [0.1, 0.4]"));
  CHECK_FALSE(warned("dust_load: [0.1 %, 0.4 %]"));
}

TEST_CASE("a moisture of more than a fifth of the solids shall be asked for its per cent") {
  const Folder folder;
  const auto warned = [&](const std::string& moisture) {
    const std::string text = dusty("dust_load: [0.1 %, 0.4 %], moisture: " + moisture);
    return joined(read(folder.write("s.yaml", text)).warnings)
               .find(
                   "materials.sand.moisture: water is 100 % of the dry solids: a number without a "
                   "unit is a share of one; write per cent as 1 %") != std::string::npos;
  };
  CHECK(warned("1"));
  CHECK_FALSE(warned("1 %"));
}
