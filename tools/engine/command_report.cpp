// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "commands.hpp"
#include "io/report.hpp"

namespace dust::engine {

void add_report(CLI::App& app, int&) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "Write report.html of a run again");
  command->add_option("DIR", *folder, "Folder of the results")->required();
  command->footer("Example:\n  engine report results/transfer_point");
  command->callback([folder] {
    if (!std::filesystem::is_directory(*folder)) {
      throw base::UserError(*folder + ": error: no such folder");
    }
    io::write_report(*folder);
  });
}

}  // namespace dust::engine
