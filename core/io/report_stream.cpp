// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

namespace dust::io {

std::string depth_html(const LowPlace& place) {
  if (place.depth.uncertainty > 0.0) {
    return quantity_html(-place.depth.value, place.depth.uncertainty, place.depth.unit);
  }
  return number_html(-place.depth.value, 3) + "\u202f" + escape_html(place.depth.unit);
}

std::string extraction_html(const Highlights& highlights, bool has_air, bool has_dust_map) {
  if (highlights.places.empty()) return {};
  const int first = first_place(highlights);
  bool has_shares = false;
  for (const LowPlace& place : highlights.places)
    has_shares = has_shares || place.dust_share >= 0.0;
  std::vector<TableColumn> columns{{"Ring", false}, {"x"}, {"z"}, {"Mean pressure"}};
  if (has_shares) columns.push_back({"Dust within " + quantity_html(k_reach, -1.0, "m")});
  columns.push_back({"", false});
  HtmlTable table(columns, "narrow");
  for (std::size_t k = 0; k < highlights.places.size(); ++k) {
    const LowPlace& place = highlights.places[k];
    std::vector<std::string> cells{
        escape_html(place.name), number_html(place.x.value * 1e3, 3) + "\u202fmm",
        number_html(place.z.value * 1e3, 3) + "\u202fmm", depth_html(place)};
    if (has_shares) {
      cells.push_back(place.dust_share >= 0.0 ? number_html(100.0 * place.dust_share, 2) + "\u202f%"
                                              : std::string("\u2013"));
    }
    cells.emplace_back(static_cast<int>(k) == first && place.dust_share > 0.0
                           ? "<strong>extract here first</strong>"
                           : "");
    table.row(cells);
  }
  std::string maps;
  if (has_air) {
    maps +=
        "<figure><div class=\"picture\" id=\"mean-pressure-picture\"></div><div "
        "id=\"mean-pressure-legend\" class=\"key\"></div><figcaption><b>Mean pressure</b> over "
        "the second half of the run, in Pa. Rings: places of low mean pressure, the deepest is "
        "1.</figcaption></figure>\n";
  }
  if (has_dust_map) {
    maps +=
        "<figure><div class=\"picture\" id=\"dust-map-picture\"></div><div "
        "id=\"dust-map-legend\" class=\"key\"></div><figcaption><b>Where the dust is</b>, mean "
        "over the frames of the second half of the run: share of the dust in the domain per "
        "cm\u00b2 of the side view, logarithmic." +
        std::string(
            highlights.partings.empty()
                ? ""
                : " Squares: where it parted from the load, in per cent of the loose dust.") +
        "</figcaption></figure>\n";
  }
  if (!maps.empty()) maps = "<div class=\"pair\">\n" + maps + "</div>\n";
  return "<section id=\"extraction\"><h2>Where to extract</h2>\n<p>Suction works with the flow "
         "where "
         "the pressure is low on its own, and removes most where dust lingers. Ranked by mean "
         "pressure; extract first where, among places surely below zero, most dust is near.</p>\n" +
         table.html() +
         "<p class=\"note\">Mean pressure with one standard error, over the sensor's averaging "
         "time "
         "and depth. Dust riding on a surface near by counts as near.</p>\n" +
         maps + "</section>\n";
}

std::string stream_html(const Highlights& highlights) {
  // Curves alone may fill the section: the page's script shows it then.
  std::string text = std::string("<section id=\"stream\"") +
                     (highlights.stream.empty() ? " hidden" : "") +
                     "><h2>The path of the stream</h2>\n<div id=\"stream-picture\"></div>\n";
  if (highlights.stream.empty()) return text + "</section>\n";
  HtmlTable table({{"Drop"}, {"5\u202f%"}, {"Median"}, {"95\u202f%"}}, "tight");
  const auto cell = [](const Figure& figure) {
    return figure.name.empty() ? std::string("\u2013")
                               : quantity_html(figure.value, figure.uncertainty, figure.unit);
  };
  for (const StreamDrop& drop : highlights.stream) {
    table.row(
        {quantity_html(drop.drop, -1.0, "m"), cell(drop.low), cell(drop.median), cell(drop.high)});
  }
  return text + table.html() + "</section>\n";
}

}  // namespace dust::io
