// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "commands.hpp"
#include "report/report.hpp"

#include <iostream>

namespace dust::engine {

void add_report(CLI::App& app, int&) {
  struct Arguments {
    std::string folder, templates;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("report", "Write report.html of a run again");
  command->add_option("DIR", arguments->folder, "Folder of the results")->required();
  command
      ->add_option("--template", arguments->templates,
                   "Folder whose templates, styles, scripts and logo stand before the engine's own")
      ->type_name("DIR");
  command->footer("Example:\n  engine report results/transfer_point");
  command->callback([arguments] {
    if (!std::filesystem::is_directory(arguments->folder)) {
      throw base::UserError(arguments->folder + ": error: no such folder");
    }
    const auto missing =
        report::write_report(arguments->folder, report::Templates(arguments->templates));
    for (const std::string& note : missing) {
      std::cerr << "warning: " << arguments->folder << ": " << note << '\n';
    }
  });
}

}  // namespace dust::engine
