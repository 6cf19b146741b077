// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <cmath>

namespace dust::io {

namespace {

using nlohmann::json;

std::string number_of(const json& entry, const char* key, const char* error_key) {
  const auto value = number_at(entry, key);
  if (!value) return "\u2013";
  return quantity_html(*value, number_at(entry, error_key).value_or(-1.0), text_at(entry, "unit"));
}

}  // namespace

/// summary.json "references": [{"quantity", "unit", "ours", "our_uncertainty", "value",
/// "uncertainty", "source"}].
std::string references_html(const RunText& run) {
  HtmlTable table({{"Quantity", false},
                   {"This run"},
                   {"Published"},
                   {"Difference"},
                   {"In standard errors"},
                   {"Source", false}});
  for (const json& entry : list_at(run.summary, "references")) {
    const auto ours = number_at(entry, "ours");
    const auto theirs = number_at(entry, "value");
    std::string difference = "\u2013", sigmas = "\u2013";
    if (ours && theirs && *theirs != 0.0) {
      difference = number_html(100.0 * (*ours - *theirs) / std::abs(*theirs), 2) + "\u202f%";
    }
    // Without theirs the errors of the difference are not known: ours alone would make much of it.
    const auto their_error = number_at(entry, "uncertainty");
    const double error =
        std::hypot(number_at(entry, "our_uncertainty").value_or(0.0), their_error.value_or(0.0));
    if (ours && theirs && their_error && error > 0.0)
      sigmas = number_html((*ours - *theirs) / error, 2);
    std::string name = text_at(entry, "quantity");
    if (name.starts_with("sensors.")) name.erase(0, 8);
    if (const auto dot = name.find('.'); dot != std::string::npos) name[dot] = '/';
    table.row({escape_html(words(name)), number_of(entry, "ours", "our_uncertainty"),
               number_of(entry, "value", "uncertainty"), difference, sigmas,
               escape_html(text_at(entry, "source"))});
  }
  if (table.is_empty()) return {};
  return "<section id=\"references\"><h2>Beside published numbers</h2>\n" + table.html() +
         "</section>\n";
}

}  // namespace dust::io
