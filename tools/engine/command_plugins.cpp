// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace dust::engine {

void add_plugins(CLI::App& app, int&) {
  auto folders = std::make_shared<std::vector<std::string>>();
  CLI::App* command =
      app.add_subcommand("plugins", "List every plugin found: kind, name, version, file");
  add_plugin_path(*command, *folders);
  command->footer(
      "Plugins are looked for in --plugin-path, $DUST_PLUGIN_PATH and "
      "<prefix>/lib/dust/plugins.\n"
      "Example:\n  engine plugins --plugin-path my_plugins");
  command->callback([folders] {
    const auto registry = load_plugins(*folders);
    std::size_t kind = 0;
    std::size_t name = 0;
    std::size_t version = 0;
    for (const auto& entry : registry->entries()) {
      kind = std::max(kind, entry.info.kind.size());
      name = std::max(name, entry.info.name.size());
      version = std::max(version, entry.info.version.size());
    }
    std::cout << std::left;
    for (const auto& entry : registry->entries()) {
      std::cout << std::setw(static_cast<int>(kind) + 2) << entry.info.kind
                << std::setw(static_cast<int>(name) + 2) << entry.info.name
                << std::setw(static_cast<int>(version) + 2) << entry.info.version
                << entry.file.string() << '\n';
    }
  });
}

}  // namespace dust::engine
