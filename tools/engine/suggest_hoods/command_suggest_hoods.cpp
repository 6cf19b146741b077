// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/process/shell_word.hpp"
#include "base/text.hpp"
#include "commands.hpp"
#include "scenario/reader.hpp"
#include "scenario/text/units.hpp"
#include "study/hoods/hood_results.hpp"
#include "study/hoods/hood_study.hpp"

#include <filesystem>
#include <iostream>

namespace dust::engine {
namespace {

namespace fs = std::filesystem;

/// What the command line says, as written.
struct Arguments {
  std::string folder;
  std::string flows;
  std::size_t places = 3;
  std::string opening;
  std::string duration;
  std::size_t replicates = 1;
  std::string capture = "90 %";
  std::string output;
  std::vector<std::string> plugin_path;
};

/// An option in SI; throws base::UserError.
double in_si(const char* option, const std::string& text, sdk::Dimension dimension) {
  const std::string place = std::string("engine suggest-hoods: error: ") + option + ": ";
  std::string error;
  const auto written = scenario::split_number(text, error);
  if (!written) throw base::UserError(place + error);
  const auto value = scenario::to_si(*written, dimension, error);
  if (!value) throw base::UserError(place + error);
  if (!(*value > 0.0)) throw base::UserError(place + "above 0 is expected, not " + text);
  return *value;
}

double capture_of(const Arguments& given) {
  const double wanted = in_si("--capture", given.capture, sdk::dimension::none);
  if (wanted < 1.0) return wanted;
  throw base::UserError("engine suggest-hoods: error: --capture: below 100 % is expected, not " +
                        given.capture + ": a hood that catches all has no smallest flow");
}

void print_sites(const study::HoodStudy& study) {
  for (const study::HoodSite& site : study.sites) {
    const sdk::Vec3 middle = 0.5 * (site.opening_min + site.opening_max);
    const auto mm = [](double metres) { return base::digits_text(1e3 * metres, 4); };
    std::cout << "place " << site.place << ": opening at (" << mm(middle.x) << ", " << mm(middle.y)
              << ", " << mm(middle.z) << ") mm";
    if (site.moved > 0.0) {
      std::cout << ", " << mm(site.moved) << " mm beside the place, where the hood has room";
    }
    constexpr double k_milligrams = 1e6;  // per kg
    std::cout << "; " << base::digits_text(k_milligrams * site.dust_near, 2)
              << " mg/m3 of dust round the place";
    std::cout << '\n';
  }
  for (const study::SharedSite& site : study.shared) {
    std::cout << "place " << site.place << ": left out, its hood would stand where that of place "
              << site.with << " does\n";
  }
  for (const study::ReachedPlace& reached : study.reached) {
    std::cout << "place " << reached.place << ": left out, " << reached.hood
              << " draws there already\n";
  }
  for (const int place : study.without_room) {
    std::cout << "place " << place << ": no room for an opening of "
              << base::digits_text(1e3 * study.opening, 4)
              << " mm clear of bodies and the stream; a smaller --opening may fit\n";
  }
}

void write_study(const Arguments& given) {
  study::HoodStudyOptions options;
  if (!given.flows.empty()) options.flows = study::flows_of(given.flows);
  options.places = given.places;
  if (!given.opening.empty()) {
    options.opening = in_si("--opening", given.opening, sdk::dimension::length);
  }
  if (!given.duration.empty()) {
    options.duration = in_si("--duration", given.duration, sdk::dimension::time);
  }
  options.replicates = given.replicates;
  const fs::path folder = fs::path(given.folder).lexically_normal();
  const fs::path named =
      folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  options.file = given.output.empty() ? named.string() + "_hoods.yaml" : given.output;
  std::error_code code;
  if (fs::exists(options.file, code)) {
    throw base::UserError(options.file.string() +
                          ": error: exists already: choose another with -o FILE");
  }
  const auto registry = load_plugins(given.plugin_path);
  const study::HoodStudy study = study::hood_study(given.folder, options, *registry);
  write_file(options.file, study.text);
  print_sites(study);
  const std::string results = base::shell_word("results/" + scenario::name_from_file(options.file));
  std::cout << "wrote " << options.file.string() << ": " << study.points() << " points of "
            << base::digits_text(study.duration, 4) << " s; next: engine study "
            << base::shell_word(options.file.string()) << " -o " << results
            << ", then: engine suggest-hoods " << results << '\n';
}

/// Options of the study that is written.
void add_study_options(CLI::App& command, Arguments& arguments) {
  command
      .add_option("--flows", arguments.flows,
                  "Flows tried at each place, e.g. '20, 60, 120 l/min' (default: 0.5, 1, 2 and 4 "
                  "m/s through the opening)")
      ->type_name("FLOWS");
  command
      .add_option(
          "--places", arguments.places,
          "How many places of low pressure are tried: those with most dust within an opening of "
          "them, beyond the reach of hoods that draw already")
      ->type_name("N")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      .add_option("--opening", arguments.opening,
                  "Side of the opening (default: 4 cells or a sixteenth of the domain's longest "
                  "side)")
      ->type_name("SIZE");
  command
      .add_option("--duration", arguments.duration,
                  "Time that each point simulates; its first third is not counted (default: half "
                  "of what the run took)")
      ->type_name("TIME");
  command
      .add_option("--replicates", arguments.replicates,
                  "Runs of each point with other seeds: from 3 on their scatter counts where it is "
                  "larger than the error that each run tells")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

}  // namespace

void add_suggest_hoods(CLI::App& app, int&) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "suggest-hoods",
      "Of a run: write a study of hoods at its places of low pressure. Of that study, once it has "
      "run: say what each hood captures");
  command
      ->add_option("FOLDER", arguments->folder,
                   "Results of a finished run, or of a study that this command wrote")
      ->required();
  add_study_options(*command, *arguments);
  command
      ->add_option("--capture", arguments->capture,
                   "Of a study: fraction of the dust that a hood shall capture")
      ->type_name("FRACTION")
      ->capture_default_str();
  command
      ->add_option("-o,--output", arguments->output,
                   "Study file to write (default: RUN_hoods.yaml)")
      ->type_name("FILE");
  add_plugin_path(*command, arguments->plugin_path);
  command->footer(
      "Examples:\n"
      "  engine suggest-hoods results/dusty --flows '20, 60, 120 l/min' -o hoods.yaml\n"
      "  engine study hoods.yaml -o results/hoods\n"
      "  engine suggest-hoods results/hoods --capture '80 %'");
  command->callback([arguments] {
    if (!study::is_study(arguments->folder)) {
      write_study(*arguments);
      return;
    }
    const double wanted = capture_of(*arguments);
    std::cout << study::hood_table(study::hood_results(arguments->folder), wanted);
  });
}

}  // namespace dust::engine
