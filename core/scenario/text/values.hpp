// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "scenario/text/tree.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dust::scenario {

/// Reads a declared parameter from what was written; on failure nothing, the problem is told.
std::optional<sdk::Value> read_value(const Node& node, const sdk::Parameter& parameter,
                                     const std::string& path, Diagnostics& diagnostics);

/// The value as a scenario would write it, in SI; text and numbers in full precision.
Node written_value(const sdk::Value& value);

/// "0 < e <= 1", "speed >= 0 m/s"; "" for a range without ends.
std::string range_text(const sdk::Parameter& parameter);
/// "1e-6 to 1000 Pa s"; empty where all values are usual.
std::string usual_text(const sdk::Parameter& parameter);

/// The unit that a bare number was hardly meant without; "" where SI is likely. Whole metres are
/// typed by those who think in millimetres, more than a full turn by those who think in degrees.
std::string likely_unit(sdk::Dimension dimension, double value);

/// The default as text in SI, "" for none.
std::string default_text(const sdk::Parameter& parameter);

/// "number", "list of numbers", ...
std::string type_text(sdk::ParameterType type);

/// Reads the keys of one map and remembers which ones there may be, so that all others are errors.
class MapReader {
 public:
  /// What a map is, for one who gave a word in its place.
  enum class Of { keys, model };
  /// `where` is the place to name when a key is missing; `path` is dotted, "" for the whole file,
  /// which messages call `whole`.
  MapReader(const Node& node, std::string path, Mark where, Diagnostics& diagnostics,
            std::string whole = "the scenario", Of of = Of::keys);
  /// The map of a model.
  static MapReader of_model(const Node& node, std::string path, Mark where,
                            Diagnostics& diagnostics) {
    return {node, std::move(path), std::move(where), diagnostics, "the scenario", Of::model};
  }

  /// The entry of a key that may be there.
  const Entry* optional(const std::string& key);
  /// The entry of a key that must be there; `what` says what it is for.
  const Entry* required(const std::string& key, const std::string& what);
  /// All parameters of a schema, in its order; defaults where absent, nothing where wrong.
  std::vector<sdk::Value> values(const sdk::ParameterSchema& schema);
  /// The other keys belong to something that could not be found: only near misses are told.
  void keys_are_unknowable() { is_open_ = true; }
  /// Tells unknown keys. Call last.
  void finish();

  /// False once a value of `values()` was wrong or missing.
  [[nodiscard]] bool is_good() const { return is_good_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const Mark& where() const { return where_; }
  [[nodiscard]] const Node& node() const { return node_; }
  [[nodiscard]] std::string path_of(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
  }

 private:
  void warn_of_bare_numbers(const sdk::ParameterSchema& schema);
  bool warn_of_bare_neighbour(const sdk::ParameterSchema& schema, const sdk::Parameter& parameter);
  void warn_of_bare_vector(const Node& vectors, const sdk::Parameter& parameter);

  const Node& node_;
  std::string path_;
  Mark where_;
  Diagnostics& diagnostics_;
  std::string whole_;
  std::vector<std::string> known_;
  bool is_open_ = false;
  bool is_good_ = true;
};

}  // namespace dust::scenario
