// SPDX-License-Identifier: Apache-2.0
#include "page_name.hpp"

#include <filesystem>
#include <fstream>

namespace dust::engine {
namespace {

namespace fs = std::filesystem;

/// By the line that all pages have near their begin (tools/report/head.html).
bool is_own_page(const fs::path& file) {
  constexpr std::size_t k_head = 2000;
  std::string head(k_head, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(R"(<meta name="generator" content="dust )") != std::string::npos;
}

bool is_report(const fs::path& file) {
  std::error_code none;
  const fs::path folder = file.parent_path();
  return file.filename() == "report.html" &&
         (fs::exists(folder / "summary.json", none) || fs::exists(folder / "study.csv", none));
}

}  // namespace

std::string page_name_problem(const std::string& name) {
  if (!name.ends_with(".html") && !name.ends_with(".htm")) {
    return name + ": a page is written; give it a name that ends with .html";
  }
  std::error_code none;
  if (!fs::exists(name, none)) return {};
  if (is_report(name)) return name + ": is the report of a run or a study; give another name";
  if (!is_own_page(name)) return name + ": exists and is no page of this engine; give another name";
  return {};
}

}  // namespace dust::engine
