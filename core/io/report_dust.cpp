// SPDX-License-Identifier: Apache-2.0
#include "io/dust_fractions.hpp"
#include "io/report_names.hpp"
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>

namespace dust::io {

namespace {

std::string amount_html(const Figure& figure) {
  return figure.value == 0.0 ? std::string("none counted")
                             : quantity_html(figure.value, figure.uncertainty, figure.unit);
}

/// By place: what gets out, what passes, what is there at the end.
std::string by_place(const Highlights& highlights) {
  double largest = highlights.fed;
  for (const auto* list : {&highlights.openings, &highlights.dust, &highlights.held}) {
    for (const Figure& figure : *list) {
      largest = std::max(largest, std::abs(figure.value) + std::max(figure.uncertainty, 0.0));
    }
  }
  HtmlTable table({{"By place", false},
                   {"Per tonne of load \u00b1 standard error"},
                   {"Share of the dust fed"},
                   {"", false}},
                  "bars");
  const auto share_of_bar = [&](double value) {
    return largest > 0.0 ? std::max(value, 0.0) / largest : 0.0;
  };
  if (highlights.fed > 0.0) {
    table.row({"In the load", quantity_html(highlights.fed, -1.0, "g/t"),
               share_html(highlights.fed, highlights.fed),
               bar_html(share_of_bar(highlights.fed), "fed")});
  }
  const auto group = [&](const char* title, const std::vector<Figure>& list) {
    if (list.empty()) return;
    table.group(title);
    for (const Figure& figure : list) {
      table.row({place_html(highlights, figure), amount_html(figure),
                 share_html(figure.value, highlights.fed),
                 error_bar_html(share_of_bar(figure.value), share_of_bar(figure.uncertainty),
                                "dustbar")});
    }
  };
  group("Gets out", highlights.openings);
  group("Passes", highlights.dust);
  group("Is there at the end", highlights.held);
  return table.html() +
         "<p class=\"note\">Grains finer than 100\u202f\u00b5m. What passes is counted per tonne "
         "released in the same time, after the sensor's start-up; what is there at the end, per "
         "tonne released until then. The same dust may pass several sensors: shares need not add "
         "up to the whole.</p>\n";
}

std::string percent_html(double share) {
  return share > 0.0 && share < 1e-4 ? "&lt;\u202f0.01\u202f%"
                                     : number_html(100.0 * share, 2) + "\u202f%";
}

/// By size class, with what a sampler would take in of it.
std::string by_class(const Highlights& highlights) {
  if (highlights.classes.empty()) return {};
  HtmlTable table({{"By size"},
                   {"In the load"},
                   {"Gets out \u00b1 standard error"},
                   {"Aerodynamic diameter"},
                   {"Inhalable"},
                   {"Thoracic"},
                   {"Respirable"},
                   {"PM10"},
                   {"Gets out", false}},
                  "bars");
  double largest = 0.0;
  for (const DustClass& entry : highlights.classes) {
    largest =
        std::max({largest, entry.fed, entry.out.value + std::max(entry.out.uncertainty, 0.0)});
  }
  const std::string none = "\u2013";
  for (const DustClass& entry : highlights.classes) {
    std::vector<std::string> cells{quantity_html(entry.diameter, -1.0, "m"),
                                   entry.fed >= 0.0 ? quantity_html(entry.fed, -1.0, "g/t") : none,
                                   entry.out.unit.empty() ? none : amount_html(entry.out)};
    if (entry.density > 0.0) {
      const double settling = aerodynamic_diameter(entry.diameter, entry.density);
      const DustFractions shares = dust_fractions(settling);
      cells.push_back(number_html(settling * 1e6, 3) + "\u202f\u00b5m");
      for (const double share :
           {shares.inhalable, shares.thoracic, shares.respirable, shares.pm10}) {
        cells.push_back(percent_html(share));
      }
    } else {
      cells.insert(cells.end(), 5, none);
    }
    const double scale = largest > 0.0 ? 1.0 / largest : 0.0;
    cells.push_back(
        error_bar_html(scale * entry.out.value, scale * entry.out.uncertainty, "dustbar"));
    table.row(cells);
  }
  return table.html() +
         "<p class=\"note\">Inhalable, thoracic and respirable: the share of the mass a sampler "
         "takes in after EN\u202f481:1993, by aerodynamic diameter (that of a sphere of "
         "1000\u202fkg/m\u00b3 settling as fast, here <i>d</i>\u202f(\u03c1/1000)<sup>1/2</sup>); "
         "PM10: all grains up to 10\u202f\u00b5m aerodynamic diameter. The shares belong to the "
         "size classes of the run: a class stands for one size, so a class astride a limit falls "
         "on one side of it. The whole width of the bar is the largest amount in the load.</p>\n";
}

/// By the place where dust parted from the coarse grains.
std::string by_origin(const Highlights& highlights) {
  constexpr std::size_t k_most = 8;
  HtmlTable table({{"By where it came from", false},
                   {"Per tonne of load \u00b1 standard error"},
                   {"Share of the loose dust"},
                   {"", false}},
                  "bars");
  const auto range = [](double middle) {
    const double low = (middle - 0.5 * k_parting_side) * 1e3;
    const double high = (middle + 0.5 * k_parting_side) * 1e3;
    return number_html(low, 4) + " to " + number_html(high, 4);
  };
  double rest = 0.0;
  for (std::size_t k = 0; k < highlights.partings.size(); ++k) {
    const Parting& parting = highlights.partings[k];
    if (k >= k_most) {
      rest += parting.share;
      continue;
    }
    table.row({"x\u202f" + range(parting.x) + ", z\u202f" + range(parting.z) + "\u202fmm",
               parting.amount.unit.empty()
                   ? std::string("\u2013")
                   : quantity_html(parting.amount.value, parting.amount.uncertainty, "g/t"),
               value_html(100.0 * parting.share, 100.0 * parting.share_error) + "\u202f%",
               error_bar_html(parting.share, parting.share_error, "dustbar")});
  }
  if (rest > 0.0) {
    table.row({std::to_string(highlights.partings.size() - k_most) + " other places", "\u2013",
               number_html(100.0 * rest, 2) + "\u202f%", bar_html(rest, "dustbar")});
  }
  if (table.is_empty()) return {};
  return table.html() +
         "<p class=\"note\">Where dust that is away from the coarse grains when last seen was last "
         "within two diameters of one, in squares of the side view; all of it, whether it got out, "
         "rides on a surface or hangs in the air. As fine as the frames of the run. Errors are "
         "those of counting.</p>\n";
}

}  // namespace

std::string share_html(double value, double whole) {
  return whole > 0.0 ? number_html(100.0 * value / whole, 2) + "\u202f%" : std::string("\u2013");
}

std::string fractions_html(const Highlights& highlights) {
  DustFractions sum;
  double all = 0.0;
  for (const DustClass& entry : highlights.classes) {
    const double amount = entry.out.value;
    if (!(amount > 0.0)) continue;
    if (!(entry.density > 0.0)) return {};
    const DustFractions shares =
        dust_fractions(aerodynamic_diameter(entry.diameter, entry.density));
    sum.inhalable += amount * shares.inhalable;
    sum.thoracic += amount * shares.thoracic;
    sum.respirable += amount * shares.respirable;
    sum.pm10 += amount * shares.pm10;
    all += amount;
  }
  if (!(all > 0.0)) return {};
  return "<p>of that " + percent_html(sum.inhalable / all) + " inhalable, " +
         percent_html(sum.thoracic / all) + " thoracic, " + percent_html(sum.respirable / all) +
         " respirable (<abbr title=\"EN 481:1993, by aerodynamic diameter\">EN\u202f481</abbr>); "
         "PM10 " +
         percent_html(sum.pm10 / all) + "</p>\n";
}

std::string result_html(const Highlights& highlights) {
  if (!highlights.has_dust()) return {};
  return "<section id=\"dust\"><h2>Where the dust goes</h2>\n" + by_place(highlights) +
         by_origin(highlights) + by_class(highlights) + "</section>\n";
}

}  // namespace dust::io
