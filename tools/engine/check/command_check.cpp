// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "check/check_summary.hpp"
#include "check/setup_page.hpp"
#include "check/setup_picture.hpp"
#include "commands.hpp"
#include "page_name.hpp"
#include "preflight/body_survey.hpp"
#include "preflight/derived.hpp"
#include "preflight/learnt_costs.hpp"
#include "preflight/reader.hpp"
#include "preflight/steady_check.hpp"
#include "run/branch/preview.hpp"
#include "run/insertion/rehearsal.hpp"
#include "scenario/diagnostics.hpp"

#include <filesystem>
#include <iostream>

namespace dust::engine {

namespace {

bool is_picture(const std::string& name) { return name.ends_with(".svg"); }

std::string output_problem(const std::string& name) {
  return is_picture(name) ? picture_name_problem(name) : page_name_problem(name);
}

void warn_of_memory(const std::filesystem::path& scenario, const preflight::RunCost& expected) {
  const std::string shortage = preflight::memory_shortage(expected);
  if (!shortage.empty()) std::cerr << scenario.string() << ": warning: " << shortage << '\n';
}

}  // namespace

void add_check(CLI::App& app, int&) {
  struct Arguments {
    ScenarioArguments scenario;
    std::string page;
    bool as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Check a scenario and tell what it will do; runs nothing, writes nothing but -o");
  arguments->scenario.add_to(*command);
  command
      ->add_option("-o,--output", arguments->page,
                   "The page of the set-up: from the side and in three dimensions; SETUP.svg: a "
                   "picture from the side alone")
      ->type_name("SETUP.html")
      ->check(output_problem);
  command->add_flag("--json", arguments->as_json, "Steps, sizes and cost as JSON");
  command->footer(
      "Examples:\n"
      "  engine check scenarios/transfer_point.yaml\n"
      "  engine check scenarios/transfer_point.yaml -o setup.html "
      "--set bodies.plate.enabled=true");
  command->callback([arguments] {
    const run::RunOptions options = arguments->scenario.options();
    const auto registry = load_plugins(arguments->scenario.plugin_path());
    const auto result =
        preflight::read_scenario(options.scenario, options.overrides, *registry, options.set_files);
    scenario::Diagnostics branching;
    const auto start = run::preview_start(result, *registry, branching);
    for (const std::string& warning : result.warnings) std::cerr << warning << '\n';
    for (const std::string& warning : branching.warning_lines()) std::cerr << warning << '\n';
    branching.throw_errors();
    const double begin = start ? start->time : 0.0;
    const auto derived = preflight::derive(result.setup, *registry, result.dust, begin);
    run::rehearse_placing(result.setup, *registry, derived, begin);
    const auto survey = preflight::survey_bodies(result.setup, *registry);
    scenario::Diagnostics further;
    preflight::check_crossings(survey, further);
    if (!start) preflight::check_steady(result.setup, result.dust, *registry, derived, further);
    for (const std::string& warning : further.warning_lines()) std::cerr << warning << '\n';
    const auto learnt = preflight::LearntCosts().expect(result.setup.name, derived.cost);
    warn_of_memory(options.scenario, learnt.cost);
    std::cout << (arguments->as_json ? check_json : check_summary)(result.setup, result.dust,
                                                                   derived, survey, learnt);
    if (start && !arguments->as_json) {
      std::cout << "  start      from " << start->state << " at "
                << base::digits_text(start->time, 6) << " s with " << start->particles << " grains"
                << (start->is_same ? ", the same scenario: with the bits of an unbroken run" : "")
                << '\n';
    }
    if (!arguments->page.empty()) {
      const std::string numbers = check_json(result.setup, result.dust, derived, survey, learnt);
      write_file(arguments->page, is_picture(arguments->page)
                                      ? setup_picture(result.setup, result.dust, *registry, derived)
                                      : setup_page(result.setup, result.dust, *registry, numbers));
      if (!arguments->as_json) std::cout << "drawn in " << arguments->page << '\n';
    }
  });
}

}  // namespace dust::engine
