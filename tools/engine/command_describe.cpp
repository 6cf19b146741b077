// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "catalogue/catalogue.hpp"
#include "commands.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace dust::engine {
namespace {

using Json = nlohmann::ordered_json;

/// A model by kind and name, or by a name that one kind alone has.
Subject find_subject(const registry::Registry& registry, const std::string& wanted) {
  std::vector<std::string> names;
  std::vector<Subject> of_that_name;
  for (Subject& subject : subjects(registry)) {
    const std::string name = subject.info.kind + "/" + subject.info.name;
    if (name == wanted) return std::move(subject);
    names.push_back(name);
    if (subject.info.name == wanted) of_that_name.push_back(std::move(subject));
  }
  if (of_that_name.size() == 1) return std::move(of_that_name.front());
  if (!of_that_name.empty()) {
    std::vector<std::string> whole;
    whole.reserve(of_that_name.size());
    for (const Subject& s : of_that_name) whole.push_back(s.info.kind + "/" + s.info.name);
    throw base::UserError("engine describe: error: several kinds have a '" + wanted +
                          "': write one of " + scenario::listed(whole));
  }
  throw base::UserError("engine describe: error: there is no '" + scenario::printable(wanted) +
                        "'" + scenario::suggestion(wanted, names, "there are"));
}

std::string unit_text(const sdk::Parameter& p) {
  const std::string unit = scenario::si_unit(p.dimension);
  return unit.empty() ? "-" : unit;
}

std::string default_or_required(const sdk::Parameter& p) {
  if (p.is_required) return "required";
  const std::string text = scenario::default_text(p);
  return text.empty() ? "none" : text;
}

std::string allowed(const sdk::Parameter& p) {
  if (!p.options.empty()) return scenario::listed(p.options);
  const std::string usual = scenario::usual_text(p);
  return scenario::range_text(p) + (usual.empty() ? "" : "; usual: " + usual);
}

void print_text(const Subject& subject) {
  const sdk::ModelInfo& info = subject.info;
  std::cout << info.kind << '/' << info.name;
  if (!info.version.empty()) std::cout << ' ' << info.version;
  std::cout << "\n  " << info.summary << '\n';
  if (!info.equation.empty()) std::cout << "  Equation: " << info.equation << '\n';
  if (!info.source.empty()) std::cout << "  Source: " << info.source << '\n';
  if (!subject.file.empty()) std::cout << "  File: " << subject.file << '\n';
  if (info.parameters.empty()) std::cout << "  It has no parameters.\n";
  for (const sdk::Parameter& p : info.parameters) {
    std::cout << "\n  " << p.name;
    if (!p.symbol.empty()) std::cout << " (" << p.symbol << ")";
    std::cout << ": " << scenario::type_text(p.type);
    if (!scenario::si_unit(p.dimension).empty()) {
      std::cout << " in " << scenario::si_unit(p.dimension);
    }
    std::cout << (p.is_required ? ", required" : ", default " + default_or_required(p));
    if (!allowed(p).empty()) std::cout << (p.options.empty() ? ", " : "; one of ") << allowed(p);
    std::cout << "\n      " << p.sentence << '\n';
  }
}

void print_markdown(const Subject& subject) {
  const sdk::ModelInfo& info = subject.info;
  std::cout << "# " << info.kind << '/' << info.name << "\n\n" << info.summary << "\n\n";
  if (!info.equation.empty()) std::cout << "$$ " << info.equation << " $$\n\n";
  if (!info.source.empty()) std::cout << "Source: " << info.source << "\n\n";
  if (info.parameters.empty()) {
    std::cout << "It has no parameters.\n";
    return;
  }
  std::cout << "| parameter | symbol | type | unit | default | allowed | meaning |\n"
               "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const sdk::Parameter& p : info.parameters) {
    std::cout << "| `" << p.name << "` | " << p.symbol << " | " << scenario::type_text(p.type)
              << " | " << unit_text(p) << " | " << default_or_required(p) << " | " << allowed(p)
              << " | " << p.sentence << " |\n";
  }
}

Json json_of(const Subject& subject) {
  const sdk::ModelInfo& info = subject.info;
  Json json = {{"kind", info.kind},       {"name", info.name},          {"version", info.version},
               {"summary", info.summary}, {"equation", info.equation},  {"source", info.source},
               {"file", subject.file},    {"parameters", Json::array()}};
  for (const sdk::Parameter& p : info.parameters) {
    Json one = {{"name", p.name},
                {"symbol", p.symbol},
                {"type", scenario::type_text(p.type)},
                {"unit", scenario::si_unit(p.dimension)},
                {"required", p.is_required},
                {"range", scenario::range_text(p)},
                {"usual", scenario::usual_text(p)},
                {"sentence", p.sentence}};
    if (!p.is_required) one["default"] = scenario::default_text(p);
    if (!p.options.empty()) one["options"] = p.options;
    json["parameters"].push_back(one);
  }
  return json;
}

/// All models of a kind.
void print_whole_kind(const std::vector<Subject>& all, const std::string& kind, bool as_json,
                      bool as_markdown) {
  if (!as_json && !as_markdown) {
    std::cout << kind << '\n';
    print_kind(std::cout, all, kind, true);
    return;
  }
  Json list = Json::array();
  const char* gap = "";
  for (const Subject& subject : all) {
    if (subject.info.kind != kind) continue;
    if (as_json) {
      list.push_back(json_of(subject));
    } else {
      std::cout << gap;
      print_markdown(subject);
      gap = "\n";
    }
  }
  if (as_json) std::cout << list.dump(2) << '\n';
}

}  // namespace

void add_describe(CLI::App& app, int&) {
  struct Arguments {
    std::string subject;
    std::vector<std::string> folders;
    bool as_markdown = false;
    bool as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "describe", "Tell a model's parameters: type, unit, default, range, equation, source");
  command
      ->add_option(
          "KIND/NAME", arguments->subject,
          "A model, for example drag/gidaspow or gidaspow; a kind alone: all of its models, "
          "in short or as Markdown or JSON")
      ->required();
  auto* markdown = command->add_flag("--markdown", arguments->as_markdown, "Print as Markdown");
  command->add_flag("--json", arguments->as_json, "Print as JSON")->excludes(markdown);
  add_plugin_path(*command, arguments->folders);
  command->footer(
      "Examples:\n"
      "  engine describe drag\n"
      "  engine describe contact/hertz_mindlin\n"
      "  engine describe shape/conveyor --markdown");
  command->callback([arguments] {
    const auto registry = load_plugins(arguments->folders);
    const auto all = subjects(*registry);
    const auto kinds = kinds_of(all);
    if (std::find(kinds.begin(), kinds.end(), arguments->subject) != kinds.end()) {
      print_whole_kind(all, arguments->subject, arguments->as_json, arguments->as_markdown);
      return;
    }
    const Subject subject = find_subject(*registry, arguments->subject);
    if (arguments->as_json) {
      std::cout << json_of(subject).dump(2) << '\n';
    } else if (arguments->as_markdown) {
      print_markdown(subject);
    } else {
      print_text(subject);
    }
  });
}

}  // namespace dust::engine
