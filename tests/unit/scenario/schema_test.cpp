// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace {

/// Calls `see` with each reference in a schema.
template <class See>
void each_reference(const nlohmann::json& part, const See& see) {
  if (part.is_object() && part.contains("$ref")) see(part["$ref"].get<std::string>());
  if (!part.is_structured()) return;
  for (const auto& item : part.items()) each_reference(item.value(), see);
}

}  // namespace

TEST_CASE(
    "what bodies of any shape and motion share shall stand once, and every reference be met") {
  const std::string text = dust::scenario::json_schema(fakes());
  const auto schema = nlohmann::json::parse(text);
  int references = 0;
  each_reference(schema, [&](const std::string& reference) {
    CAPTURE(reference);
    REQUIRE(reference.starts_with("#/"));
    CHECK(schema.contains(nlohmann::json::json_pointer(reference.substr(1))));
    ++references;
  });
  CHECK(references > 100);
  const auto& head = schema["definitions"]["shapes"]["belt_conveyor"]["head"];
  CHECK(head["type"] == "array");
  const std::string sentence = head["description"].get<std::string>();
  const std::size_t first = text.find(sentence);
  REQUIRE(first != std::string::npos);
  CHECK(text.find(sentence, first + 1) == std::string::npos);
}

TEST_CASE("the JSON Schema shall hold every model with its parameters") {
  const auto schema = nlohmann::json::parse(dust::scenario::json_schema(fakes()));
  CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
  const auto& contact = schema["definitions"]["contact"]["oneOf"];
  REQUIRE(contact.size() == 1);
  CHECK(contact[0]["properties"]["model"]["const"] == "hertz_mindlin");
  const auto& restitution = contact[0]["properties"]["restitution"]["anyOf"][0];
  CHECK(restitution["exclusiveMinimum"] == 0);
  CHECK(restitution["maximum"] == 1);
  CHECK(contact[0]["required"].size() == 3);
  const auto& keys = schema["definitions"]["scenario"]["properties"];
  CHECK(keys["sensors"]["additionalProperties"]["oneOf"].size() == 5);
  // All shapes, each at rest or with one of two motions.
  CHECK(keys["bodies"]["additionalProperties"]["oneOf"].size() ==
        3 * dust::bodies::shape_catalogue().size());
  CHECK(keys["time"]["required"] == nlohmann::json({"end", "fluid_step", "output_every"}));
  // What is laid over an included file need not repeat it.
  const auto& time = schema["definitions"]["addition"]["properties"]["time"]["anyOf"];
  CHECK_FALSE(time[0].contains("required"));
  // It may take away what that gives.
  CHECK(time[0]["properties"]["keep_every"]["anyOf"][1]["type"] == "null");
  CHECK(time[1]["type"] == "null");
}
