// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "registry/registry.hpp"
#include "scenario/text/tree.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dust::test {

/// One key, value or list of a shipped scenario: where it stands and what it declares.
struct Place {
  enum class Kind { key, name_of_user, text, list, map };
  Kind kind = Kind::text;
  std::string path;               ///< dotted, for messages
  scenario::Mark where;           ///< of the key or the value
  std::string text;               ///< of a key or a value
  bool is_quoted = false;         ///< the value is written in quotes
  bool is_in_list = false;        ///< one component of a vector or list
  bool has_unit_of_last = false;  ///< a component whose unit the last one of its list gives
  /// The declaration of a value's key; nothing for keys that no schema declares.
  const sdk::Parameter* parameter = nullptr;
};

/// Every place of a merged scenario. Names given by the user (of materials, bodies, ...) are told
/// apart from keys: renaming a thing is no mistake unless something refers to it.
std::vector<Place> places_of(const scenario::Node& root, const registry::Registry& registry);

/// One thing done wrong at one place.
struct Mistake {
  std::string what;         ///< for messages
  std::string replacement;  ///< of the place's text
  /// Whether it must be refused: false for values that happen to be allowed too (a large number
  /// where no range is declared): then it only must not end the program.
  bool must_be_refused = true;
};

/// What is put at the place, one after the other.
std::vector<Mistake> mistakes_at(const Place& place);

}  // namespace dust::test
