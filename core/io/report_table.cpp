// SPDX-License-Identifier: Apache-2.0
#include "io/report_table.hpp"

#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>

namespace dust::io {

namespace {
constexpr const char* k_error_bar = "<span class=\"errorbar\">";
}

HtmlTable::HtmlTable(std::vector<TableColumn> columns, std::string css_class)
    : columns_(std::move(columns)), css_class_(std::move(css_class)) {}

void HtmlTable::row(const std::vector<std::string>& cells, const std::string& css_class) {
  rows_ += css_class.empty() ? std::string("<tr>") : "<tr class=\"" + css_class + "\">";
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const std::string text = k < cells.size() ? cells[k] : std::string();
    const char* place = columns_[k].is_number ? " class=\"n\"" : "";
    if (k == 0) {
      rows_ += std::string("<th scope=\"row\"") + place + ">" + text + "</th>";
    } else if (text.starts_with("<i class=\"bar") || text.starts_with(k_error_bar)) {
      rows_ += "<td class=\"bar\">" + text + "</td>";
    } else {
      rows_ += std::string("<td") + place + ">" + text + "</td>";
    }
  }
  rows_ += "</tr>\n";
}

void HtmlTable::group(const std::string& title) {
  rows_ += "<tr class=\"group\"><th colspan=\"" + std::to_string(columns_.size()) +
           "\" scope=\"rowgroup\">" + title + "</th></tr>\n";
}

std::string HtmlTable::html() const {
  if (rows_.empty()) return {};
  std::string text = "<div class=\"scroll\" tabindex=\"0\"><table" +
                     (css_class_.empty() ? std::string() : " class=\"" + css_class_ + "\"") +
                     "><thead><tr>";
  for (const TableColumn& column : columns_) {
    text += std::string("<th scope=\"col\"") + (column.is_number ? " class=\"n\">" : ">") +
            column.title + "</th>";
  }
  return text + "</tr></thead>\n<tbody>\n" + rows_ + "</tbody></table></div>\n";
}

std::string bar_html(double share, const char* css_class) {
  if (!(share > 0.0)) return {};
  return std::string("<i class=\"bar ") + css_class +
         "\" style=\"width:" + percent_of_whole(share) + "%\"></i>";
}

std::string error_bar_html(double share, double error, const char* css_class) {
  const std::string bar = bar_html(share, css_class);
  if (bar.empty() || !(error > 0.0)) return bar;
  const double low = std::max(share - error, 0.0), high = std::min(share + error, 1.0);
  return k_error_bar + bar + "<s style=\"left:" + percent_of_whole(low) +
         "%;width:" + percent_of_whole(high - low) + "%\"></s></span>";
}

std::string tile_html(const std::string& name, const std::string& value, const std::string& note) {
  return "<div class=\"tile\"><dt>" + name + "</dt><dd><b>" + value + "</b>" +
         (note.empty() ? "" : "<span>" + note + "</span>") + "</dd></div>\n";
}

}  // namespace dust::io
