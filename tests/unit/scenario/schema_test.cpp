// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

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
  CHECK_FALSE(schema["definitions"]["addition"]["properties"]["time"].contains("required"));
}
