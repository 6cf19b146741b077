// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"
#include "program/program.hpp"

namespace dust::engine {

void add_run(CLI::App& app, int& status, const std::string& command_line) {
  struct Arguments {
    ScenarioArguments scenario;
    std::string output;
    bool force = false;
    bool resume = false;
    bool quiet = false;
    bool verbose = false;
    bool live = false;
    int live_port = 0;
    int threads = 0;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("run", "Run a scenario (the command's name may be left out)");
  arguments->scenario.add_to(*command);
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder of the results (default: results/NAME, or NAME-2, -3, ...)")
      ->type_name("DIR");
  auto* force = command->add_flag("--force", arguments->force,
                                  "Replace the results in a folder that holds some");
  command->add_flag("--resume", arguments->resume, "Go on from the checkpoint in the folder")
      ->excludes(force);
  command
      ->add_option("--threads", arguments->threads,
                   "Number of threads (default: all cores); the results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  auto* live = command->add_flag(
      "--live", arguments->live,
      "Show the growing report to browsers of this machine; the address is printed");
  command->add_option("--live-port", arguments->live_port, "Port of --live (default: any free one)")
      ->type_name("N")
      ->check(CLI::Range(1, 65535))
      ->needs(live);
  auto* quiet = command->add_flag("--quiet", arguments->quiet, "Print problems only");
  command->add_flag("--verbose", arguments->verbose, "Print what is logged")->excludes(quiet);
  command->footer(
      "Examples:\n"
      "  engine run scenarios/transfer_point.yaml -o results/slow "
      "--set bodies.belt.speed='0.4 m/s'\n"
      "  engine run scenarios/transfer_point.yaml -o results/slow --resume");
  command->callback([arguments, &status, command_line] {
    run::RunOptions options = arguments->scenario.options();
    if (!arguments->output.empty()) options.output = arguments->output;
    options.force = arguments->force;
    options.resume = arguments->resume;
    options.quiet = arguments->quiet;
    options.verbose = arguments->verbose;
    options.threads = arguments->threads;
    if (arguments->live) options.live_port = arguments->live_port;
    options.command = command_line;
    options.program = program_text();
    status = run::run_scenario(options);
  });
}

}  // namespace dust::engine
