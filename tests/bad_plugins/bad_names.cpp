// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

namespace {

struct Parameters {
  double wrong = 0.0;
  double silent = 0.0;
  std::string kind = "other";
};

/// Parameters of a motion, which stand beside the keys of its body.
dust::sdk::ParameterSchema beside_a_body() {
  dust::sdk::SchemaOf<Parameters> schema;
  schema.number(&Parameters::wrong, "material", dust::sdk::dimension::none, "A sentence.");
  schema.number(&Parameters::wrong, "radius", dust::sdk::dimension::none, "A sentence.");
  schema.number(&Parameters::silent, "radius", dust::sdk::dimension::none, "A sentence.");
  return schema.build();
}

}  // namespace

DUST_PLUGIN(registrar) {
  dust::sdk::SchemaOf<Parameters> schema;
  schema.number(&Parameters::wrong, "WrongName", dust::sdk::dimension::none, "A sentence.");
  schema.number(&Parameters::silent, "silent", dust::sdk::dimension::none, "");
  schema.number(&Parameters::silent, "none", dust::sdk::dimension::none, "A sentence.")
      .at_least(3)
      .at_most(1);
  schema.number(&Parameters::wrong, "outside", dust::sdk::dimension::none, "A sentence.")
      .above(0)
      .optional();
  schema.number(&Parameters::silent, "unusual", dust::sdk::dimension::none, "A sentence.")
      .usual(10, 1);
  schema.text(&Parameters::kind, "kind", "A sentence.").one_of({"one", "two"}).optional();
  dust::sdk::ModelInfo info = Drag::describe();
  info.kind = "drag";
  info.name = "Camel";
  info.summary = "";
  info.parameters = schema.build();
  registrar.add(std::move(info), [](std::span<const dust::sdk::Value>) {
    return std::make_unique<Drag>(Drag::Parameters{});
  });
  registrar.add({.kind = "motion",
                 .name = "mover",
                 .version = "1.0",
                 .summary = "Moves.",
                 .equation = "",
                 .source = "",
                 .parameters = beside_a_body()},
                [](std::span<const dust::sdk::Value>) { return nullptr; });
}
