// SPDX-License-Identifier: Apache-2.0
#include "io/report_names.hpp"
#include "io/report_page.hpp"
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::io {

namespace {

std::string status_html(const RunText& run) {
  const std::string status = text_at(run.summary, "status");
  const auto simulated = number_at(run.summary, "simulated_s");
  if (status.empty() || status == "finished") return {};
  std::string text = "<p class=\"banner\" role=\"status\"><strong>";
  text += status == "failed" ? "This run failed" : "This run was stopped before its end";
  if (simulated) text += " at " + number_html(*simulated) + "\u202fs of simulated time";
  text += ".</strong> Everything below is what it had reached. ";
  if (const auto reason = text_at(run.summary, "reason"); !reason.empty()) {
    text += escape_html(reason) + " ";
  }
  text += status == "failed"
              ? "The last good state is kept in <code>checkpoint.h5</code>, the cause "
                "stands at the end of <code>run.log</code>."
              : "<code>engine run scenario.yaml --resume</code> goes on from its "
                "checkpoint.";
  return text + "</p>\n";
}

/// The list the headline speaks of: what gets out, or else what passes, or else what is there.
const std::vector<Figure>& dust_told(const Highlights& highlights) {
  return !highlights.openings.empty() ? highlights.openings
         : !highlights.dust.empty()   ? highlights.dust
                                      : highlights.held;
}

Figure dust_headline(const Highlights& highlights) {
  const auto& list = dust_told(highlights);
  return highlights.openings.empty() ? list.front() : sum_of(list);
}

bool has_counted(const Highlights& highlights) {
  const auto& list = dust_told(highlights);
  return std::any_of(list.begin(), list.end(), [](const Figure& f) { return f.value != 0.0; });
}

/// A figure that stands beside a published number, as html.
struct Published {
  std::string name;
  std::string ours;
  std::string theirs;
};

/// What a run with references was made for: each figure once, with the first of its numbers.
std::vector<Published> published_figures(const RunText& run) {
  constexpr std::size_t k_most = 4;
  std::vector<Published> figures;
  std::vector<std::string> told;
  for (const nlohmann::json& entry : list_at(run.summary, "references")) {
    const auto ours = number_at(entry, "ours");
    const auto theirs = number_at(entry, "value");
    std::string name = text_at(entry, "quantity");
    if (!ours || !theirs || told.size() == k_most) continue;
    if (std::find(told.begin(), told.end(), name) != told.end()) continue;
    told.push_back(name);
    if (name.starts_with("sensors.")) name.erase(0, 8);
    std::replace(name.begin(), name.end(), '.', ' ');
    name = words(name);
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') {
      name[0] = static_cast<char>(name[0] - 'a' + 'A');
    }
    const std::string unit = text_at(entry, "unit");
    figures.push_back(
        {escape_html(name),
         quantity_html(*ours, number_at(entry, "our_uncertainty").value_or(-1.0), unit),
         quantity_html(*theirs, number_at(entry, "uncertainty").value_or(-1.0), unit)});
  }
  return figures;
}

std::string lede_html(const RunText& run, const Highlights& highlights) {
  std::string text;
  if (highlights.has_dust() && !has_counted(highlights)) {
    text = std::string("<strong>No dust has been counted") +
           (highlights.openings.empty() ? "" : " at the openings") + ".</strong>";
  } else if (highlights.has_dust()) {
    const Figure first = dust_headline(highlights);
    const bool is_small = first.value < 0.1;  // g/t
    const double factor = is_small ? 1e3 : 1.0;
    text = "<strong>" +
           value_html(first.value * factor,
                      first.uncertainty > 0.0 ? first.uncertainty * factor : -1.0) +
           "\u202f" + (is_small ? "mg" : "g") + " of dust per tonne</strong> of load ";
    text += highlights.openings.empty()
                ? "is found at " + place_html(highlights, dust_told(highlights).front())
                : std::string("get out");
    if (highlights.fed > 0.0) {
      const double share = 100.0 * first.value / highlights.fed;
      text += ", " +
              value_html(share,
                         first.uncertainty > 0.0 ? share * first.uncertainty / first.value : -1.0) +
              "\u202f% of the dust fed";
    }
    text += ".";
  }
  if (const auto figures = published_figures(run); text.empty() && !figures.empty()) {
    const Published& first = figures.front();
    text = first.name + " <strong>" + first.ours + "</strong>; published are " + first.theirs + ".";
  }
  if (text.empty()) {
    const auto emitted = number_at(object_at(run.summary, "particles"), "emitted");
    const auto simulated = number_at(run.summary, "simulated_s");
    if (emitted) {
      text += *emitted == 1.0 ? std::string("One grain was released")
                              : count_html(*emitted) + " grains were released";
    }
    if (emitted && simulated)
      text += " in " + number_html(*simulated) + "\u202fs of simulated time";
    if (emitted) text += ".";
  }
  return text.empty() ? text : "<p class=\"lede\">" + text + "</p>\n";
}

std::string answer(const char* question, const std::string& value, const std::string& lines) {
  return std::string("<section class=\"answer\"><h2>") + question + "</h2>\n<p class=\"value\">" +
         value + "</p>\n" + lines + "</section>\n";
}

std::string how_much(const Highlights& highlights) {
  const Figure sum = dust_headline(highlights);
  std::string text;
  if (highlights.fed > 0.0) {
    text += "<p>of " + quantity_html(highlights.fed, -1.0, "g/t") + " in the load</p>\n";
  }
  if (const auto shares = fractions_html(highlights); !shares.empty()) text += shares;
  const std::string value = sum.value == 0.0 ? std::string("none counted")
                                             : quantity_html(sum.value, sum.uncertainty, sum.unit);
  return answer("How much dust?", value, text);
}

std::string from_where(const Highlights& highlights) {
  constexpr std::size_t k_most = 4;
  const auto& list = dust_told(highlights);
  double largest = 0.0;
  for (const Figure& figure : list) largest = std::max(largest, figure.value);
  std::string rows;
  for (std::size_t k = 0; k < list.size() && k < k_most; ++k) {
    const Figure& figure = list[k];
    const std::string shown = figure.value == 0.0
                                  ? std::string("none")
                                  : quantity_html(figure.value, figure.uncertainty, figure.unit);
    rows += "<li><span>" + place_html(highlights, figure) + "</span> <span>" + shown + "</span>" +
            bar_html(largest > 0.0 ? figure.value / largest : 0.0, "dustbar") + "</li>\n";
  }
  if (list.size() > k_most) {
    rows += "<li><span><a href=\"#dust\">" + std::to_string(list.size() - k_most) +
            " more</a></span></li>\n";
  }
  std::string value = "nowhere yet";
  if (has_counted(highlights)) {
    const auto most =
        std::max_element(list.begin(), list.end(),
                         [](const Figure& a, const Figure& b) { return a.value < b.value; });
    value = place_html(highlights, *most);
  }
  std::string text = "<ul class=\"ranks\">\n" + rows + "</ul>\n";
  // Where it is on its way: the largest passage that is no opening and carries loose dust.
  for (const Figure& figure : highlights.dust) {
    if (highlights.openings.empty() || !has_part(figure.sensor, "carry") || figure.value == 0.0) {
      continue;
    }
    text += "<p>" + quantity_html(figure.value, figure.uncertainty, figure.unit) + " ride past " +
            place_html(highlights, figure) + "</p>\n";
    break;
  }
  if (!highlights.partings.empty()) {
    const Parting& first = highlights.partings.front();
    text += "<p><a href=\"#dust\">Parted from the load</a> most near x\u202f" +
            number_html(first.x * 1e3, 3) + ", z\u202f" + number_html(first.z * 1e3, 3) +
            "\u202fmm: " + value_html(100.0 * first.share, 100.0 * first.share_error) +
            "\u202f%</p>\n";
  }
  return answer("From where?", value, text);
}

std::string how_sure(const RunText& run, const Highlights& highlights) {
  const Figure sum = dust_headline(highlights);
  std::string value = "no estimate";
  std::string text;
  if (sum.uncertainty > 0.0 && sum.value > 0.0) {
    value = "\u00b1\u202f" + number_html(100.0 * sum.uncertainty / sum.value, 2) + "\u202f%";
    text += "<p>one standard error";
  } else {
    text += "<p>no standard error is known";
  }
  if (highlights.observed_time > 0.0) {
    text += ", from " + quantity_html(highlights.observed_time, -1.0, "s") + " after start-up";
    if (highlights.counted >= 0.0) {
      text += " and " + number_html(highlights.counted, 3) + " real grains";
    }
  }
  text += "</p>\n";
  constexpr double k_steady = 1.5;  // a factor between both halves that a short count may have
  const double change = highlights.later_over_earlier;
  if (change >= 0.0 && (change > k_steady || change < 1.0 / k_steady)) {
    text += "<p class=\"caution\">Still changing: the second half of that time brought " +
            number_html(change, 2) + " times the first.</p>\n";
  }
  const int touched = limits_touched(run);
  text += touched == 0
              ? std::string("<p><a href=\"#health\">No limit of validity touched</a></p>\n")
              : "<p class=\"caution\"><a href=\"#health\">" + std::to_string(touched) +
                    (touched == 1 ? " limit" : " limits") + " of validity touched</a></p>\n";
  return answer("How sure?", value, text);
}

std::string where_to_extract(const Highlights& highlights) {
  const int first = first_place(highlights);
  if (first < 0) return {};
  const LowPlace& best = highlights.places[static_cast<std::size_t>(first)];
  const auto mm = [](const Figure& figure) { return number_html(figure.value * 1e3, 3); };
  const std::string value =
      "x\u202f" + mm(best.x) + ", z\u202f" + mm(best.z) + "\u202f<span class=\"unit\">mm</span>";
  std::string text = "<p>" + depth_html(best) + " in the mean";
  if (best.dust_share > 0.0) {
    text += "; " + number_html(100.0 * best.dust_share, 2) + "\u202f% of the dust lies within " +
            quantity_html(k_reach, -1.0, "m");
  }
  text += "</p>\n<p>Low pressure next:</p><ul class=\"ranks\">\n";
  int shown = 0;
  for (std::size_t k = 0; k < highlights.places.size() && shown < 2; ++k) {
    if (static_cast<int>(k) == first) continue;
    const LowPlace& place = highlights.places[k];
    text += "<li><span>x\u202f" + mm(place.x) + ", z\u202f" + mm(place.z) +
            "\u202fmm</span> <span>" + depth_html(place) + "</span></li>\n";
    ++shown;
  }
  return answer("Where to extract?", value, text + "</ul>\n");
}

std::string reference_tiles(const RunText& run) {
  std::string text;
  for (const Published& p : published_figures(run)) {
    text += tile_html(p.name.c_str(), p.ours, "published " + p.theirs);
  }
  return text;
}

std::string tiles_html(const RunText& run, const Highlights& highlights) {
  std::string text = reference_tiles(run);
  if (!highlights.stream.empty()) {
    const StreamDrop& last = highlights.stream.back();
    text += tile_html("Stream, median",
                      quantity_html(last.median.value, last.median.uncertainty, last.median.unit),
                      "forward at " + quantity_html(last.drop, -1.0, "m") + " drop");
  }
  const auto& grains = object_at(run.summary, "particles");
  if (const auto emitted = number_at(grains, "emitted")) {
    const auto real = number_at(object_at(run.summary, "real_particles"), "emitted");
    text += tile_html(
        "Grains released", count_html(*emitted),
        real && *real != *emitted ? "for " + count_html(std::round(*real)) + " real ones" : "");
  }
  if (const auto mass = number_at(object_at(run.summary, "mass_kg"), "emitted")) {
    text += tile_html("Load released", quantity_html(*mass, -1.0, "kg"), "");
  }
  const auto wall = number_at(run.summary, "wall_s");
  const auto simulated = number_at(run.summary, "simulated_s");
  if (wall) {
    text += tile_html("Computing time", duration_html(*wall),
                      simulated ? "for " + number_html(*simulated, 3) + "\u202fs simulated" : "");
  }
  return text.empty() ? text : "<dl class=\"tiles\">\n" + text + "</dl>\n";
}

}  // namespace

std::string run_title(const RunText& run) {
  std::string title = text_at(run.report, "title");
  const std::string scenario = text_at(run.summary, "scenario");
  // The title is the scenario's name unless someone gave a better one.
  if (title.empty() || title == scenario) title = words(scenario);
  if (title.empty()) title = "Run";
  if (title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
  return title;
}

std::string header_html(const RunText& run, const Highlights& highlights) {
  std::string answers;
  if (highlights.has_dust()) {
    answers += how_much(highlights) + from_where(highlights) + how_sure(run, highlights);
  }
  answers += where_to_extract(highlights);
  if (!answers.empty()) answers = "<div class=\"answers\">\n" + answers + "</div>\n";
  return "<header>\n" +
         heading_html("Run report", text_at(run.summary, "scenario"),
                      text_at(run.summary, "status"), run_title(run)) +
         status_html(run) + lede_html(run, highlights) + answers + tiles_html(run, highlights) +
         "</header>\n";
}

}  // namespace dust::io
