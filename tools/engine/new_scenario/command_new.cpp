// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/process/shell_word.hpp"
#include "commands.hpp"
#include "new_scenario/new_scenario.hpp"
#include "scenario/reader.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"

#include <filesystem>
#include <iostream>
#include <map>

namespace dust::engine {
namespace {

namespace fs = std::filesystem;

/// A size of the command line in SI; throws base::UserError.
double size_in_si(const Size& size, const std::string& text) {
  const std::string place = std::string("engine new: error: --") + size.option + ": ";
  std::string error;
  const auto written = scenario::split_number(text, error);
  if (!written) throw base::UserError(place + error);
  const sdk::Dimension dimension = scenario::parse_unit(size.unit)->dimension;
  const auto value = scenario::to_si(*written, dimension, error);
  if (!value) throw base::UserError(place + error);
  if (!(*value > 0.0)) throw base::UserError(place + "above 0 is expected, not " + text);
  const std::string likely = written->unit.empty() ? scenario::likely_unit(dimension, *value) : "";
  if (!likely.empty()) {
    const std::string as_read = text + " " + scenario::si_unit(dimension);
    throw base::UserError(place + text + " has no unit and would be " + as_read + ": write " +
                          base::shell_word(text + " " + likely) + " or " +
                          base::shell_word(as_read));
  }
  return *value;
}

void write_new(const Starter& starter, const std::map<std::string, std::string>& given,
               const std::string& output) {
  const fs::path file = output.empty() ? std::string(starter.name) + ".yaml" : output;
  std::error_code code;
  if (fs::exists(file, code)) {
    throw base::UserError(file.string() + ": error: exists already: choose another with -o FILE");
  }
  std::vector<double> sizes;
  for (const Size& size : starter.sizes) {
    const auto at = given.find(size.option);
    const bool is_given = at != given.end() && !at->second.empty();
    sizes.push_back(size_in_si(size, is_given ? at->second : size.by_default));
  }
  const FileNames names{.scenario = scenario::name_from_file(file),
                        .file = base::shell_word(file.filename().string())};
  write_file(file, starter.write(names, sizes));
  std::cout << "wrote " << file.string() << "; next: engine check "
            << base::shell_word(file.string()) << '\n';
}

/// `given` is no scenario to start from; throws base::UserError.
[[noreturn]] void refuse_name(const std::string& given) {
  std::vector<std::string> names;
  for (const Starter& starter : starters()) names.emplace_back(starter.name);
  if (given.empty()) {
    throw base::UserError("engine new: error: which scenario? There are: " +
                          scenario::listed(names));
  }
  throw base::UserError("engine new: error: there is no scenario " + scenario::in_quotes(given) +
                        " to start from" + scenario::suggestion(given, names, "there are"));
}

}  // namespace

void add_new(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("new", "Write a scenario to start from, in your sizes");
  command->require_subcommand(0, 1);
  // Takes what is none of them, to say which there are.
  command->allow_extras();
  command->callback([command] {
    const std::vector<std::string> others = command->remaining();
    if (command->get_subcommands().empty()) refuse_name(others.empty() ? "" : others.front());
  });
  command->footer(
      "Examples:\n"
      "  engine new transfer --speed '2.5 m/s' --drop '1.2 ft' -o my_belt.yaml\n"
      "  engine new hopper --outlet '30 mm'");
  for (const Starter& starter : starters()) {
    struct Arguments {
      std::map<std::string, std::string> sizes;
      std::string output;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* one = command->add_subcommand(starter.name, starter.sentence);
    for (const Size& size : starter.sizes) {
      one->add_option(std::string("--") + size.option, arguments->sizes[size.option],
                      std::string(size.sentence) + " (default: " + size.by_default + ")")
          ->type_name("SIZE");
    }
    one->add_option("-o,--output", arguments->output,
                    std::string("File to write (default: ") + starter.name + ".yaml)")
        ->type_name("FILE");
    one->callback([arguments, &starter, command] {
      const std::vector<std::string> others = command->remaining(true);
      if (!others.empty()) throw CLI::ExtrasError(others);
      write_new(starter, arguments->sizes, arguments->output);
    });
  }
}

}  // namespace dust::engine
