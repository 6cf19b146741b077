// SPDX-License-Identifier: Apache-2.0
// Sections that sensors head themselves: what a sensor of somebody else shows stands together.
#include "io/report_sections.hpp"
#include "io/report_text.hpp"

namespace dust::io {

using nlohmann::json;

bool has_own_section(const RunText& run, const std::string& sensor) {
  for (const json& section : list_at(run.report, "sections")) {
    if (text_at(section, "sensor") == sensor) return true;
  }
  return false;
}

std::string plain_table_html(const json& table) {
  std::string text = "<div class=\"scroll\"><table><thead><tr>";
  for (const json& name : list_at(table, "columns")) {
    text +=
        "<th class=\"n\">" + escape_html(name.is_string() ? name.get<std::string>() : "") + "</th>";
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const json& cells : list_at(table, "rows")) {
    text += "<tr>";
    for (const json& cell : cells) {
      text += "<td class=\"n\">" +
              (cell.is_number()   ? number_html(cell.get<double>(), 5)
               : cell.is_string() ? escape_html(cell.get<std::string>())
                                  : std::string("\u2013")) +
              "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string own_sections_html(const RunText& run) {
  std::string text;
  for (const json& section : list_at(run.report, "sections")) {
    const std::string sensor = text_at(section, "sensor");
    text += "<section class=\"own\" id=\"own-" + escape_html(sensor) + "\"><h2>" +
            escape_html(text_at(section, "heading")) + "</h2>\n<p>" +
            escape_html(text_at(section, "text")) + "</p>\n<div class=\"grid\"></div>\n";
    for (const json& table : list_at(run.report, "tables")) {
      if (text_at(table, "sensor") != sensor || list_at(table, "rows").empty()) continue;
      text += "<h3>" + escape_html(text_at(table, "title")) + "</h3>\n" + plain_table_html(table);
    }
    text += "</section>\n";
  }
  return text;
}

}  // namespace dust::io
