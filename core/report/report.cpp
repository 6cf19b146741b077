// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include "report/run_document.hpp"

namespace dust::report {

std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const Templates& templates) {
  const nlohmann::json document = run_document(folder);
  constexpr auto k_replace = nlohmann::json::error_handler_t::replace;
  write_page(folder / "report.json", document.dump(-1, ' ', false, k_replace) + "\n");
  write_page(folder / "report.html", page_of(templates, "run.html", document));
  return document.at("notes").get<std::vector<std::string>>();
}

}  // namespace dust::report
