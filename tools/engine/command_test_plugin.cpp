// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "commands.hpp"
#include "contract/contract.hpp"
#include "memory/counting_new.hpp"
#include "registry/library.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/tree.hpp"
#include "scenario/text/values.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>

namespace dust::engine {
namespace {

using contract::RuleResult;
using contract::Verdict;

/// Reads PARAMETER=VALUE for the models that have such a parameter.
void read_setting(const std::string& setting, const std::vector<registry::Entry>& entries,
                  std::vector<contract::Options>& options) {
  const std::size_t sign = setting.find('=');
  const std::string place = "--set " + setting.substr(0, sign);
  if (sign == std::string::npos || sign == 0) {
    throw base::UserError(place + ": error: write --set PARAMETER=VALUE");
  }
  scenario::Diagnostics diagnostics;
  const auto node = scenario::parse_yaml(setting.substr(sign + 1), place, true, diagnostics);
  diagnostics.throw_errors();
  const std::string wanted = setting.substr(0, sign);
  std::vector<std::string> names;
  bool is_found = false;
  for (std::size_t n = 0; n < entries.size(); ++n) {
    for (const sdk::Parameter& p : entries[n].info.parameters) {
      names.push_back(p.name);
      if (p.name != wanted || !node) continue;
      is_found = true;
      const auto value = scenario::read_value(*node, p, p.name, diagnostics);
      if (value) options[n].given[p.name] = *value;
    }
  }
  diagnostics.throw_errors();
  if (!is_found) {
    throw base::UserError(place + ": error: no model of this library has this parameter" +
                          scenario::suggestion(wanted, names, "there are"));
  }
}

/// Throws base::UserError where a model has the name of a shipped one: the engine would refuse to
/// load it beside that one.
void refuse_shipped_names(const std::vector<registry::Entry>& entries) {
  // The shipped ones first: what is refused then is the newcomer.
  auto folders = registry::Registry::search_path({});
  std::reverse(folders.begin(), folders.end());
  registry::Registry found;
  try {
    found.load(folders);
  } catch (const base::PluginError&) {
    // What is wrong with other libraries is not asked here.
  }
  std::string lines;
  for (const registry::Entry& entry : entries) {
    const registry::Entry* other = found.find(entry.info.kind, entry.info.name);
    if (other == nullptr || !other->is_shipped || entry.is_shipped) continue;
    lines += (lines.empty() ? "" : "\n") + registry::taken_name_line(entry, *other);
  }
  if (!lines.empty()) throw base::UserError(lines);
}

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::remark:
      return "note";
    case Verdict::fail:
      return "FAIL";
  }
  return "";
}

void print_table(const registry::Entry& entry, const std::vector<RuleResult>& results) {
  std::size_t width = 0;
  for (const RuleResult& f : results) width = std::max(width, f.rule.size());
  std::cout << entry.info.kind << '/' << entry.info.name << ' ' << entry.info.version << " ("
            << entry.file.string() << ")\n";
  for (const RuleResult& f : results) {
    std::cout << "  " << word(f.verdict) << "  " << std::left
              << std::setw(f.why.empty() ? 0 : static_cast<int>(width) + 2) << f.rule << f.why
              << '\n';
  }
}

nlohmann::ordered_json as_json(const registry::Entry& entry, const std::vector<RuleResult>& results,
                               const std::string& not_tested) {
  nlohmann::ordered_json json = {{"kind", entry.info.kind},
                                 {"name", entry.info.name},
                                 {"version", entry.info.version},
                                 {"file", entry.file.string()},
                                 {"rules", nlohmann::ordered_json::array()}};
  for (const RuleResult& f : results) {
    const char* verdict = f.verdict == Verdict::fail ? "fail" : word(f.verdict);
    json["rules"].push_back({{"rule", f.rule}, {"verdict", verdict}, {"why", f.why}});
  }
  if (!not_tested.empty()) json["not_tested"] = not_tested;
  return json;
}

/// Tests one model after the other and prints what came of it.
class Session {
 public:
  explicit Session(bool is_json) : is_json_(is_json) {}

  void test(const registry::Entry& entry, const contract::Options& options) {
    ++models_;
    std::vector<RuleResult> results;
    std::string not_tested;
    try {
      results = contract::check_model(entry, options);
    } catch (const contract::NotTested& problem) {
      not_tested = problem.why();
      ++not_tested_;
    }
    failed_ += static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(),
                      [](const RuleResult& f) { return f.verdict == Verdict::fail; }));
    if (is_json_) {
      json_.push_back(as_json(entry, results, not_tested));
      return;
    }
    print_table(entry, results);
    if (!not_tested.empty()) std::cout << "  NOT TESTED  " << not_tested << '\n';
    // A model that crashes shall not take along what is known of those before it.
    std::cout << std::flush;
  }

  void print_end() const {
    if (is_json_) {
      std::cout << json_.dump(2) << '\n';
      return;
    }
    std::string text = failed_ == 0   ? "all rules are kept"
                       : failed_ == 1 ? "1 rule is broken"
                                      : std::to_string(failed_) + " rules are broken";
    if (not_tested_ == models_) {
      text = "nothing was tested";
    } else if (not_tested_ > 0) {
      text += "; " + std::to_string(not_tested_) + " of " + std::to_string(models_) +
              " models not tested";
    }
    std::cout << text << '\n';
  }

  /// Of the program; a broken rule is worse than a model that is not known yet.
  [[nodiscard]] int status() const {
    if (failed_ > 0) return 1;
    return not_tested_ > 0 ? 2 : 0;
  }

 private:
  bool is_json_;
  std::size_t models_ = 0, failed_ = 0, not_tested_ = 0;
  nlohmann::ordered_json json_ = nlohmann::ordered_json::array();
};

}  // namespace

void add_test_plugin(CLI::App& app, int& status) {
  struct Arguments {
    std::string file;
    std::vector<std::string> settings;
    bool as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "test-plugin", "Check every model of a plugin library against the rules of its kind");
  command->add_option("FILE.so", arguments->file, "The plugin library")->required();
  command
      ->add_option("--set", arguments->settings,
                   "Give a parameter; the others are guessed from their dimension and range")
      ->type_name("PARAMETER=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->as_json, "Print as JSON");
  command->footer(
      "Each rule is passed, noted (could not be judged, or worth knowing) or failed, with the "
      "reason.\n"
      "A model whose parameters cannot be guessed is not tested; the others are.\n"
      "Exit status: 0 no rule failed, 1 a rule failed, 2 the library or a value cannot be used, or "
      "a model\nwas not tested.\n"
      "Examples:\n"
      "  engine test-plugin build/my_drag.so\n"
      "  engine test-plugin build/my_contact.so --set stiffness='1000 N/m' --set restitution=0.5");
  command->callback([arguments, &status] {
    if (!std::filesystem::is_regular_file(arguments->file)) {
      throw base::UserError(arguments->file + ": error: no such file");
    }
    const auto entries = registry::load_library(std::filesystem::absolute(arguments->file));
    refuse_shipped_names(entries);
    std::vector<contract::Options> options(entries.size());
    for (contract::Options& o : options) o.allocations = allocations_so_far;
    for (const std::string& setting : arguments->settings) {
      read_setting(setting, entries, options);
    }
    Session session(arguments->as_json);
    for (std::size_t n = 0; n < entries.size(); ++n) session.test(entries[n], options[n]);
    session.print_end();
    status = session.status();
  });
}

}  // namespace dust::engine
