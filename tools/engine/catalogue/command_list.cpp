// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "catalogue/catalogue.hpp"
#include "commands.hpp"
#include "scenario/text/suggest.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace dust::engine {
namespace {

/// Every kind with the names of its models.
void print_kinds(const std::vector<Subject>& all) {
  const auto kinds = kinds_of(all);
  std::size_t width = 0;
  for (const std::string& kind : kinds) width = std::max(width, kind.size());
  for (const std::string& kind : kinds) {
    std::vector<std::string> names;
    for (const Subject& one : all) {
      if (one.info.kind == kind) names.push_back(one.info.name);
    }
    std::cout << std::left << std::setw(static_cast<int>(width) + 2) << kind
              << scenario::listed(names) << '\n';
  }
  std::cout << "\n'engine list KIND' says what each does, 'engine describe KIND/NAME' how to set "
               "it.\n";
}

}  // namespace

void add_list(CLI::App& app, int&) {
  struct Arguments {
    std::string kind;
    std::vector<std::string> folders;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("list", "List the models there are, of all kinds or one");
  command->add_option("KIND", arguments->kind, "A kind of models, for example drag");
  add_plugin_path(*command, arguments->folders);
  command->footer("Examples:\n  engine list\n  engine list sensor");
  command->callback([arguments] {
    const auto registry = load_plugins(arguments->folders);
    const auto all = subjects(*registry);
    if (arguments->kind.empty()) {
      print_kinds(all);
      return;
    }
    const auto kinds = kinds_of(all);
    if (std::find(kinds.begin(), kinds.end(), arguments->kind) == kinds.end()) {
      throw base::UserError("engine list: error: there is no kind '" +
                            scenario::printable(arguments->kind) + "'" +
                            scenario::suggestion(arguments->kind, kinds, "there are"));
    }
    print_kind(std::cout, all, arguments->kind, false);
  });
}

void add_help(CLI::App& app, int&) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("help", "Explain the program or one of its commands");
  command->add_option("COMMAND", *name, "A command, for example study");
  command->footer("Examples:\n  engine help\n  engine help study");
  command->callback([name, &app] {
    if (name->empty()) {
      // Its own help(), were it asked, would be that of the command just given.
      std::cout << app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
      return;
    }
    std::vector<std::string> names;
    for (CLI::App* one : app.get_subcommands([](CLI::App*) { return true; })) {
      if (one->get_name() == *name) {
        std::cout << one->help("engine");
        return;
      }
      names.push_back(one->get_name());
    }
    throw base::UserError("engine help: error: there is no command '" + scenario::printable(*name) +
                          "'" + scenario::suggestion(*name, names, "there are"));
  });
}

}  // namespace dust::engine
