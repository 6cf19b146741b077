// SPDX-License-Identifier: Apache-2.0
#include "run/summary/figure_json.hpp"

#include "run/summary/series_row.hpp"

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json role_json(const sdk::FigureRole& role) {
  Json json = {{"role", sdk::name_of(role.role)}};
  const auto quantity = sdk::info_of(role.quantity).name;
  if (!quantity.empty()) json["quantity"] = quantity;
  if (role.direction != sdk::Direction::none) json["direction"] = sdk::name_of(role.direction);
  if (role.smallest > 0.0 || role.largest > 0.0) {
    json["diameters_m"] = {role.smallest, role.largest > 0.0 ? Json(role.largest) : Json(nullptr)};
  }
  if (!role.species.empty()) json["species"] = role.species;
  if (!role.towards.empty()) json["towards"] = role.towards;
  if (role.probability > 0.0) json["probability"] = role.probability;
  if (role.role == sdk::Role::stream_quantile) json["drop_m"] = role.drop;
  if (role.index > 0) json["index"] = role.index;
  return json;
}

Json series_roles(const Simulation& s) {
  Json roles = Json::object();
  for_series_columns(s, [&](const std::string& name, double, sdk::RowValue,
                            const sdk::FigureRole& role) { roles[name] = role_json(role); });
  return roles;
}

Json series_metadata(const Simulation& s) {
  Json columns = Json::array();
  for_series_columns(
      s, [&](const std::string& name, double, sdk::RowValue kind, const sdk::FigureRole& role) {
        columns.push_back({{"titles", name},
                           {"datatype", "double"},
                           {"dust:value", name_of(kind)},
                           {"dust:figure", role_json(role)}});
      });
  return {{"@context", Json::array({"http://www.w3.org/ns/csvw", {{"dust", "urn:dust:"}}})},
          {"url", "series.csv"},
          {"tableSchema", {{"columns", columns}}}};
}

}  // namespace dust::run
