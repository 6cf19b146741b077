// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::io {

namespace {

using nlohmann::json;

constexpr double k_closure = 1e-9;  ///< relative; round-off of sums of 1e6 to 1e7 masses in double

/// One line of the balance; `closes` turns false when emitted differs from the sum of the parts.
std::string balance_row(const char* name, const json& parts, bool is_exact, const char* unit,
                        bool& closes) {
  const auto emitted = number_at(parts, "emitted");
  if (!emitted) return {};
  const auto part = [&](const char* key) { return number_at(parts, key).value_or(0.0); };
  const double difference = *emitted - part("in_domain") - part("left") - part("removed");
  const double scale = std::max(std::abs(*emitted), 1e-300);
  const bool is_closed = is_exact ? difference == 0.0 : std::abs(difference) <= k_closure * scale;
  closes = closes && is_closed;
  const auto cell = [&](double value) {
    const std::string shown = *unit != '\0' ? quantity_html(value, -1.0, unit)
                              // Weights of rare grains leave fractions; nobody counts those.
                              : value == std::round(value) || std::abs(value) > 1e3
                                  ? count_html(std::round(value))
                                  : number_html(value, 4);
    return "<td class=\"n\">" + shown + "</td>";
  };
  return std::string("<tr><th scope=\"row\">") + name + "</th>" + cell(*emitted) +
         cell(part("in_domain")) + cell(part("left")) + cell(part("removed")) + "<td class=\"n" +
         (is_closed ? "" : " wrong") + "\">" +
         (*unit != '\0' && difference != 0.0
              ? number_html(difference / scale, 2) + "\u202fof it"  // round-off says little in kg
              : number_html(difference, 2)) +
         "</td></tr>\n";
}

/// What became of each size class; empty for runs without these books.
std::string classes_html(const RunText& run) {
  std::string rows;
  for (const json& entry : list_at(run.summary, "size_classes")) {
    const json& mass = object_at(entry, "mass_kg");
    const auto emitted = number_at(mass, "emitted");
    const auto diameter = number_at(entry, "diameter_m");
    if (!emitted || !diameter) continue;
    rows += "<tr><th scope=\"row\">" + quantity_html(*diameter, -1.0, "m") + "</th>";
    for (const char* part : {"emitted", "in_domain", "left", "removed"}) {
      rows += "<td class=\"n\">" + quantity_html(number_at(mass, part).value_or(0.0), -1.0, "kg") +
              "</td>";
    }
    rows += "</tr>\n";
  }
  if (rows.empty()) return rows;
  return "<div class=\"scroll\"><table><thead><tr><th>Mass by diameter</th><th "
         "class=\"n\">Released</th><th class=\"n\">In domain</th><th class=\"n\">Left</th><th "
         "class=\"n\">Removed</th></tr></thead>\n<tbody>" +
         rows + "</tbody></table></div>\n";
}

std::string mass_bar(const json& mass) {
  const double emitted = number_at(mass, "emitted").value_or(0.0);
  if (!(emitted > 0.0)) return {};
  std::string bar, legend;
  int tone = 0;
  for (const auto& [key, name] :
       std::array{std::pair{"in_domain", "still in the domain"},
                  std::pair{"left", "left through a boundary"}, std::pair{"removed", "removed"}}) {
    const double share = number_at(mass, key).value_or(0.0) / emitted;
    ++tone;
    if (!(share > 0.0)) continue;
    const std::string mark = "tone" + std::to_string(tone);
    bar += "<i class=\"" + mark + "\" style=\"width:" + percent_of_whole(share) + "%\"></i>";
    legend += "<span><i class=\"" + mark + "\"></i>" + name + " " + percent_of_whole(share) +
              "\u202f%</span>";
  }
  return "<div class=\"stack\" role=\"img\" aria-label=\"Shares of the mass released\">" + bar +
         "</div><p class=\"legend\">" + legend + "</p>\n";
}

}  // namespace

std::string balance_html(const RunText& run) {
  bool closes = true;
  std::string rows;
  rows += balance_row("Computed grains", object_at(run.summary, "particles"), true, "", closes);
  rows += balance_row("Real grains", object_at(run.summary, "real_particles"), false, "", closes);
  rows += balance_row("Mass", object_at(run.summary, "mass_kg"), false, "kg", closes);
  if (rows.empty()) return {};
  std::string text = "<section id=\"balance\"><h2>Mass balance</h2>\n<p>";
  text +=
      closes
          ? "<strong class=\"good\">The balance closes.</strong> Every grain released is still in "
            "the domain, has left through a boundary or was removed, in numbers exactly and in "
            "mass to round-off."
          : "<strong class=\"wrong\">The balance does not close.</strong> What was released "
            "differs from what is in the domain, left and was removed: trust no figure of this "
            "run before the cause is known.";
  text += "</p>\n" + mass_bar(object_at(run.summary, "mass_kg"));
  text +=
      "<div class=\"scroll\"><table><thead><tr><th></th><th class=\"n\">Released</th><th "
      "class=\"n\">In "
      "domain</th><th class=\"n\">Left</th><th class=\"n\">Removed</th><th "
      "class=\"n\">Difference</th></tr></thead>\n<tbody>" +
      rows + "</tbody></table></div>\n";
  text += classes_html(run);
  if (const auto most = number_at(object_at(run.summary, "particles"), "max")) {
    text += "<p class=\"note\">At most " + count_html(*most) +
            (*most == 1.0 ? " computed grain was" : " computed grains were") +
            " in the domain at one time. A real grain counts with the statistical "
            "weight of the computed grains that stand for it.</p>\n";
  }
  return text + "</section>\n";
}

}  // namespace dust::io
