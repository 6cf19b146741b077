// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "commands.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace dust::engine {

void add_plugin_path(CLI::App& command, std::vector<std::string>& folders) {
  command.add_option("--plugin-path", folders, "Folder to look for plugins in, before all others")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

void ScenarioArguments::add_to(CLI::App& command, bool is_scenario_required) {
  auto* option = command.add_option("SCENARIO", scenario_, "Scenario file (YAML)");
  if (is_scenario_required) option->required();
  command
      .add_option("--set", settings_, "Set one key, for example --set bodies.belt.speed='0.4 m/s'")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_option("--set-file", set_files_, "Lay the keys of another file over the scenario")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_plugin_path(command, plugin_path_);
}

run::RunOptions ScenarioArguments::options() const {
  run::RunOptions options;
  options.scenario = scenario_;
  std::vector<std::string> problems;
  for (const std::string& setting : settings_) {
    const std::size_t sign = setting.find('=');
    if (sign == std::string::npos || sign == 0) {
      problems.push_back("--set " + setting + ": error: write --set path=value");
      continue;
    }
    options.overrides.push_back({setting.substr(0, sign), setting.substr(sign + 1)});
  }
  if (!problems.empty()) throw base::UserError(problems);
  options.set_files.assign(set_files_.begin(), set_files_.end());
  options.plugin_path.assign(plugin_path_.begin(), plugin_path_.end());
  return options;
}

std::unique_ptr<registry::Registry> load_plugins(const std::vector<std::string>& plugin_path) {
  auto registry = std::make_unique<registry::Registry>();
  registry->load(registry::Registry::search_path({plugin_path.begin(), plugin_path.end()}));
  return registry;
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) {
    throw base::UserError(file.string() + ": error: cannot be written: " + std::strerror(errno));
  }
}

}  // namespace dust::engine
