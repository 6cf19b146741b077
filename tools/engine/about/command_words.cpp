// SPDX-License-Identifier: Apache-2.0
#include "about/command_words.hpp"

#include <sstream>

namespace dust::engine {
namespace {

/// The type CLI11 prints: "DIR", or "TEXT:{local,slurm}" for a list of words.
void read_type(const std::string& type, OptionWords& option) {
  const std::size_t brace = type.find(":{");
  option.value = type.substr(0, type.find(':'));
  if (brace == std::string::npos) return;
  std::istringstream list(type.substr(brace + 2, type.find('}') - brace - 2));
  for (std::string word; std::getline(list, word, ',');) option.choices.push_back(word);
}

OptionWords words_of(const CLI::Option& declared) {
  OptionWords option;
  option.sentence = declared.get_description();
  option.is_required = declared.get_required();
  option.is_positional = declared.get_positional();
  if (option.is_positional) {
    option.names = {declared.get_name(true)};
  } else {
    for (const auto& name : declared.get_snames()) option.names.push_back("-" + name);
    for (const auto& name : declared.get_lnames()) option.names.push_back("--" + name);
  }
  if (declared.get_items_expected_max() > 0) read_type(declared.get_type_name(), option);
  return option;
}

}  // namespace

CommandWords words_of(const CLI::App& command) {
  CommandWords words{command.get_name(), command.get_description(), command.get_footer(), {}};
  for (const CLI::Option* option : command.get_options())
    words.options.push_back(words_of(*option));
  return words;
}

std::vector<CommandWords> words_of_commands(const CLI::App& app) {
  std::vector<CommandWords> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* one) {
         return !one->get_name().empty() && !one->get_group().empty();  // no group: hidden
       })) {
    commands.push_back(words_of(*command));
  }
  return commands;
}

}  // namespace dust::engine
