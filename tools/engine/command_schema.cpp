// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"
#include "scenario/reader.hpp"
#include "study/spec/spec.hpp"

#include <iostream>

namespace dust::engine {

void add_schema(CLI::App& app, int&) {
  auto folders = std::make_shared<std::vector<std::string>>();
  auto is_study = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "schema", "Print the JSON Schema of scenarios with the plugins found, for editors");
  add_plugin_path(*command, *folders);
  command->add_flag("--study", *is_study, "The schema of study files instead");
  command->footer(
      "Example:\n"
      "  engine schema > scenario.schema.json\n"
      "and as the first line of a scenario:\n"
      "  # yaml-language-server: $schema=scenario.schema.json");
  command->callback([folders, is_study] {
    std::cout << (*is_study ? study::study_schema()
                            : scenario::json_schema(*load_plugins(*folders)));
  });
}

}  // namespace dust::engine
