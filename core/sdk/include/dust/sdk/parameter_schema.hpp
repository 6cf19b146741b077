// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/dimension.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dust::sdk {

/// A parameter's value in SI, or nothing where it was neither given nor has a default.
using Value = std::variant<std::monostate, double, std::int64_t, bool, std::string, Vec3,
                           std::vector<double>, std::vector<std::string>, std::vector<Vec3>>;

enum class ParameterType { number, integer, boolean, text, vector, numbers, texts, vectors };

/// The values a number may have. Vectors and lists: each component.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_open = false;
  bool high_is_open = false;

  [[nodiscard]] bool contains(double v) const {
    return (low_is_open ? v > low : v >= low) && (high_is_open ? v < high : v <= high);
  }
};

/// What a `text` names, so that the reader can check it against the scenario. A `file` is seen from
/// the folder of the scenario file that names it; the model gets its full path. A `wall` is a body,
/// a group of bodies or a side of the domain.
enum class Refers { nothing, material, body, emitter, boundary, file, wall };

/// One declared parameter: the single place where its name, unit, range, default and meaning stand.
struct Parameter {
  std::string name;
  ParameterType type = ParameterType::number;
  Dimension dimension;
  Range range;
  Range usual;  ///< a value outside is run, with a warning: it may be meant in another unit
  bool is_required = true;
  Value default_value;
  std::string sentence;
  std::string symbol;
  std::vector<std::string> options;  ///< allowed texts; empty = any
  Refers refers = Refers::nothing;
  std::function<void(void* parameters, const Value& value)> store;
};

/// All parameters of a model in the order of declaration; `Value`s travel in the same order.
using ParameterSchema = std::vector<Parameter>;

/// Declares the members of the plain struct `P`:
/// ```
/// SchemaOf<Parameters> schema;
/// schema.number(&Parameters::restitution, "restitution", dimension::none,
///               "Ratio of the speeds after and before a head-on collision.")
///     .symbol("e").above(0).at_most(1);
/// schema.number(&Parameters::friction, "friction", dimension::none, "...").at_least(0).optional();
/// ```
/// `usual(low, high)` spans what materials and machines have, with room to spare: values outside,
/// a thousand times off for a forgotten prefix, are warned of.
/// `optional()` takes the member's own initial value as the default.
template <class P>
class SchemaOf {
 public:
  SchemaOf& number(double P::*member, std::string name, Dimension d, std::string sentence) {
    return add(member, std::move(name), ParameterType::number, d, std::move(sentence));
  }
  SchemaOf& integer(std::int64_t P::*member, std::string name, std::string sentence) {
    return add(member, std::move(name), ParameterType::integer, {}, std::move(sentence));
  }
  SchemaOf& boolean(bool P::*member, std::string name, std::string sentence) {
    return add(member, std::move(name), ParameterType::boolean, {}, std::move(sentence));
  }
  SchemaOf& text(std::string P::*member, std::string name, std::string sentence) {
    return add(member, std::move(name), ParameterType::text, {}, std::move(sentence));
  }
  SchemaOf& vector(Vec3 P::*member, std::string name, Dimension d, std::string sentence) {
    return add(member, std::move(name), ParameterType::vector, d, std::move(sentence));
  }
  SchemaOf& numbers(std::vector<double> P::*member, std::string name, Dimension d,
                    std::string sentence) {
    return add(member, std::move(name), ParameterType::numbers, d, std::move(sentence));
  }
  SchemaOf& texts(std::vector<std::string> P::*member, std::string name, std::string sentence) {
    return add(member, std::move(name), ParameterType::texts, {}, std::move(sentence));
  }

  SchemaOf& vectors(std::vector<Vec3> P::*member, std::string name, Dimension d,
                    std::string sentence) {
    return add(member, std::move(name), ParameterType::vectors, d, std::move(sentence));
  }

  SchemaOf& symbol(std::string s) { return last().symbol = std::move(s), *this; }
  SchemaOf& at_least(double v) { return last().range.low = v, *this; }
  SchemaOf& above(double v) { return last().range.low_is_open = true, at_least(v); }
  SchemaOf& at_most(double v) { return last().range.high = v, *this; }
  SchemaOf& below(double v) { return last().range.high_is_open = true, at_most(v); }
  SchemaOf& usual(double low, double high) { return last().usual = {low, high}, *this; }
  SchemaOf& one_of(std::vector<std::string> names) {
    return last().options = std::move(names), *this;
  }
  SchemaOf& refers_to(Refers what) { return last().refers = what, *this; }
  SchemaOf& optional() {
    last().is_required = false;
    last().default_value = initial_.back();
    return *this;
  }

  [[nodiscard]] ParameterSchema build() const { return parameters_; }

 private:
  Parameter& last() { return parameters_.back(); }

  template <class T>
  SchemaOf& add(T P::*member, std::string name, ParameterType type, Dimension dimension,
                std::string sentence) {
    Parameter p;
    p.name = std::move(name);
    p.type = type;
    p.dimension = dimension;
    p.sentence = std::move(sentence);
    p.store = [member](void* object, const Value& value) {
      static_cast<P*>(object)->*member = std::get<T>(value);
    };
    parameters_.push_back(std::move(p));
    initial_.push_back(Value(P{}.*member));
    return *this;
  }

  ParameterSchema parameters_;
  std::vector<Value> initial_;
};

/// Fills the struct described by `schema` from `values` (same order); absent ones keep their
/// initial value.
template <class P>
P parameters_from(const ParameterSchema& schema, std::span<const Value> values) {
  P parameters{};
  for (std::size_t i = 0; i < schema.size(); ++i) {
    if (!std::holds_alternative<std::monostate>(values[i])) schema[i].store(&parameters, values[i]);
  }
  return parameters;
}

}  // namespace dust::sdk
