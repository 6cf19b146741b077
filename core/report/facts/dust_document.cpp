// SPDX-License-Identifier: Apache-2.0
#include "report/facts/dust_document.hpp"

#include "report/facts/dust_fractions.hpp"
#include "report/pictures/pictures.hpp"

namespace dust::report {

namespace {

using nlohmann::json;

/// Numbers that are negative where they are not known.
json known(double value) { return value >= 0.0 ? json(value) : json(nullptr); }

json amount_json(const Figure& figure) {
  if (figure.unit.empty()) return nullptr;
  json amount = {
      {"value", figure.value},
      {"uncertainty", figure.uncertainty > 0.0 ? json(figure.uncertainty) : json(nullptr)},
      {"unit", figure.unit}};
  if (!figure.no_error.empty()) amount["no_error"] = figure.no_error;
  return amount;
}

json figures_json(const std::vector<Figure>& figures) {
  json list = json::array();
  for (const Figure& figure : figures) {
    json entry = amount_json(figure);
    entry["sensor"] = figure.sensor;
    entry["name"] = figure.name;
    entry["diameter_m"] = known(figure.size_class());
    entry["towards"] = figure.towards;
    list.push_back(std::move(entry));
  }
  return list;
}

json fractions_json(const DustFractions& shares) {
  return {{"inhalable", shares.inhalable},
          {"thoracic", shares.thoracic},
          {"respirable", shares.respirable},
          {"pm10", shares.pm10}};
}

json class_json(const DustClass& entry) {
  json one = {{"diameter_m", entry.diameter},
              {"density", known(entry.density)},
              {"fed", known(entry.fed)},
              {"out", amount_json(entry.out)}};
  if (!(entry.density > 0.0)) return one;
  const double settling = aerodynamic_diameter(entry.diameter, entry.density);
  one["aerodynamic_diameter_m"] = settling;
  one["fractions"] = fractions_json(dust_fractions(settling));
  return one;
}

/// Of all that gets out; null where none does or a density is not known.
json fractions_of_all(const std::vector<DustClass>& classes) {
  DustFractions sum;
  double all = 0.0;
  for (const DustClass& entry : classes) {
    const double amount = entry.out.value;
    if (!(amount > 0.0)) continue;
    if (!(entry.density > 0.0)) return nullptr;
    const DustFractions shares =
        dust_fractions(aerodynamic_diameter(entry.diameter, entry.density));
    sum.inhalable += amount * shares.inhalable;
    sum.thoracic += amount * shares.thoracic;
    sum.respirable += amount * shares.respirable;
    sum.pm10 += amount * shares.pm10;
    all += amount;
  }
  if (!(all > 0.0)) return nullptr;
  return fractions_json(
      {sum.inhalable / all, sum.thoracic / all, sum.respirable / all, sum.pm10 / all});
}

json partings_json(const std::vector<Parting>& partings) {
  json list = json::array();
  for (const Parting& parting : partings) {
    list.push_back({{"x", parting.x},
                    {"z", parting.z},
                    {"side", k_parting_side},
                    {"share", parting.share},
                    {"share_error", parting.share_error},
                    {"amount", amount_json(parting.amount)}});
  }
  return list;
}

}  // namespace

json dust_json(const Highlights& highlights, const DustSizes& sizes) {
  if (!highlights.has_dust()) return nullptr;
  // The headline speaks of what gets out, or else of what passes most, or else of what is there.
  const bool has_openings = !highlights.openings.empty();
  const auto& list = has_openings              ? highlights.openings
                     : highlights.dust.empty() ? highlights.held
                                               : highlights.dust;
  json dust = {{"limit_m", sizes.limit()},
               {"spoken_of", has_openings              ? "openings"
                             : highlights.dust.empty() ? "stocks"
                                                       : "passages"},
               {"headline", amount_json(has_openings ? sum_of(list) : list.front())},
               {"openings", figures_json(highlights.openings)},
               {"passages", figures_json(highlights.dust)},
               {"stocks", figures_json(highlights.held)},
               {"fed", known(highlights.fed)},
               {"observed_s", known(highlights.observed_time)},
               {"counted", known(highlights.counted)},
               {"later_over_earlier", known(highlights.later_over_earlier)},
               {"fractions", fractions_of_all(highlights.classes)},
               {"partings", partings_json(highlights.partings)}};
  dust["classes"] = json::array();
  for (const DustClass& entry : highlights.classes) dust["classes"].push_back(class_json(entry));
  return dust;
}

json extraction_json(const Highlights& highlights) {
  if (highlights.places.empty()) return nullptr;
  json places = json::array();
  for (const LowPlace& place : highlights.places) {
    places.push_back({{"name", place.name},
                      {"x", place.x.value},
                      {"y", place.y.value},
                      {"z", place.z.value},
                      {"depth", amount_json(place.depth)},
                      {"dust_share", known(place.dust_share)}});
  }
  return {{"places", places}, {"first", first_place(highlights)}, {"reach_m", k_reach}};
}

}  // namespace dust::report
