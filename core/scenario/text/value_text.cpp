// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"

#include <algorithm>
#include <cmath>

/// Values and what is known of their parameters as text.
namespace dust::scenario {
namespace {

bool is_plain(const std::string& text) {
  if (text.empty() || text == "true" || text == "false" || text == "null") return false;
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  if (!is_letter(text.front())) return false;
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
  });
}

Node number_node(double value) { return Node::make_text(number_text(value)); }
Node text_node(const std::string& text) { return Node::make_text(text, !is_plain(text)); }

}  // namespace

Node written_value(const sdk::Value& value) {
  if (const auto* v = std::get_if<double>(&value)) return number_node(*v);
  if (const auto* v = std::get_if<std::int64_t>(&value)) return Node::make_text(std::to_string(*v));
  if (const auto* v = std::get_if<bool>(&value)) return Node::make_text(*v ? "true" : "false");
  if (const auto* v = std::get_if<std::string>(&value)) return text_node(*v);
  const auto vector_node = [](const sdk::Vec3& v) {
    Node list = Node::make_list();
    list.items = {number_node(v.x), number_node(v.y), number_node(v.z)};
    return list;
  };
  if (const auto* v = std::get_if<sdk::Vec3>(&value)) return vector_node(*v);
  Node list = Node::make_list();
  if (const auto* v = std::get_if<std::vector<sdk::Vec3>>(&value)) {
    for (const sdk::Vec3& x : *v) list.items.push_back(vector_node(x));
    return list;
  }
  if (const auto* v = std::get_if<std::vector<double>>(&value)) {
    for (const double x : *v) list.items.push_back(number_node(x));
    return list;
  }
  if (const auto* v = std::get_if<std::vector<std::string>>(&value)) {
    for (const std::string& x : *v) list.items.push_back(text_node(x));
    return list;
  }
  return {};
}

std::string range_text(const sdk::Parameter& p) {
  const bool has_low = std::isfinite(p.range.low);
  const bool has_high = std::isfinite(p.range.high);
  if (!has_low && !has_high) return {};
  const std::string unit = si_unit(p.dimension);
  const std::string tail = unit.empty() ? "" : " " + unit;
  std::string text = p.symbol.empty() ? p.name : p.symbol;
  std::erase(text, '\\');  // symbols are TeX, messages are not
  if (has_low && has_high) {
    text = number_text(p.range.low) + (p.range.low_is_open ? " < " : " <= ") + text +
           (p.range.high_is_open ? " < " : " <= ") + number_text(p.range.high);
  } else if (has_low) {
    text += (p.range.low_is_open ? " > " : " >= ") + number_text(p.range.low);
  } else {
    text += (p.range.high_is_open ? " < " : " <= ") + number_text(p.range.high);
  }
  return text + tail;
}

std::string usual_text(const sdk::Parameter& p) {
  if (!std::isfinite(p.usual.low) || !std::isfinite(p.usual.high)) return {};
  const std::string unit = si_unit(p.dimension);
  return number_text(p.usual.low) + " to " + number_text(p.usual.high) +
         (unit.empty() ? "" : " " + unit);
}

std::string default_text(const sdk::Parameter& p) {
  if (p.is_required) return {};
  const Node node = written_value(p.default_value);
  std::string text;
  if (node.is_list()) {
    for (const Node& item : node.items) text += (text.empty() ? "" : ", ") + item.text;
    text = "[" + text + "]";
  } else {
    text = node.text;
  }
  const std::string unit = si_unit(p.dimension);
  return unit.empty() || text == "[]" ? text : text + " " + unit;
}

std::string type_text(sdk::ParameterType type) {
  switch (type) {
    case sdk::ParameterType::number:
      return "number";
    case sdk::ParameterType::integer:
      return "whole number";
    case sdk::ParameterType::boolean:
      return "true or false";
    case sdk::ParameterType::text:
      return "text";
    case sdk::ParameterType::vector:
      return "vector [x, y, z]";
    case sdk::ParameterType::numbers:
      return "list of numbers";
    case sdk::ParameterType::texts:
      return "list of texts";
    case sdk::ParameterType::vectors:
      return "list of vectors [[x, y, z], ...]";
  }
  return {};
}

}  // namespace dust::scenario
