// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "run/run_options.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dust::engine {

/// Each adds its command to the program; the command sets `status` when it has run.
/// `command_line`: as typed, for run.log.
void add_run(CLI::App& app, int& status, const std::string& command_line);
void add_check(CLI::App& app, int& status);
void add_plugins(CLI::App& app, int& status);
void add_describe(CLI::App& app, int& status);
void add_list(CLI::App& app, int& status);
void add_follow(CLI::App& app, int& status);
void add_new(CLI::App& app, int& status);
void add_help(CLI::App& app, int& status);
void add_schema(CLI::App& app, int& status);
void add_graph(CLI::App& app, int& status);
void add_study(CLI::App& app, int& status);
void add_suggest_hoods(CLI::App& app, int& status);
void add_report(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_new_plugin(CLI::App& app, int& status);
void add_test_plugin(CLI::App& app, int& status);
void add_report_bug(CLI::App& app, int& status);
/// The last ones: they print all commands declared before.
void add_man(CLI::App& app, int& status);
void add_completion(CLI::App& app, int& status);

/// Options that name a scenario and change it: SCENARIO, --set, --set-file, --plugin-path.
class ScenarioArguments {
 public:
  /// Adds the options to a command; they are read to this object when the command is.
  void add_to(CLI::App& command, bool is_scenario_required = true);
  /// What was given, as options of a run; throws base::UserError for a `--set` without '='.
  [[nodiscard]] run::RunOptions options() const;
  [[nodiscard]] const std::vector<std::string>& plugin_path() const { return plugin_path_; }

 private:
  std::string scenario_;
  std::vector<std::string> settings_;
  std::vector<std::string> set_files_;
  std::vector<std::string> plugin_path_;
};

void add_plugin_path(CLI::App& command, std::vector<std::string>& folders);

/// All plugins of the search path, loaded.
std::unique_ptr<registry::Registry> load_plugins(const std::vector<std::string>& plugin_path);

/// Replaces `file` by `text`; throws base::UserError when that is not possible.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace dust::engine
