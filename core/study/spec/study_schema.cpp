// SPDX-License-Identifier: Apache-2.0
#include "scenario/value_schema.hpp"
#include "study/spec/axes.hpp"
#include "study/spec/spec.hpp"
#include "study/spec/spec_blocks.hpp"

#include <nlohmann/json.hpp>

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

/// What the reader takes by a declaration, with what it reads by hand: `more`. Values whose
/// dimension is that of a key of the scenario, or of a figure of the run, are declared by neither:
/// levels, intervals, targets.
OrderedJson declared(const sdk::ParameterSchema& schema,
                     const OrderedJson& more = OrderedJson::object(),
                     OrderedJson required = OrderedJson::array()) {
  OrderedJson properties = scenario::property_schemas(schema);
  properties.update(more);
  for (const sdk::Parameter& p : schema) {
    if (p.is_required) required.push_back(p.name);
  }
  return object(properties, required);
}

/// A number with a unit that another key decides.
const OrderedJson k_number = scenario::number_schema({});
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
  const OrderedJson by_hand = {
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
  return declared(CalibrationSpec::schema(), by_hand, {"targets", "parameters"});
}

OrderedJson sample() {
  return declared(sample_schema(),
                  {{"over", described(map_of(interval(false)), "Paths and the interval of each.")}},
                  {"over"});
}

OrderedJson expectation() {
  return declared(
      ExpectationBlock::schema(),
      {{"at", described(map_of(OrderedJson::object()),
                        "Paths of other inputs, or `case`, and the level of each at which the "
                        "effect is looked at (default: the mean over all their levels).")}});
}

}  // namespace

std::string study_schema() {
  const OrderedJson one_case = map_of(OrderedJson::object());
  const OrderedJson measure = {
      {"anyOf", OrderedJson::array({k_text, declared(MeasureBlock::schema())})}};
  const OrderedJson zip = map_of(levels());
  const OrderedJson by_hand = {
      {"include", {{"type", {"string", "array"}}}},
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
      {"measure", described(map_of(measure),
                            "Names and what is taken from every run: "
                            "sensors.SENSOR.FIGURE or a figure of summary.json, "
                            "with another unit if wanted. Required unless calibrate is given.")},
      {"expect", described({{"type", "array"}, {"items", expectation()}},
                           "Signs of effects stated before the runs, checked in the report.")},
      {"run", described(declared(Execution::schema()), "How many runs at a time.")},
      {"slurm", described(declared(SlurmSpec::schema()),
                          "What a cluster is asked for with --launcher slurm.")},
      {"calibrate", described(calibration(), "Finds parameters that meet targets.")}};
  OrderedJson schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                        {"title", "Study of the dust engine"}};
  const OrderedJson whole = declared(GeneralBlock::schema(), by_hand);
  for (const auto& [key, value] : whole.items()) schema[key] = value;
  schema["anyOf"] = OrderedJson::array({{{"required", OrderedJson::array({"measure"})}},
                                        {{"required", OrderedJson::array({"calibrate"})}}});
  return schema.dump(2) + "\n";
}

}  // namespace dust::study
