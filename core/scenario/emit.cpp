// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/tree.hpp"

namespace dust::scenario {
namespace {

constexpr std::size_t k_line = 100;

std::string scalar(const Node& node) {
  if (node.kind == Node::Kind::nothing) return "null";
  if (!node.is_quoted) return node.text;
  bool has_control = false;
  for (const char c : node.text) has_control |= static_cast<unsigned char>(c) < 0x20;
  std::string text;
  if (!has_control) {
    for (const char c : node.text) text += c == '\'' ? std::string("''") : std::string(1, c);
    return "'" + text + "'";
  }
  for (const char c : node.text) {
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (c == '\n') {
      text += "\\n";
    } else if (c == '\t') {
      text += "\\t";
    } else if (c == '\r') {
      text += "\\r";
    } else {
      text += c;
    }
  }
  return '"' + text + '"';
}

std::string flow(const Node& node) {
  std::string text;
  if (node.is_list()) {
    for (const Node& item : node.items) text += (text.empty() ? "" : ", ") + flow(item);
    return "[" + text + "]";
  }
  if (node.is_map()) {
    for (const Entry& e : node.entries) {
      text += (text.empty() ? "" : ", ") + e.key + ": " + flow(e.value);
    }
    return "{" + text + "}";
  }
  return scalar(node);
}

bool holds_map(const Node& node) {
  for (const Node& item : node.items) {
    if (item.is_map() || holds_map(item)) return true;
  }
  for (const Entry& e : node.entries) {
    if (e.value.is_map()) return true;
  }
  return false;
}

/// Maps of one level go on one line where they fit; lists of numbers always.
bool is_flow(const Node& node, std::size_t column) {
  if (node.is_list()) return !holds_map(node);
  if (!node.is_map()) return true;
  return node.entries.empty() || (!holds_map(node) && column + flow(node).size() <= k_line);
}

void block(const Node& node, std::size_t indent, std::string& out) {
  const std::string margin(indent, ' ');
  for (const Entry& e : node.entries) {
    const std::string head = margin + e.key + ":";
    if (is_flow(e.value, head.size() + 1)) {
      out += head + " " + flow(e.value) + "\n";
    } else if (e.value.is_map()) {
      out += head + "\n";
      block(e.value, indent + 2, out);
    } else {
      out += head + "\n";
      for (const Node& item : e.value.items) {
        std::string inner;
        block(item, indent + 4, inner);
        inner[indent + 2] = '-';
        out += inner;
      }
    }
  }
}

}  // namespace

std::string emit_yaml(const Node& root) {
  std::string out;
  block(root, 0, out);
  return out;
}

}  // namespace dust::scenario
