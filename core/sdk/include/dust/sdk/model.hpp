// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/parameter_schema.hpp"

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace dust::sdk {

/// Base of every model. A model is owned by the core and lives until the process ends.
class Model {
 public:
  virtual ~Model() = default;

  /// An emitter or sensor with state between calls saves it here and restores it in `load`, so that
  /// a resumed run gives the same bits. Models of other kinds are never asked for either: what they
  /// give is a function of what they are shown.
  virtual void save(ArchiveWriter&) const {}
  virtual void load(ArchiveReader&) {}
};

/// What a model says of itself; help, schema, messages and reference pages derive from it.
struct ModelInfo {
  std::string kind = {};            ///< filled from the interface
  std::string name;                 ///< how a scenario chooses it, snake_case
  std::string version;              ///< of the model, "1.0"
  std::string summary;              ///< one sentence
  std::string equation;             ///< TeX
  std::string source;               ///< author, year, equation or table, DOI
  ParameterSchema parameters = {};  ///< filled from the model's schema()
};

using ModelFactory = std::function<std::unique_ptr<Model>(std::span<const Value> values)>;

/// Receives the models of a library during dust_register.
class Registrar {
 public:
  virtual ~Registrar() = default;
  virtual void add(ModelInfo info, ModelFactory factory) = 0;

  /// Adds `M`, which has `struct Parameters`, `static ModelInfo describe()` (kind and parameters
  /// stay empty), `static ParameterSchema schema()` and a constructor from `Parameters`.
  template <class M>
  void add() {
    ModelInfo info = M::describe();
    info.kind = M::k_kind;
    info.parameters = M::schema();
    add(std::move(info), [schema = M::schema()](std::span<const Value> values) {
      return std::make_unique<M>(parameters_from<typename M::Parameters>(schema, values));
    });
  }
};

}  // namespace dust::sdk
