// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "commands.hpp"

namespace dust::engine {

void add_graph(CLI::App& app, int& status) {
  struct Arguments {
    ScenarioArguments scenario;
    std::string run_folder;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("graph", "Print the task graph of a scenario as DOT");
  arguments->scenario.add_to(*command, false);
  command
      ->add_option("--run", arguments->run_folder,
                   "A run's folder: its own scenario, with the timings of that run")
      ->type_name("DIR");
  command->footer(
      "Examples:\n"
      "  engine graph scenarios/transfer_point.yaml | dot -Tsvg > graph.svg\n"
      "  engine graph --run results/transfer_point | dot -Tsvg > graph.svg");
  command->callback([arguments, &status] {
    run::RunOptions options = arguments->scenario.options();
    std::optional<std::filesystem::path> run_folder;
    if (!arguments->run_folder.empty()) run_folder = arguments->run_folder;
    if (options.scenario.empty() && !run_folder) {
      throw base::UserError("engine graph: error: name a scenario, or a run's folder with --run");
    }
    if (options.scenario.empty()) options.scenario = *run_folder / "scenario.yaml";
    status = run::print_graph(options, run_folder);
  });
}

}  // namespace dust::engine
