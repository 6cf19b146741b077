// SPDX-License-Identifier: Apache-2.0
#include "run/summary/figure_json.hpp"

#include "run/summary/summary.hpp"

#include <utility>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;

/// Roles of the columns that a sensor gives.
class RowRoles final : public sdk::FigureSink {
 public:
  explicit RowRoles(Json& roles) : roles_(roles) {}
  void begin(const std::string& sensor) { prefix_ = sensor + "/"; }
  void figure(std::string_view name, double, std::string_view unit, double,
              const sdk::FigureRole& role) override {
    roles_[prefix_ + std::string(name) + " [" + std::string(unit) + "]"] = role_json(role);
  }

 private:
  Json& roles_;
  std::string prefix_;
};

/// The columns of the run itself.
constexpr std::pair<const char*, sdk::FigureRole> k_own[] = {
    {"time [s]", sdk::detail(sdk::Quantity::time)},
    {"kinetic_energy [J]", sdk::detail(sdk::Quantity::energy)},
    {"particles [1]", sdk::detail(sdk::Quantity::number)},
    {"real_particles [1]", sdk::detail(sdk::Quantity::number)},
    {"mass_emitted [kg]", {.role = sdk::Role::balance, .quantity = sdk::Quantity::mass}},
    {"mass_in_domain [kg]", {.role = sdk::Role::balance, .quantity = sdk::Quantity::mass}},
    {"mass_left [kg]", {.role = sdk::Role::balance, .quantity = sdk::Quantity::mass}},
    {"mass_removed [kg]", {.role = sdk::Role::balance, .quantity = sdk::Quantity::mass}},
};

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
  for (const auto& [column, role] : k_own) roles[column] = role_json(role);
  // Hoods and the dust field, named by the scenario, give masses alone.
  for (const std::string& column : series_row(s).names) {
    if (column.starts_with("hoods/") || column.starts_with("dust_field/")) {
      roles[column] = role_json(sdk::detail(sdk::Quantity::mass));
    }
  }
  RowRoles sink(roles);
  for (std::size_t n = 0; n < s.models().sensors.size(); ++n) {
    sink.begin(s.setup().sensors[n].name);
    s.models().sensors[n]->series(sink);
  }
  return roles;
}

Json series_metadata(const Simulation& s) {
  const Json roles = series_roles(s);
  Json columns = Json::array();
  const SeriesRow row = series_row(s);
  for (std::size_t c = 0; c < row.names.size(); ++c) {
    Json column = {{"titles", row.names[c]}, {"datatype", "double"}, {"required", true}};
    column["dust:value"] = name_of(row.kinds[c]);
    column["dust:figure"] = roles.at(row.names[c]);
    columns.push_back(std::move(column));
  }
  return {{"@context", Json::array({"http://www.w3.org/ns/csvw", {{"dust", "urn:dust:"}}})},
          {"url", "series.csv"},
          {"tableSchema", {{"columns", columns}}}};
}

}  // namespace dust::run
