// SPDX-License-Identifier: Apache-2.0
#include "study/hoods/hood_study.hpp"

#include "base/error.hpp"
#include "base/process/shell_word.hpp"
#include "base/text.hpp"
#include "preflight/derived.hpp"
#include "report/highlights.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/reader.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

/// What is known of the run that the points go on from.
struct FinishedRun {
  fs::path folder;
  report::RunText text;
  scenario::ReadResult scenario;
  std::vector<LowPressurePlace> places;
};

std::string mm(double metres) { return base::digits_text(std::round(1e6 * metres) / 1000.0, 8); }

std::string box_text(const sdk::Vec3& low, const sdk::Vec3& high) {
  const auto corner = [](const sdk::Vec3& p) {
    return "[" + mm(p.x) + ", " + mm(p.y) + ", " + mm(p.z) + " mm]";
  };
  return "min: " + corner(low) + ", max: " + corner(high);
}

/// "60 l/min" as a part of a name.
std::string word_of(std::string text) {
  std::string word;
  for (const char c : text) {
    const bool is_plain =
        (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (is_plain) {
      word += c;
    } else if (!word.empty() && word.back() != '_') {
      word += '_';
    }
  }
  return word;
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw base::UserError(where + ": error: " + what);
}

/// The state to go on from has to be there, whole.
void check_state(const FinishedRun& run) {
  const std::string folder = run.folder.string();
  const std::string summary = (run.folder / "summary.json").string();
  if (report::text_at(run.text.summary, "status") != "finished") {
    refuse(summary + ":1",
           "the run has not finished, and what a hood catches is tried from its last state: engine "
           "run " +
               base::shell_word((run.folder / "scenario.yaml").string()) + " -o " +
               base::shell_word(folder) + " --resume");
  }
  if (fs::exists(run.folder / "checkpoint.h5")) return;
  refuse((run.folder / "checkpoint.h5").string() + ":1",
         "is not there, and the points of the study go on from it: run the scenario again into a "
         "folder that is kept whole");
}

/// Dust and places have to be there; the messages stand where they could be declared.
void check_subject(const FinishedRun& run) {
  const auto& setup = run.scenario.setup;
  const std::string file = (run.folder / "scenario.yaml").string();
  const auto place_of = [&](const auto& things, const auto& mark) {
    return things.empty() ? file + ":1" : scenario::place(mark(things.front()));
  };
  if (!setup.fluid) {
    refuse(file + ":1", "fluid: none has no air that a hood could draw in: give the fluid's cells");
  }
  if (!has_dust(run.text)) {
    refuse(
        place_of(setup.emitters, [](const auto& e) { return e.model.where; }),
        "the run has no dust: nothing that is released is as fine as the dust: block says (finer "
        "than 100 um unless given); add a fine size to an emitter, or dust.field");
  }
  const bool has_opening =
      !setup.sensors.empty() && std::any_of(run.text.figures.begin(), run.text.figures.end(),
                                            [](const auto& f) { return f.role == "opening"; });
  if (!has_opening && !run.scenario.dust.field) {
    refuse(place_of(setup.sensors, [](const auto& s) { return s.model.where; }),
           "no sensor watches an opening, so that what escapes beside a hood is not known: give a "
           "plane_flux with role: opening where dust gets out, and run again");
  }
  if (!run.places.empty()) return;
  const auto figure = std::find_if(run.text.figures.begin(), run.text.figures.end(),
                                   [](const auto& f) { return f.role == "low_pressure"; });
  const auto mark = [](const auto& s) { return s.model.where; };
  if (figure == run.text.figures.end()) {
    refuse(place_of(setup.sensors, mark),
           "no sensor looks for places of low pressure: add sensors: {suction: {model: "
           "low_pressure}} and run again");
  }
  const auto sensor = std::find_if(setup.sensors.begin(), setup.sensors.end(),
                                   [&](const auto& s) { return s.name == figure->sensor; });
  refuse(sensor == setup.sensors.end() ? file + ":1" : scenario::place(mark(*sensor)),
         "sensors." + figure->sensor +
             " has found no place of low pressure: average longer, or allow it more: a smaller "
             "clearance, a larger box");
}

FinishedRun read_run(const fs::path& folder, const registry::Registry& registry) {
  FinishedRun run{folder, report::read_run_text(folder), {}, {}};
  check_state(run);
  scenario::Diagnostics diagnostics;
  auto scenario = scenario::read_file(folder / "scenario.yaml", {}, registry, {}, diagnostics);
  diagnostics.throw_errors();
  run.scenario = std::move(*scenario);
  run.places = places_of(run.text);
  check_subject(run);
  return run;
}

/// [m] What the checks of the study ask of bodies between periodic sides.
sdk::Vec3 periodic_clearance(const FinishedRun& run) {
  double largest = 0.0;
  for (const nlohmann::json& entry : report::list_at(run.text.summary, "size_classes")) {
    largest = std::max(largest, report::number_at(entry, "diameter_m").value_or(0.0));
  }
  sdk::Vec3 clearance;
  for (int d = 0; d < 3; ++d) {
    const auto& side = run.scenario.setup.domain.sides[static_cast<std::size_t>(2 * d)];
    if (side.grains == scenario::GrainSide::periodic) clearance[d] = largest;
  }
  return clearance;
}

/// What the hood is made of: as the bodies are, or the walls, or else the grains.
std::string material_of(const scenario::Setup& setup) {
  int material = setup.materials.empty() ? -1 : 0;
  if (!setup.emitters.empty()) material = setup.emitters.front().material;
  for (const auto& side : setup.domain.sides) {
    if (side.grains == scenario::GrainSide::wall && side.material >= 0) material = side.material;
  }
  if (!setup.bodies.empty()) material = setup.bodies.front().material;
  return material < 0 ? std::string() : setup.materials[static_cast<std::size_t>(material)].name;
}

/// Sensors that watch openings begin anew once the flow of the hood has come about.
std::set<std::string> openings_of(const report::RunText& run) {
  std::set<std::string> names;
  for (const report::Figure& figure : run.figures) {
    if (figure.role == "opening") names.insert(figure.sensor);
  }
  return names;
}

/// When a point begins and ends, on whole fluid steps [s].
struct Span {
  double begin = 0.0, end = 0.0, output_every = 0.0;
};

Span span_of(const FinishedRun& run, double duration) {
  constexpr double k_min_steps = 60.0;  // as many rows of series.csv, for an error
  constexpr double k_frames = 5.0;
  const double step = run.scenario.setup.time.fluid_step;
  Span span;
  span.begin = report::number_at(run.text.summary, "simulated_s").value_or(0.0);
  const double wanted = duration > 0.0 ? duration : 0.5 * span.begin;
  const double steps = std::max(k_min_steps, std::round(wanted / step));
  span.end = span.begin + steps * step;
  span.output_every = step * std::max(1.0, std::floor(steps / k_frames));
  return span;
}

std::string time_text(double seconds) { return base::digits_text(seconds, 10) + " s"; }

/// A path as YAML reads it back.
std::string yaml_text(const fs::path& path) {
  const std::string text = path.generic_string();
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
  };
  if (std::all_of(text.begin(), text.end(), is_plain) && !text.starts_with('-')) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

void write_head(std::ostringstream& out, const FinishedRun& run, const HoodStudy& study,
                const HoodStudyOptions& options) {
  const fs::path beside = fs::absolute(options.file).parent_path();
  const fs::path folder = fs::proximate(fs::absolute(run.folder), beside);
  const std::string name = scenario::name_from_file(options.file);
  const Span span = span_of(run, options.duration);
  out << "# Hoods tried from the last state of " << run.text.summary.value("scenario", "a run")
      << ", at its places of low pressure, and the plain run beside them.\n# engine study "
      << base::shell_word(options.file.string()) << " -o results/" << name
      << ", then: engine suggest-hoods results/" << name << "\nname: " << name
      << "\ntitle: Hoods at " << study.sites.size()
      << (study.sites.size() == 1 ? " place" : " places") << " of low pressure, with "
      << study.flows.size() << (study.flows.size() == 1 ? " flow" : " flows")
      << " each\nbase: " << yaml_text(folder / "scenario.yaml") << "\n"
      << (study.replicates > 1 ? "replicates: " + std::to_string(study.replicates) + "\n" : "")
      << "set:\n  start_from: " << yaml_text(folder) << "\n  time.end: " << time_text(span.end)
      << "\n  time.output_every: " << time_text(span.output_every) << '\n';
  const double steady = span.begin + k_settling * (span.end - span.begin);
  for (const std::string& sensor : openings_of(run.text)) {
    out << "  sensors." << sensor << ".steady_after: " << time_text(steady) << '\n';
  }
  if (run.text.summary.contains("dust_rates")) {
    out << "  dust.steady_after: " << time_text(steady) << '\n';
  }
}

/// What the steps of the run's grains are made for [m/s], where a hood can make grains faster: dust
/// follows the air into its opening; coarse grains, which a hood stands clear of, do not.
double steps_speed(const FinishedRun& run, const registry::Registry& registry) {
  return has_dust_grains(run.text) ? preflight::derive(run.scenario.setup, registry).expected_speed
                                   : std::numeric_limits<double>::infinity();
}

/// `expected_speed` [m/s]: a hood that draws faster says so.
void write_cases(std::ostringstream& out, const HoodStudy& study, const std::string& material,
                 double expected_speed) {
  constexpr double k_at_edge = 2.0;  // of the mean speed in the opening
  out << "cases:\n  plain: {}\n";
  for (const HoodSite& site : study.sites) {
    for (const HoodFlow& flow : study.flows) {
      out << "  place_" << site.place << "_at_" << word_of(flow.text) << ":\n    bodies."
          << k_hood_body << ": {shape: box, material: " << material << ", group: place_"
          << site.place << ", " << box_text(site.body_min, site.body_max)
          << ",\n      suction: {flow: " << flow.text << ", "
          << box_text(site.opening_min, site.opening_max) << "}}\n";
      const double speed = k_at_edge * flow.value / site.area();
      if (speed <= expected_speed) continue;
      out << "    time.expected_speed: " << base::digits_text(speed, 3) << " m/s\n";
    }
  }
}

/// What of a dust field gets out by each side in the steady stream: what the run before has let out
/// does not count. False where the run knows no such rate.
bool write_field_measures(std::ostringstream& out, const FinishedRun& run) {
  bool is_any = false;
  const std::string left = "left/", rate = "/rate";
  const nlohmann::json rates = report::object_at(run.text.summary, "dust_rates");
  for (const auto& item : rates.items()) {
    const std::string& key = item.key();
    if (!key.starts_with(left) || !key.ends_with(rate)) continue;
    const std::string side = key.substr(left.size(), key.size() - left.size() - rate.size());
    if (side == "all" || side.find('/') != std::string::npos) continue;
    out << "  out_" << side << ": {quantity: dust_rates.left." << side << ".rate, unit: kg/h}\n";
    is_any = true;
  }
  return is_any;
}

void write_measures(std::ostringstream& out, const FinishedRun& run) {
  out << "measure:\n";
  if (run.scenario.dust.field) {
    if (!write_field_measures(out, run)) {
      refuse((run.folder / "summary.json").string() + ":1",
             "dust_rates has no dust that leaves by a side, so no hood can be told from none: run "
             "it on beyond dust.steady_after, with a side that is open to the air");
    }
  } else {
    out << "  drawn_out: {quantity: mass_kg.removed, unit: mg}\n";
  }
  for (const report::Figure& opening : report::highlights_of(run.text).openings) {
    std::string quantity = "sensors." + opening.sensor + "." + opening.name;
    std::replace(quantity.begin(), quantity.end(), '/', '.');
    std::string name = opening.sensor;
    if (opening.is_of_class()) name += "_" + base::digits_text(1e6 * opening.largest, 6) + "_um";
    out << "  " << name << ": {quantity: " << quantity << ", unit: g/t}\n";
  }
}

/// What is worth a hood has to be left of the places.
RankedPlaces places_worth(const FinishedRun& run, double opening, const HoodScene& scene) {
  const auto hoods = existing_hoods(run.scenario.setup, run.scenario.dust);
  RankedPlaces ranked = ranked_places(run.places, hoods, opening, scene);
  if (!ranked.places.empty()) return ranked;
  refuse((run.folder / "summary.json").string() + ":1",
         "all of its " + std::to_string(run.places.size()) +
             " places of low pressure lie where a hood draws already (" +
             ranked.reached.front().hood +
             "): give low_pressure a box beyond its reach, or a larger count, and run again");
}

}  // namespace

std::vector<HoodFlow> flows_of(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else if (c != ' ' || !parts.back().empty()) {
      parts.back() += c;
    }
  }
  const std::string place = "engine suggest-hoods: error: --flows: ";
  std::vector<scenario::WrittenNumber> written;
  for (const std::string& part : parts) {
    std::string error;
    const auto number = scenario::split_number(part, error);
    if (!number) throw base::UserError(place + error);
    written.push_back(*number);
  }
  // A bare number would be one of m3/s: nobody means 100 of these.
  if (written.back().unit.empty()) {
    throw base::UserError(place + text + ": give a unit, e.g. " + text + " m3/h");
  }
  std::vector<HoodFlow> flows;
  for (scenario::WrittenNumber& number : written) {
    if (number.unit.empty()) number.unit = written.back().unit;
    std::string error;
    const auto value = scenario::to_si(number, sdk::dimension::volume_flow, error);
    if (!value) throw base::UserError(place + error);
    if (!(*value > 0.0)) {
      throw base::UserError(place + "above 0 is expected, not " + text +
                            ": the plain run is there by itself");
    }
    flows.push_back({*value, base::digits_text(number.number, 8) + " " + number.unit});
  }
  std::sort(flows.begin(), flows.end(),
            [](const HoodFlow& a, const HoodFlow& b) { return a.value < b.value; });
  return flows;
}

std::vector<HoodFlow> usual_flows(double area) {
  constexpr double k_litres_per_minute = 6e4;
  constexpr double k_cubic_metres_per_hour = 3600.0;
  constexpr double k_large = 1.0 / 60.0;  // m3/s: with one above 1000 l/min all are in m3/h
  constexpr std::array k_speeds = {0.5, 1.0, 2.0, 4.0};
  const bool is_large = k_speeds.back() * area > k_large;
  const double factor = is_large ? k_cubic_metres_per_hour : k_litres_per_minute;
  std::vector<HoodFlow> flows;
  for (const double speed : k_speeds) {
    const std::string number = base::digits_text(factor * speed * area, 2);
    flows.push_back({std::stod(number) / factor,
                     base::digits_text(std::stod(number), 8) + (is_large ? " m3/h" : " l/min")});
  }
  return flows;
}

HoodStudy hood_study(const fs::path& folder, const HoodStudyOptions& options,
                     const registry::Registry& registry) {
  const FinishedRun run = read_run(folder, registry);
  HoodScene scene(folder, run.text);
  scene.set_periodic_clearance(periodic_clearance(run));
  HoodStudy study;
  study.opening = options.opening > 0.0 ? options.opening : usual_opening(scene);
  RankedPlaces ranked = places_worth(run, study.opening, scene);
  study.reached = std::move(ranked.reached);
  HoodSites found = sites_at(ranked.places, options.places, study.opening, scene);
  study.sites = std::move(found.sites);
  study.without_room = std::move(found.without_room);
  study.shared = std::move(found.shared);
  if (study.sites.empty()) {
    refuse((folder / "summary.json").string() + ":1",
           "at none of its " + std::to_string(ranked.places.size()) +
               " places of low pressure there is room for a hood of " + mm(study.opening) +
               " mm clear of bodies and the stream: give a smaller --opening");
  }
  study.flows = options.flows.empty() ? usual_flows(study.sites.front().area()) : options.flows;
  const Span span = span_of(run, options.duration);
  study.duration = span.end - span.begin;
  study.replicates = options.replicates;
  std::ostringstream out;
  write_head(out, run, study, options);
  write_cases(out, study, material_of(run.scenario.setup), steps_speed(run, registry));
  write_measures(out, run);
  study.text = out.str();
  return study;
}

}  // namespace dust::study
