// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dust::scenario {

struct Entry;

/// A piece of a scenario as written: text is not yet interpreted, every piece knows its place.
struct Node {
  enum class Kind { nothing, text, list, map };
  Kind kind = Kind::nothing;
  std::string text;
  bool is_quoted = false;
  std::vector<Node> items;
  std::vector<Entry> entries;
  Mark where;

  [[nodiscard]] bool is_map() const { return kind == Kind::map; }
  [[nodiscard]] bool is_list() const { return kind == Kind::list; }
  [[nodiscard]] bool is_text() const { return kind == Kind::text; }
  /// Text without quotes that is `word`.
  [[nodiscard]] bool is_word(std::string_view word) const;
  /// Written as `null` or `~`, in a file that lies over another: takes away what that gives. A key
  /// without a value is none.
  [[nodiscard]] bool takes_away() const { return kind == Kind::nothing && !text.empty(); }
  [[nodiscard]] const Entry* find(std::string_view key) const;

  static Node make_map();
  static Node make_list();
  static Node make_text(std::string text, bool is_quoted = false);
};

struct Entry {
  std::string key;
  Mark where;
  Node value;
  /// Given beside a model whose place another one has taken: not that one's, as it seems.
  bool is_of_other_model = false;
};

[[nodiscard]] Entry* find(Node& map, std::string_view key);
void add(Node& map, std::string key, Node value);

/// "a map of keys", "a list", "text", "nothing": what a node is, for messages.
std::string kind_text(const Node& node);

/// Parses one YAML document. Problems (syntax, duplicate keys, tags, encoding) go to `diagnostics`;
/// nothing is returned when the text cannot be used at all. Pieces of a command line have no lines:
/// all their marks are {file, 0, 0}.
std::optional<Node> parse_yaml(const std::string& text, const std::string& file,
                               bool is_command_line, Diagnostics& diagnostics);

/// First line of a scenario that the engine writes, by which it knows it again.
inline constexpr const char* k_resolved_heading =
    "# Resolved scenario: includes merged, settings applied, defaults written out, all in SI.\n";

/// YAML text of a tree: blocks, with flow style for what fits into one line.
std::string emit_yaml(const Node& root);

}  // namespace dust::scenario
