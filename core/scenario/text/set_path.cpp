// SPDX-License-Identifier: Apache-2.0
#include "base/process/shell_word.hpp"
#include "scenario/interactions/pair_list.hpp"
#include "scenario/text/overlay.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

/// Single values of a scenario, set by their paths.
namespace dust::scenario {
namespace {

/// One step of a dotted path: a key, or an index into a list.
struct Step {
  std::string key;
  std::size_t index = 0;
  bool is_index = false;
};

std::optional<std::vector<Step>> parse_path(const std::string& path) {
  std::vector<Step> steps;
  std::size_t at = 0;
  const auto is_end_of_key = [](char c) { return c == '.' || c == '[' || c == ']'; };
  while (at < path.size()) {
    if (path[at] == '[') {
      const std::size_t end = path.find(']', at);
      const std::string digits = path.substr(at + 1, end == std::string::npos ? 0 : end - at - 1);
      constexpr std::size_t k_max_digits = 6;
      if (steps.empty() || digits.empty() || digits.size() > k_max_digits ||
          digits.find_first_not_of("0123456789") != std::string::npos) {
        return std::nullopt;
      }
      steps.push_back({.key = {}, .index = std::stoul(digits), .is_index = true});
      at = end + 1;
      if (at < path.size() && path[at] == '.' && at + 1 < path.size()) {
        ++at;
      } else if (at < path.size() && path[at] != '[') {
        return std::nullopt;
      }
      continue;
    }
    std::size_t end = at;
    while (end < path.size() && !is_end_of_key(path[end])) ++end;
    if (end == at) return std::nullopt;
    steps.push_back({.key = path.substr(at, end - at)});
    at = end;
    if (at < path.size() && path[at] == '.') {
      if (++at == path.size()) return std::nullopt;
    } else if (at < path.size() && path[at] == ']') {
      return std::nullopt;
    }
  }
  return steps.empty() ? std::nullopt : std::optional(steps);
}

/// Blocks whose keys are names the user gives: a new name is not a typing error of the engine's
/// keys, but setting one value of an object that is not there is.
const char* thing_in(const std::string& block) {
  if (block == "materials") return "material";
  if (block == "bodies") return "body";
  if (block == "emitters") return "emitter";
  if (block == "sensors") return "sensor";
  if (block == "frames") return "frame";
  return nullptr;
}

std::vector<std::string> keys_of(const Node& map) {
  std::vector<std::string> keys;
  for (const Entry& entry : map.entries) keys.push_back(entry.key);
  return keys;
}

std::string joined(const std::vector<Step>& steps, std::size_t count) {
  std::string path;
  for (std::size_t n = 0; n < count; ++n) {
    if (steps[n].is_index) {
      path.append("[").append(std::to_string(steps[n].index)).append("]");
    } else {
      path.append(path.empty() ? "" : ".").append(steps[n].key);
    }
  }
  return path;
}

/// Why there is no such element; empty where there is.
std::string element_problem(const Node& node, std::size_t index) {
  if (!node.is_list()) return " is not a list";
  if (index < node.items.size()) return "";
  return " has " + std::to_string(node.items.size()) + " elements, counted from 0";
}

/// Gives each number of a list the unit that the last one has for all, so that one of them can be
/// exchanged without the others.
void spread_unit(Node& list) {
  std::vector<std::string> units;
  for (const Node& item : list.items) {
    std::string problem;
    const auto number = item.is_text() ? split_number(item.text, problem) : std::nullopt;
    if (!number) return;
    units.emplace_back(number->unit);
  }
  const auto bare = std::count(units.begin(), units.end(), "");
  if (units.empty() || units.back().empty() || bare + 1 < std::ssize(units)) return;
  for (std::size_t n = 0; n + 1 < list.items.size(); ++n) list.items[n].text += " " + units.back();
}

/// Follows a path through a tree, makes what is not there yet, and puts a value at its end.
class PathWalk {
 public:
  PathWalk(Node& root, const std::vector<Step>& steps, const Node& value, const Mark& here,
           Diagnostics& diagnostics)
      : node_(&root), steps_(steps), value_(value), here_(here), diagnostics_(diagnostics) {}

  /// Where the value belongs; null where there is no such place, which is told, or the value has
  /// taken away what was there.
  Node* end() {
    for (at_ = 0; at_ < steps_.size(); ++at_) {
      if (!go(steps_[at_])) return nullptr;
    }
    return node_;
  }

 private:
  bool go(const Step& step) {
    if (step.is_index) return go_to_element(step.index);
    const bool is_pair = at_ == 1 && node_->is_list() && steps_.front().key == "interactions";
    return is_pair ? go_to_pair(step.key) : go_to_key(step.key);
  }
  bool go_to_element(std::size_t index) {
    if (const std::string problem = element_problem(*node_, index); !problem.empty()) {
      return refuse(so_far() + problem);
    }
    if (is_last() && value_.takes_away()) {
      return refuse("an element of a list cannot be taken away: give " + so_far() +
                    " anew, without it");
    }
    if (is_last()) spread_unit(*node_);
    node_ = &node_->items[index];
    return true;
  }
  bool go_to_pair(const std::string& key) {
    Node* const pair = find_pair(*node_, key);
    if (pair == nullptr) {
      return refuse("there is no interaction '" + printable(key) + "'" +
                    suggestion(key, pair_names(*node_), "there are"));
    }
    node_ = pair;
    return true;
  }
  bool go_to_key(const std::string& key) {
    if (!node_->is_map()) {
      return refuse(so_far() + " is " + kind_text(*node_) + " and has no key '" + printable(key) +
                    "'");
    }
    Entry* entry = find(*node_, key);
    if (value_.takes_away() && (entry == nullptr || is_last())) return take_away(key);
    if (entry == nullptr) entry = make(key);
    if (entry == nullptr) return false;
    if (is_last()) entry->where = here_;
    entry->is_of_other_model = false;
    if (is_last() && key == "model" && value_.is_text()) take_model(*node_, value_.text);
    node_ = &find(*node_, key)->value;
    return true;
  }
  /// A key that is not there yet.
  Entry* make(const std::string& key) {
    const char* thing = at_ == 1 ? thing_in(steps_.front().key) : nullptr;
    if (thing != nullptr && !(is_last() && value_.is_map())) {
      refuse(std::string("there is no ") + thing + " '" + printable(key) + "'" +
             suggestion(key, keys_of(*node_), "there are"));
      return nullptr;
    }
    Node made = Node::make_map();
    made.where = here_;
    node_->entries.push_back({key, here_, std::move(made)});
    return &node_->entries.back();
  }
  bool take_away(const std::string& key) {
    const auto gone = std::erase_if(node_->entries, [&](const Entry& e) { return e.key == key; });
    if (gone > 0) return false;
    return refuse("there is no '" + printable(key) + "' to take away in " +
                  (at_ == 0 ? "the scenario" : so_far()) +
                  suggestion(key, keys_of(*node_), "its keys are"));
  }
  bool refuse(const std::string& text) {
    diagnostics_.error(here_, text);
    return false;
  }
  [[nodiscard]] bool is_last() const { return at_ + 1 == steps_.size(); }
  [[nodiscard]] std::string so_far() const { return joined(steps_, at_); }

  Node* node_;
  const std::vector<Step>& steps_;
  const Node& value_;
  const Mark& here_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
};

}  // namespace

void set_path(Node& root, const std::string& path, Node value, const Mark& here,
              Diagnostics& diagnostics) {
  const auto steps = parse_path(path);
  if (!steps) {
    diagnostics.error(here,
                      "not the path of a key, like bodies.belt.speed or "
                      "interactions.sand-belt.contact.friction");
    return;
  }
  if (Node* const end = PathWalk(root, *steps, value, here, diagnostics).end()) {
    *end = std::move(value);
  }
}

void apply_override(Node& root, const Override& override, Diagnostics& diagnostics) {
  const Mark here{"--set " + printable(override.path), 0, 0};
  diagnostics.add_file(here.file);
  // Includes have been read by now; and a file that lies under the scenario is none that is set.
  if (override.path == "include" || override.path.starts_with("include[")) {
    diagnostics.error(here, "a file cannot be included by a setting: use --set-file " +
                                base::shell_word(printable(override.value)) +
                                ", which lies over the scenario");
    return;
  }
  auto value = parse_path(override.path) ? parse_yaml(override.value, here.file, true, diagnostics)
                                         : std::optional(Node{});
  if (!value) return;
  if (parse_path(override.path) && value->kind == Node::Kind::nothing && !value->takes_away()) {
    diagnostics.error(here,
                      "the value is missing: write --set " + printable(override.path) + "=VALUE");
    return;
  }
  set_path(root, override.path, std::move(*value), here, diagnostics);
}

}  // namespace dust::scenario
