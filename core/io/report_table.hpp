// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dust::io {

/// A column of an HTML table. Numbers stand right.
struct TableColumn {
  std::string title;  ///< HTML
  bool is_number = true;
};

/// A table row by row. Cells are HTML: escape what comes from a run.
class HtmlTable {
 public:
  explicit HtmlTable(std::vector<TableColumn> columns, std::string css_class = {});

  /// The first cell of a row names it.
  void row(const std::vector<std::string>& cells, const std::string& css_class = {});
  /// A line over the whole width that opens a group of rows.
  void group(const std::string& title);

  [[nodiscard]] bool is_empty() const { return rows_.empty(); }
  /// The table in a box that scrolls sideways when the page is narrow; empty without rows.
  [[nodiscard]] std::string html() const;

 private:
  std::vector<TableColumn> columns_;
  std::string css_class_;
  std::string rows_;
};

/// A bar for a cell of css class "bar", `share` of the width from 0 to 1; empty for 0.
[[nodiscard]] std::string bar_html(double share, const char* css_class = "");

/// The same with an error bar of `error` to either side, in shares; no error bar where that is not
/// above 0.
[[nodiscard]] std::string error_bar_html(double share, double error, const char* css_class = "");

/// A figure of the first screen: name, value and a note below; all HTML.
[[nodiscard]] std::string tile_html(const std::string& name, const std::string& value,
                                    const std::string& note = {});

}  // namespace dust::io
