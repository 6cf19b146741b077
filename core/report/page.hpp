// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace dust::report {

/// Where templates, styles, scripts and the logo of a page come from: a folder of one's own first,
/// then what travels inside the library (tools/report).
class Templates {
 public:
  /// `own` may be empty; then $DUST_REPORT_TEMPLATE names the folder, if it is set. Throws
  /// base::UserError where a folder is named that is none.
  explicit Templates(const std::filesystem::path& own = {});

  /// The text of a file; throws base::UserError naming the file where there is none.
  [[nodiscard]] std::string text(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const;

 private:
  std::filesystem::path own_;
};

/// The page `name` (run.html) with `data` inside. In a template
///   {{file:NAME}}   stands for the text of another file,
///   {{packed:NAME}} for that text as a zlib stream in base64, which a script unpacks when needed,
///   {{image:NAME}}  for a picture as a data URI, {{image:logo}} for logo.svg or logo.png,
///   {{version}}     for the version of the engine,
///   {{data}}        for the data as JSON that may stand inside a script element.
[[nodiscard]] std::string page_of(const Templates& templates, const std::string& name,
                                  const nlohmann::json& data);

/// Replaces `target` by `text` as a whole; throws base::UserError when that is not possible.
void write_page(const std::filesystem::path& target, const std::string& text);

}  // namespace dust::report
