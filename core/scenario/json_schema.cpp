// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape.hpp"
#include "scenario/blocks.hpp"
#include "scenario/reader.hpp"
#include "scenario/value_schema.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace dust::scenario {
namespace {

using Json = nlohmann::ordered_json;
using sdk::Parameter;
using sdk::ParameterSchema;

/// A name of one of the scenario's things.
constexpr const char* k_name_pattern = "^[A-Za-z_][A-Za-z0-9_-]*$";

Json object() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

void add_parameters(Json& object, const ParameterSchema& schema) {
  for (const Parameter& p : schema) {
    object["properties"][p.name] = value_schema(p);
    if (!p.is_required) continue;
    Json& required = object["required"];
    // A motion may ask for what its body's shape asks for as well: the path of a belt.
    if (std::find(required.begin(), required.end(), p.name) == required.end()) {
      required.push_back(p.name);
    }
  }
}

/// The same where each stands once, at `place` in the definitions: of what is combined with many
/// others.
void refer_to_parameters(Json& object, const ParameterSchema& schema, const std::string& place) {
  add_parameters(object, schema);
  for (const Parameter& p : schema) {
    object["properties"][p.name] = {{"$ref", "#/definitions/" + place + "/" + p.name}};
  }
}

template <class Block>
Json block() {
  Json made = object();
  add_parameters(made, Block::schema());
  return made;
}

struct Choice {
  std::string name;
  std::string summary;
  const ParameterSchema* parameters;
};

std::vector<Choice> choices(const registry::Registry& registry, const std::string& kind) {
  std::vector<Choice> result;
  for (const auto& entry : registry.entries()) {
    if (entry.info.kind == kind) {
      result.push_back({entry.info.name, entry.info.summary, &entry.info.parameters});
    }
  }
  return result;
}

std::vector<Choice> shapes() {
  std::vector<Choice> result;
  for (const auto& shape : bodies::shape_catalogue()) {
    result.push_back({shape.name, shape.summary, &shape.parameters});
  }
  return result;
}

/// One alternative per model: `base` with the model's name and its parameters.
Json alternatives(const Json& base, const std::string& key, const std::vector<Choice>& all) {
  if (all.empty()) return {{"type", "object"}};
  Json list = Json::array();
  for (const Choice& choice : all) {
    Json one = base;
    one["title"] = choice.name;
    one["description"] = choice.summary;
    one["properties"][key] = {{"const", choice.name}};
    one["required"].push_back(key);
    add_parameters(one, *choice.parameters);
    list.push_back(one);
  }
  return {{"oneOf", list}};
}

/// What bodies of any shape and motion have.
Json any_body() {
  Json base = object();
  refer_to_parameters(base, PlacedBlock::schema(), "body");
  refer_to_parameters(base, BodyBlock::schema(), "body");
  for (const char* key : {"remove", "suction"}) {
    base["properties"][key] = {{"$ref", std::string("#/definitions/body/") + key}};
  }
  return base;
}

/// What body_schema refers to.
void add_body_definitions(Json& definitions, const registry::Registry& registry) {
  Json body = property_schemas(PlacedBlock::schema());
  body.update(property_schemas(BodyBlock::schema()));
  body["remove"] = block<RemovalBlock>();
  body["suction"] = block<SuctionBlock>();
  definitions["body"] = body;
  for (const Choice& shape : shapes()) {
    definitions["shapes"][shape.name] = property_schemas(*shape.parameters);
  }
  for (const Choice& motion : choices(registry, "motion")) {
    definitions["motions"][motion.name] = property_schemas(*motion.parameters);
  }
}

/// Bodies: every shape, at rest or with every motion.
Json body_schema(const registry::Registry& registry) {
  Json list = Json::array();
  std::vector<Choice> motions = choices(registry, "motion");
  motions.insert(motions.begin(), Choice{});
  for (const Choice& motion : motions) {
    Json base = any_body();
    if (motion.name.empty()) {
      base["properties"]["motions"] = {{"type", "array"},
                                       {"items", {{"$ref", "#/definitions/motion"}}},
                                       {"description", "Motions that act one after the other."}};
    }
    if (!motion.name.empty()) {
      base["properties"]["motion"] = {{"const", motion.name}, {"description", motion.summary}};
      base["required"].push_back("motion");
      refer_to_parameters(base, *motion.parameters, "motions/" + motion.name);
    }
    for (const Choice& shape : shapes()) {
      Json one = base;
      one["title"] = shape.name;
      one["description"] = shape.summary;
      one["properties"]["shape"] = {{"const", shape.name}};
      one["required"].push_back("shape");
      refer_to_parameters(one, *shape.parameters, "shapes/" + shape.name);
      list.push_back(one);
    }
  }
  return {{"oneOf", list}};
}

/// A number with the unit of the figure; which one that is, only the engine knows.
Json reference_schema() {
  Json one = block<ReferenceBlock>();
  const auto number = [](const char* sentence) {
    Json made = number_schema({});
    made["description"] = sentence;
    return made;
  };
  one["properties"]["value"] = number("The number, with a unit of the figure's dimension.");
  one["properties"]["uncertainty"] = number("Its uncertainty, with a unit; without it, not known.");
  one["required"].push_back("value");
  return one;
}

/// A list of numbers, the last of them with the unit of all.
Json reference_curve_schema() {
  Json one = block<ReferenceCurveBlock>();
  const auto numbers = [](const char* sentence) {
    return Json{{"type", "array"},
                {"items", number_schema({})},
                {"minItems", 2},
                {"description", sentence}};
  };
  one["properties"]["x"] = numbers("The places, ascending, the last with the unit of all.");
  one["properties"]["y"] = numbers("The numbers, one for each place, the last with its unit.");
  one["required"].push_back("x");
  one["required"].push_back("y");
  return one;
}

Json named(const Json& one) {
  return {{"type", "object"},
          {"propertyNames", {{"pattern", k_name_pattern}}},
          {"additionalProperties", one}};
}

Json model(const registry::Registry& registry, const std::string& kind) {
  return alternatives(object(), "model", choices(registry, kind));
}

Json domain_schema() {
  Json side = block<SideBlock>();
  side["properties"]["air"] = {
      {"anyOf", Json::array({{{"$ref", "#/definitions/boundary"}}, {{"const", "periodic"}}})},
      {"description", "What the air meets; periodic sides need none."}};
  Json sides = object();
  for (const char* name : k_side_names) {
    sides["properties"][name] = {{"$ref", "#/definitions/side"}};
    sides["required"].push_back(name);
  }
  Json domain = block<DomainBlock>();
  domain["properties"]["boundaries"] = sides;
  domain["required"].push_back("boundaries");
  return {{"side", side}, {"domain", domain}};
}

/// null takes away what is given below.
Json or_null(Json one) {
  Json either = {{"anyOf", Json::array({one, {{"type", "null"}}})}};
  if (one.contains("description")) either["description"] = one["description"];
  return either;
}

/// A file that is laid over what it includes: every key may be missing, a model's name too. Lists
/// are replaced as a whole and stay as they are, but for the pairs of `interactions`.
Json addition(const Json& full, const Json& definitions) {
  if (full.contains("$ref")) {
    const std::string ref = full["$ref"];
    return addition(definitions[ref.substr(ref.rfind('/') + 1)], definitions);
  }
  if (full.contains("oneOf")) return {{"type", "object"}};
  Json part = full;
  part.erase("required");
  if (full.contains("properties")) {
    for (const auto& [key, value] : full["properties"].items()) {
      part["properties"][key] = or_null(addition(value, definitions));
    }
  }
  if (full.contains("additionalProperties") && full["additionalProperties"].is_object()) {
    part["additionalProperties"] = or_null(addition(full["additionalProperties"], definitions));
  }
  if (full.contains("anyOf")) {
    part["anyOf"] = Json::array();
    for (const Json& one : full["anyOf"]) part["anyOf"].push_back(addition(one, definitions));
  }
  return part;
}

/// Of the interactions of a whole file; in one laid over others a pair may lack both of `anyOf`.
Json interaction_schema() {
  Json interaction = block<InteractionBlock>();
  Json& properties = interaction["properties"];
  properties["between"]["minItems"] = 2;
  properties["between"]["maxItems"] = 2;
  properties["contact"] = {{"$ref", "#/definitions/contact"}};
  properties["rolling"] = {{"$ref", "#/definitions/rolling"}};
  properties["cohesion"] = {{"$ref", "#/definitions/cohesion"}};
  properties["like"] = {
      {"type", "array"},
      {"items", {{"type", "string"}}},
      {"minItems", 2},
      {"maxItems", 2},
      {"description", "Another pair of materials, from which all that is not given is taken."}};
  return interaction;
}

Json include_schema() {
  return {
      {"description", "Files laid under this one, relative to it; null takes away what they give."},
      {"anyOf",
       Json::array({{{"type", "string"}}, {{"type", "array"}, {"items", {{"type", "string"}}}}})}};
}

Json start_schema() {
  return {
      {"type", "string"},
      {"description",
       "Folder of another run's results, relative to this file, whose state this run starts from; "
       "RUN@TIME takes a state that was kept (time.keep_every)."}};
}

Json fluid_schema() {
  Json fluid = block<FluidBlock>();
  fluid["properties"]["regions"] = named(block<RegionBlock>());
  fluid["properties"]["turbulence"] = {{"$ref", "#/definitions/turbulence"}};
  return {{"anyOf", Json::array({fluid, {{"const", "none"}}})},
          {"description", "The fluid around the grains; none runs grains alone."}};
}

Json dust_schema() {
  Json dust = block<DustBlock>();
  Json field = block<DustFieldBlock>();
  field["properties"]["clouds"] = named(block<DustCloudBlock>());
  field["properties"]["sources"] = named(block<DustSourceBlock>());
  dust["properties"]["field"] = field;
  dust["properties"]["feed_zones"] = named(block<FeedZoneBlock>());
  dust["properties"]["liberation"] = {{"$ref", "#/definitions/liberation"}};
  return dust;
}

Json list_schema(const Json& item, const char* sentence) {
  return {{"type", "array"}, {"items", item}, {"description", sentence}};
}

/// Of a whole scenario; `interaction` of one of its pairs.
Json scenario_schema(const registry::Registry& registry, const Json& domain,
                     const Json& interaction) {
  Json root = block<GeneralBlock>();
  Json& properties = root["properties"];
  properties["include"] = include_schema();
  properties["start_from"] = start_schema();
  properties["time"] = block<TimeBlock>();
  properties["domain"] = domain;
  properties["materials"] = named(block<MaterialBlock>());
  Json whole_interaction = interaction;
  whole_interaction["anyOf"] = {{{"required", {"contact"}}}, {{"required", {"like"}}}};
  properties["interactions"] = {{"type", "array"}, {"items", whole_interaction}};
  properties["frames"] = named(block<FrameBlock>());
  properties["bodies"] = named(body_schema(registry));
  properties["emitters"] =
      named(alternatives(block<PlacedBlock>(), "model", choices(registry, "emitter")));
  properties["fluid"] = fluid_schema();
  properties["coupling"] = block<CouplingBlock>();
  properties["drag"] = {{"$ref", "#/definitions/drag"}};
  properties["fluid_forces"] = list_schema({{"$ref", "#/definitions/fluid_force"}},
                                           "Forces of the fluid on grains besides drag.");
  properties["voidage"] = {{"$ref", "#/definitions/voidage"}};
  properties["sensors"] =
      named(alternatives(block<SensorBlock>(), "model", choices(registry, "sensor")));
  properties["audit"] = block<AuditBlock>();
  properties["dust"] = dust_schema();
  properties["references"] =
      list_schema(reference_schema(),
                  "Numbers from elsewhere that stand beside ours in the summary and report.");
  properties["reference_curves"] = list_schema(
      reference_curve_schema(), "Curves from elsewhere that are drawn behind ours in the report.");
  root["required"] = {"time", "gravity", "domain", "fluid"};
  return root;
}

}  // namespace

std::string json_schema(const registry::Registry& registry) {
  const Json domain = domain_schema();
  const Json interaction = interaction_schema();
  Json definitions = {{"side", domain["side"]}};
  for (const char* kind : {"contact", "rolling", "cohesion", "boundary", "drag", "fluid_force",
                           "voidage", "turbulence", "motion", "liberation"}) {
    definitions[kind] = model(registry, kind);
  }
  add_body_definitions(definitions, registry);
  const Json root = scenario_schema(registry, domain["domain"], interaction);
  definitions["scenario"] = root;
  definitions["addition"] = addition(root, definitions);
  Json more_of_pair = addition(interaction, definitions);
  more_of_pair["required"] = {"between"};
  definitions["addition"]["properties"]["interactions"] =
      or_null({{"type", "array"}, {"items", more_of_pair}});

  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "Scenario of the dust engine"},
                 {"type", "object"},
                 {"if", {{"required", {"include"}}}},
                 {"then", {{"$ref", "#/definitions/addition"}}},
                 {"else", {{"$ref", "#/definitions/scenario"}}}};
  schema["definitions"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace dust::scenario
