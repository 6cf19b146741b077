// SPDX-License-Identifier: Apache-2.0
#include "messages/places.hpp"

#include "scenario/blocks.hpp"

#include <cmath>
#include <sstream>

namespace dust::test {
namespace {

using scenario::Entry;
using scenario::Node;
using sdk::Parameter;
using sdk::ParameterSchema;
using sdk::ParameterType;

const Parameter* find(const ParameterSchema& schema, const std::string& name) {
  for (const Parameter& p : schema) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

/// The engine's own blocks by the first key they stand under.
std::vector<const ParameterSchema*> blocks_of(const std::vector<std::string>& keys) {
  using namespace scenario;
  if (keys.empty()) return {&GeneralBlock::schema()};
  const std::string& top = keys.front();
  if (top == "time") return {&TimeBlock::schema()};
  if (top == "domain" && keys.size() > 1) return {&SideBlock::schema()};
  if (top == "domain") return {&DomainBlock::schema()};
  if (top == "materials") return {&MaterialBlock::schema()};
  if (top == "interactions") return {&InteractionBlock::schema()};
  if (top == "frames") return {&FrameBlock::schema()};
  if (keys.back() == "remove") return {&RemovalBlock::schema()};
  if (keys.back() == "suction") return {&SuctionBlock::schema()};
  if (top == "bodies") return {&PlacedBlock::schema(), &BodyBlock::schema()};
  if (top == "emitters") return {&PlacedBlock::schema()};
  if (top == "sensors") return {&SensorBlock::schema()};
  if (top == "fluid" && keys.size() > 1) return {&RegionBlock::schema()};
  if (top == "fluid") return {&FluidBlock::schema()};
  if (top == "coupling") return {&CouplingBlock::schema()};
  if (top == "references") return {&ReferenceBlock::schema()};
  if (top == "reference_curves") return {&ReferenceCurveBlock::schema()};
  return {};
}

bool reads_as_number(const std::string& text) {
  return !text.empty() && text.find_first_of("0123456789") != std::string::npos &&
         text.find_first_not_of("0123456789.+-eE") == std::string::npos;
}

class Walk {
 public:
  explicit Walk(const registry::Registry& registry) : registry_(registry) {}

  void map(const Node& node, const std::string& path) {
    for (const Entry& entry : node.entries) {
      const std::string inner = path.empty() ? entry.key : path + "." + entry.key;
      const bool is_name = names_things();
      places_.push_back({.kind = is_name ? Place::Kind::name_of_user : Place::Kind::key,
                         .path = inner,
                         .where = entry.where,
                         .text = entry.key,
                         .is_quoted = false,
                         .is_in_list = false,
                         .has_unit_of_last = false,
                         .parameter = nullptr});
      const Parameter* parameter = is_name ? nullptr : declared(node, entry.key);
      keys_.push_back(entry.key);
      value(entry.value, inner, parameter);
      keys_.pop_back();
    }
  }
  std::vector<Place> take() { return std::move(places_); }

 private:
  [[nodiscard]] bool names_things() const {
    if (keys_.size() == 1) {
      for (const char* block : {"materials", "frames", "bodies", "emitters", "sensors"}) {
        if (keys_.front() == block) return true;
      }
    }
    if (keys_.size() == 2) {
      return (keys_[0] == "fluid" && keys_[1] == "regions") ||
             (keys_[0] == "dust" && keys_[1] == "feed_zones");
    }
    return keys_.size() == 3 && keys_[0] == "dust" && keys_[1] == "field" &&
           (keys_[2] == "clouds" || keys_[2] == "sources");
  }
  void value(const Node& node, const std::string& path, const Parameter* parameter,
             const Node* list = nullptr) {
    Place place{.kind = Place::Kind::text,
                .path = path,
                .where = node.where,
                .text = node.text,
                .is_quoted = node.is_quoted,
                .is_in_list = list != nullptr,
                .has_unit_of_last = list != nullptr && &list->items.back() != &node &&
                                    !reads_as_number(list->items.back().text),
                .parameter = parameter};
    if (node.is_list()) place.kind = Place::Kind::list;
    if (node.is_map()) place.kind = Place::Kind::map;
    if (node.kind != Node::Kind::nothing) places_.push_back(place);
    for (std::size_t n = 0; n < node.items.size(); ++n) {
      value(node.items[n], path + "[" + std::to_string(n) + "]", parameter, &node);
    }
    if (node.is_map()) map(node, path);
  }
  /// Models declare the keys beside their names, blocks their own.
  [[nodiscard]] const Parameter* declared(const Node& node, const std::string& key) const {
    for (const char* chooser : {"model", "shape", "motion"}) {
      const Entry* name = node.find(chooser);
      if (name == nullptr || !name->value.is_text()) continue;
      for (const auto& entry : registry_.entries()) {
        if (entry.info.name != name->value.text) continue;
        if (const Parameter* p = find(entry.info.parameters, key)) return p;
      }
    }
    for (const ParameterSchema* schema : blocks_of(keys_)) {
      if (const Parameter* p = find(*schema, key)) return p;
    }
    return nullptr;
  }

  const registry::Registry& registry_;
  std::vector<std::string> keys_;
  std::vector<Place> places_;
};

std::string number(double v) {
  std::ostringstream text;
  text.precision(17);
  text << v;
  return text.str();
}

/// A number just outside the declared range, in SI; empty without a range.
std::vector<std::string> outside(const Parameter& p) {
  std::vector<std::string> all;
  const auto step = [](double v) { return std::max(1.0, std::abs(v)); };
  if (std::isfinite(p.range.low)) {
    all.push_back(number(p.range.low_is_open ? p.range.low : p.range.low - step(p.range.low)));
  }
  if (std::isfinite(p.range.high)) {
    all.push_back(number(p.range.high_is_open ? p.range.high : p.range.high + step(p.range.high)));
  }
  return all;
}

bool is_number(const Parameter& p) {
  return p.type == ParameterType::number || p.type == ParameterType::integer ||
         p.type == ParameterType::vector || p.type == ParameterType::numbers ||
         p.type == ParameterType::vectors;
}

/// "3 mm" in a list of numbers gives its unit to all: only the last one may hold a unit.
std::vector<Mistake> wrong_numbers(const Place& place) {
  std::vector<Mistake> all{{"a word for a number", "many"},
                           {"a unit that does not exist", "1 furlong"},
                           {"a number in hexadecimal", "0x1F"},
                           {"a number beyond all", "1e999"},
                           {"not a number", ".nan"},
                           {"two numbers", "1 2"},
                           {"a truth value", "true"}};
  const bool is_kelvin =
      place.parameter != nullptr && place.parameter->dimension == sdk::dimension::temperature;
  all.push_back({"a wrong dimension", is_kelvin ? "1 s" : "1 K"});
  if (place.parameter == nullptr) return all;
  for (const std::string& text : outside(*place.parameter)) {
    // 2 is out of a range of shares, 2 % is not.
    all.push_back({"a value out of range", text, !place.has_unit_of_last});
  }
  for (const char* text : {"0", "-1", "1e-300", "1e12", "-1e300"}) {
    all.push_back({"a number that is hardly meant", text, false});
  }
  return all;
}

}  // namespace

std::vector<Place> places_of(const Node& root, const registry::Registry& registry) {
  Walk walk(registry);
  walk.map(root, "");
  return walk.take();
}

std::vector<Mistake> mistakes_at(const Place& place) {
  switch (place.kind) {
    case Place::Kind::key:
      return {{"a misspelt key", place.text + "x"},
              {"a key with letters swapped", "zz" + place.text},
              {"a key given twice", place.text + ": 1, " + place.text}};
    case Place::Kind::name_of_user:
      return {{"a name that is none", "'no name'"}};
    case Place::Kind::list:
      return {{"garbage before a list", "@"}, {"a list in a list", "[[{a: [b]}], "}};
    case Place::Kind::map:
      return {};
    case Place::Kind::text:
      break;
  }
  std::vector<Mistake> all{{"a list of maps", "[[{a: [b]}]]"}, {"garbage", "@&*%"}};
  const Parameter* p = place.parameter;
  if (p != nullptr ? is_number(*p) : !place.is_quoted && reads_as_number(place.text)) {
    for (Mistake& one : wrong_numbers(place)) all.push_back(std::move(one));
    return all;
  }
  all.push_back({"a map", "{a: b}"});
  if (p != nullptr && p->type == ParameterType::boolean) {
    all.push_back({"a word for a truth value", "maybe"});
    all.push_back({"a truth value of YAML 1.1", "yes"});
    return all;
  }
  // Names: of models, of things, of files. Free texts may hold anything that is no list or map.
  const bool is_free = p != nullptr && p->options.empty() && p->refers == sdk::Refers::nothing &&
                       p->name != "frame" && p->name != "quantity";
  all.push_back({"a name that nothing bears", "nothing_bears_this", !is_free});
  all.push_back({"a name with a dot too many", place.text + "..", !is_free});
  // A model's own parameter may be empty where that is its default.
  const bool is_model = p != nullptr && p->name != "material" && p->name != "frame";
  all.push_back({"an empty name", "''", !is_free && !(is_model && !p->is_required)});
  return all;
}

}  // namespace dust::test
