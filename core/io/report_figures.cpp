// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::io {

using nlohmann::json;

std::string figures_html(const RunText& run) {
  std::string text;
  for (std::size_t k = 0; k < run.figures.size();) {
    const std::string& sensor = run.figures[k].sensor;
    std::string rows;
    std::size_t count = 0;
    for (; k < run.figures.size() && run.figures[k].sensor == sensor; ++k, ++count) {
      const Figure& figure = run.figures[k];
      const std::string plain =
          std::isfinite(figure.value) ? base::digits_text(figure.value, 9) : std::string();
      rows += "<tr><td>" + escape_html(words(figure.name)) + "</td><td class=\"n\">" +
              quantity_html(figure.value, figure.uncertainty, figure.unit) +
              "</td><td class=\"n raw\">" + plain +
              (figure.unit == "1" || figure.unit == "-" ? "" : " " + escape_html(figure.unit)) +
              "</td></tr>\n";
    }
    text += "<details><summary>" + escape_html(words(sensor)) + " <small>" + std::to_string(count) +
            (count == 1 ? " figure" : " figures") +
            "</small></summary><div class=\"scroll\"><table><thead><tr><th>Quantity</th><th "
            "class=\"n\">Value \u00b1 standard error</th><th class=\"n\">SI "
            "value</th></tr></thead>\n<tbody>\n" +
            rows + "</tbody></table></div></details>\n";
  }
  for (const json& table : list_at(run.report, "tables")) {
    if (list_at(table, "rows").empty() || has_own_section(run, text_at(table, "sensor"))) continue;
    text += "<details><summary>" + escape_html(text_at(table, "title")) + " <small>table of " +
            escape_html(words(text_at(table, "sensor"))) + "</small></summary>" +
            plain_table_html(table) + "</details>\n";
  }
  if (text.empty()) return text;
  return "<section id=\"figures\"><h2>All figures</h2>\n<p>Every sensor's figures of this run. The "
         "error is "
         "one standard error; where none stands, the sensor makes no estimate.</p>\n" +
         text + "</section>\n";
}

}  // namespace dust::io
