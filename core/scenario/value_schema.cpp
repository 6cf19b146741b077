// SPDX-License-Identifier: Apache-2.0
#include "scenario/value_schema.hpp"

#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace dust::scenario {
namespace {

using Json = nlohmann::ordered_json;
using sdk::Parameter;
using sdk::ParameterType;

std::string description_of(const Parameter& p) {
  std::string text = p.sentence;
  const std::string unit = si_unit(p.dimension);
  if (!unit.empty()) text += " [" + unit + "; " + example_units(p.dimension) + "]";
  const std::string range = range_text(p);
  if (!range.empty()) text += " " + range;
  const std::string usual = usual_text(p);
  if (!usual.empty()) text += " (usual: " + usual + ")";
  const std::string standard = default_text(p);
  if (!p.is_required && !standard.empty()) text += " (default " + standard + ")";
  return text;
}

void add_range(Json& number, const Parameter& p) {
  if (std::isfinite(p.range.low)) {
    number[p.range.low_is_open ? "exclusiveMinimum" : "minimum"] = p.range.low;
  }
  if (std::isfinite(p.range.high)) {
    number[p.range.high_is_open ? "exclusiveMaximum" : "maximum"] = p.range.high;
  }
}

Json text_schema(const Parameter& p) {
  Json text = {{"type", "string"}};
  if (!p.options.empty()) text["enum"] = p.options;
  return text;
}

}  // namespace

/// A bare number, or a text that begins with one (its unit is checked by the engine).
nlohmann::ordered_json number_schema(const Parameter& p) {
  Json number = {{"type", "number"}};
  add_range(number, p);
  Json text = {{"type", "string"}, {"pattern", "^[-+]?(\\d+\\.?\\d*|\\.\\d+)([eE][-+]?\\d+)?"}};
  return {{"anyOf", Json::array({number, text})}};
}

nlohmann::ordered_json value_schema(const Parameter& p) {
  Json s;
  switch (p.type) {
    case ParameterType::number:
      s = number_schema(p);
      break;
    case ParameterType::integer:
      s = {{"type", "integer"}};
      add_range(s, p);
      break;
    case ParameterType::boolean:
      s = {{"type", "boolean"}};
      break;
    case ParameterType::text:
      s = text_schema(p);
      break;
    case ParameterType::vector:
      s = {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", number_schema(p)}};
      break;
    case ParameterType::numbers:
      s = {{"type", "array"}, {"items", number_schema(p)}};
      break;
    case ParameterType::texts:
      s = {{"type", "array"}, {"items", text_schema(p)}};
      break;
    case ParameterType::vectors:
      s = {{"type", "array"},
           {"items",
            {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", number_schema(p)}}}};
      break;
  }
  s["description"] = description_of(p);
  return s;
}

nlohmann::ordered_json property_schemas(const sdk::ParameterSchema& schema) {
  Json properties = Json::object();
  for (const Parameter& p : schema) properties[p.name] = value_schema(p);
  return properties;
}

}  // namespace dust::scenario
