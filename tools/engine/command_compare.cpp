// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "commands.hpp"
#include "page_name.hpp"
#include "report/compare.hpp"

#include <cstdio>

namespace dust::engine {

void add_compare(CLI::App& app, int&) {
  struct Arguments {
    std::string first, second, page = "compare.html";
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("compare", "Show two runs side by side: a table here, a page beside it");
  command->add_option("DIR1", arguments->first, "Folder of the first run's results")->required();
  command->add_option("DIR2", arguments->second, "Folder of the second run's results")->required();
  command->add_option("-o", arguments->page, "The page to write")
      ->type_name("FILE.html")
      ->capture_default_str();
  command->footer(
      "Example:\n  engine compare results/transfer_point results/transfer_point-2 -o both.html");
  command->callback([arguments] {
    // Also of the name that nobody has given.
    if (const std::string problem = page_name_problem(arguments->page); !problem.empty()) {
      throw base::UserError("error: -o " + problem);
    }
    const auto comparison = report::compare_runs(arguments->first, arguments->second);
    report::write_comparison(comparison, arguments->first, arguments->second, arguments->page);
    std::fputs(report::comparison_text(comparison).c_str(), stdout);
    std::printf("page: %s\n", arguments->page.c_str());
  });
}

}  // namespace dust::engine
