// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"
#include "study/study.hpp"

namespace dust::engine {

void add_study(CLI::App& app, int& status) {
  struct Arguments {
    study::StudyOptions options;
    std::string file;
    std::string output;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "study", "Vary a scenario: run many points of it, side by side, or calibrate it");
  command->add_option("STUDY", arguments->file, "Study file (YAML)")->required();
  study::StudyOptions& options = arguments->options;
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder of the results (default: results/NAME, or NAME-2, -3, ...)")
      ->type_name("DIR");
  auto* force =
      command->add_flag("--force", options.force, "Replace the study in a folder that holds one");
  command
      ->add_flag("--resume", options.resume,
                 "Run what is missing in the folder: points that were not reached, were "
                 "interrupted, failed, or are new in the study file")
      ->excludes(force);
  command->add_option("--jobs", options.jobs, "Runs at a time (default: what the cores allow)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--dry-run", options.dry_run,
                    "Check everything, list the points and what they cost; run nothing");
  command->add_flag("--fail-fast", options.fail_fast, "Stop at the first point that fails");
  command->add_option("--launcher", options.launcher, "Where points run: this machine or a cluster")
      ->check(CLI::IsMember({"local", "slurm"}));
  command->add_flag("--quiet", options.quiet, "Print problems only");
  add_plugin_path(*command, options.plugin_path);
  command->footer(
      "Examples:\n"
      "  engine study scenarios/studies/belt_speed.yaml --dry-run\n"
      "  engine study scenarios/studies/belt_speed.yaml -o results/speeds --jobs 2\n"
      "  engine study scenarios/studies/belt_speed.yaml -o results/speeds --resume");
  command->callback([arguments, &status] {
    study::StudyOptions& given = arguments->options;
    given.file = arguments->file;
    if (!arguments->output.empty()) given.output = arguments->output;
    status = study::run_study(given);
  });
}

}  // namespace dust::engine
