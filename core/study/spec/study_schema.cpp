// SPDX-License-Identifier: Apache-2.0
#include "study/spec/axes.hpp"
#include "study/spec/spec.hpp"

#include "scenario/text/values.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace dust::study {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson described(OrderedJson json, const std::string& description) {
  json["description"] = description;
  return json;
}

OrderedJson object(const OrderedJson& properties,
                   const OrderedJson& required = OrderedJson::array()) {
  OrderedJson made = {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) made["required"] = required;
  return made;
}

OrderedJson map_of(const OrderedJson& value) {
  return {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", value}};
}

OrderedJson value_of(const sdk::Parameter& p) {
  OrderedJson json;
  switch (p.type) {
    case sdk::ParameterType::integer:
      json = {{"type", "integer"}};
      break;
    case sdk::ParameterType::texts:
      json = {{"type", "array"}, {"items", {{"type", "string"}}}};
      break;
    case sdk::ParameterType::text:
      json = {{"type", "string"}};
      break;
    default:
      json = {{"type", "number"}};
      break;
  }
  if (!p.options.empty()) json["enum"] = p.options;
  if (std::isfinite(p.range.low)) {
    json[p.range.low_is_open ? "exclusiveMinimum" : "minimum"] = p.range.low;
  }
  if (std::isfinite(p.range.high)) {
    json[p.range.high_is_open ? "exclusiveMaximum" : "maximum"] = p.range.high;
  }
  const std::string standard = scenario::default_text(p);
  return described(json, p.sentence + (standard.empty() ? "" : " (default " + standard + ")"));
}

OrderedJson properties_of(const sdk::ParameterSchema& schema) {
  OrderedJson properties = OrderedJson::object();
  for (const sdk::Parameter& p : schema) properties[p.name] = value_of(p);
  return properties;
}

const OrderedJson k_number = {{"type", {"number", "string"}}};
const OrderedJson k_text = {{"type", "string"}};

OrderedJson interval(bool has_count) {
  OrderedJson properties = {{"from", k_number},
                            {"to", k_number},
                            {"spacing", described({{"enum", {"linear", "log"}}},
                                                  "How levels lie between (default linear).")}};
  OrderedJson required = {"from", "to"};
  if (has_count) {
    properties["count"] = {{"type", "integer"}, {"minimum", 1}};
    required.push_back("count");
  }
  return object(properties, required);
}

OrderedJson levels() {
  return {{"anyOf", OrderedJson::array({{{"type", "array"}, {"minItems", 1}}, interval(true)})}};
}

OrderedJson calibration() {
  OrderedJson properties = {
      {"targets",
       described(map_of(object({{"quantity", k_text}, {"value", k_number}, {"error", k_number}},
                               {"quantity", "value", "error"})),
                 "Measured values with their standard errors.")},
      {"parameters",
       described(
           map_of(object(
               {{"path", {{"type", {"string", "array"}}}}, {"from", k_number}, {"to", k_number}},
               {"path", "from", "to"})),
           "What is to be found, where it stands in the scenario, and its interval.")}};
  const OrderedJson declared = properties_of(CalibrationSpec::schema());
  for (const auto& [key, value] : declared.items()) properties[key] = value;
  return object(properties, {"targets", "parameters"});
}

OrderedJson sample() {
  OrderedJson properties = properties_of(sample_schema());
  properties["over"] = described(map_of(interval(false)), "Paths and the interval of each.");
  return object(properties, {"method", "count", "over"});
}

OrderedJson expectation() {
  return object(
      {{"output", described(k_text, "Name of a measure.")},
       {"input", described(k_text, "Path of what is varied, or `case`.")},
       {"then",
        described({{"enum", {"rises", "falls"}}},
                  "From the smallest number of the input to its largest, of other values "
                  "from the first that is given to the last, or from one case to another.")},
       {"from", described(k_text, "Of cases: the one that it changes from.")},
       {"to", described(k_text, "Of cases: the one that it changes to.")},
       {"at", described(map_of(OrderedJson::object()),
                        "Paths of other inputs, or `case`, and the level of each at which the "
                        "effect is looked at (default: the mean over all their levels).")},
       {"why", described(k_text, "For the report.")}},
      {"output", "input", "then"});
}

}  // namespace

std::string study_schema() {
  const OrderedJson one_case = map_of(OrderedJson::object());
  const OrderedJson measure = {
      {"anyOf", OrderedJson::array(
                    {k_text, object({{"quantity", k_text}, {"minus", k_text}, {"unit", k_text}},
                                    {"quantity"})})}};
  const OrderedJson zip = map_of(levels());
  OrderedJson properties = {
      {"include", {{"type", {"string", "array"}}}},
      {"name",
       described(k_text, "Name of the study and of its folder (default: the file's stem).")},
      {"title", described(k_text, "One sentence for the report.")},
      {"base", described(k_text, "The scenario that is varied, relative to this file.")},
      {"set", described(map_of(OrderedJson::object()),
                        "Dotted paths and what they are set to in every "
                        "point, as for --set.")},
      {"vary", described(map_of(levels()),
                         "Dotted paths and their levels: a list, or {from, to, "
                         "count}. All combinations are run.")},
      {"zip", described({{"anyOf", OrderedJson::array({zip, {{"type", "array"}, {"items", zip}}})}},
                        "Paths whose levels go together, first with first; combined with the "
                        "rest.")},
      {"cases",
       described(
           {{"anyOf", OrderedJson::array({map_of({{"type", {"object", "null"}}}),
                                          {{"type", "array"},
                                           {"items", object({{"name", k_text}, {"set", one_case}},
                                                            OrderedJson::array({"name"}))}}})}},
           "Named points, each with the paths it sets; combined with the rest.")},
      {"sample", described(sample(), "Points spread over intervals; combined with the rest.")},
      {"replicates", described({{"type", "integer"}, {"minimum", 1}, {"maximum", 1000}},
                               "Runs of every point, each with a seed of its own (default 1).")},
      {"seed", described({{"type", "integer"}, {"minimum", -1}},
                         "Seed of the first replicate; the next ones count on (default: the "
                         "scenario's).")},
      {"measure", described(map_of(measure),
                            "Names and what is taken from every run: "
                            "sensors.SENSOR.FIGURE or a figure of summary.json, "
                            "with another unit if wanted. Required unless calibrate is given.")},
      {"expect", described({{"type", "array"}, {"items", expectation()}},
                           "Signs of effects stated before the runs, checked in the report.")},
      {"run", described(object(properties_of(Execution::schema())), "How many runs at a time.")},
      {"slurm", described(object(properties_of(SlurmSpec::schema())),
                          "What a cluster is asked for with --launcher slurm.")},
      {"calibrate", described(calibration(), "Finds parameters that meet targets.")}};
  OrderedJson schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                        {"title", "Study of the dust engine"}};
  const OrderedJson whole = object(properties, OrderedJson::array({"base"}));
  for (const auto& [key, value] : whole.items()) schema[key] = value;
  schema["anyOf"] = OrderedJson::array({{{"required", OrderedJson::array({"measure"})}},
                                        {{"required", OrderedJson::array({"calibrate"})}}});
  return schema.dump(2) + "\n";
}

}  // namespace dust::study
