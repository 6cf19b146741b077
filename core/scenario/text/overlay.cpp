// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/overlay.hpp"

#include "base/shell_word.hpp"
#include "scenario/interactions/pair_list.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace dust::scenario {
namespace {

namespace fs = std::filesystem;

/// No scenario is larger; the limit keeps a wrong file (results, pictures) from being parsed.
constexpr std::uintmax_t k_largest_file = 4u << 20;

std::optional<std::string> file_text(const fs::path& file, std::string& why) {
  std::error_code code;
  if (fs::is_directory(file, code)) {
    why = "is a folder, not a file";
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    why = std::string("cannot be read: ") + std::strerror(errno);
    return std::nullopt;
  }
  std::string text;
  std::vector<char> buffer(1u << 16);
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) ||
         stream.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > k_largest_file) {
      why = "is larger than 4 MB: not a scenario";
      return std::nullopt;
    }
  }
  return text;
}

/// Follows `include` and keeps the chain of open files, to see cycles.
class IncludeReader {
 public:
  explicit IncludeReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// The file with all that it includes; nothing where a part cannot be read: what that gives would
  /// be told to be missing.
  std::optional<Node> read_whole(const fs::path& file) {
    auto root = read(file, nullptr);
    return is_whole_ ? std::move(root) : std::nullopt;
  }

 private:
  static constexpr int k_max_files = 200;

  std::optional<Node> read(const fs::path& file, const Mark* from) {
    const std::string shown = file.generic_string();
    std::string why;
    const auto text = file_text(file, why);
    if (!text) {
      diagnostics_.error(from ? *from : Mark{shown, 0, 0},
                         from ? "include: " + shown + " " + why : why);
      return std::nullopt;
    }
    if (++files_read_ > k_max_files) {
      diagnostics_.error(from ? *from : Mark{shown, 0, 0}, "include: too many files");
      return std::nullopt;
    }
    diagnostics_.add_file(shown);
    diagnostics_.note_document(shown);
    if (text->starts_with(k_resolved_heading)) diagnostics_.note_resolved_file(shown);
    auto root = parse_yaml(*text, shown, false, diagnostics_);
    if (!root) return std::nullopt;
    if (root->kind == Node::Kind::nothing) {
      diagnostics_.error({shown, 1, 1},
                         "the file is empty: a scenario begins with keys like 'time:'");
      return std::nullopt;
    }
    if (!root->is_map()) {
      diagnostics_.error(
          root->where, "a scenario is a map of keys (time, domain, ...), not " + kind_text(*root));
      return std::nullopt;
    }
    const Entry* include = root->find("include");
    if (include == nullptr) return root;
    Entry taken = *include;
    std::erase_if(root->entries, [](const Entry& e) { return e.key == "include"; });
    open_.push_back(identity(file));
    Node merged = included(taken, file);
    open_.pop_back();
    merge_scenario(merged, std::move(*root));
    return merged;
  }
  static fs::path identity(const fs::path& file) {
    std::error_code code;
    fs::path same = fs::weakly_canonical(file, code);
    return code ? file : same;
  }
  Node included(const Entry& include, const fs::path& from) {
    Node base = Node::make_map();
    base.where = include.where;
    std::vector<Node> names =
        include.value.is_list() ? include.value.items : std::vector<Node>{include.value};
    for (const Node& name : names) {
      if (!name.is_text() || name.text.empty()) {
        diagnostics_.error(name.where, "include: a file name or a list of them is expected, not " +
                                           kind_text(name));
        is_whole_ = false;
        continue;
      }
      const fs::path file = (from.parent_path() / name.text).lexically_normal();
      if (std::find(open_.begin(), open_.end(), identity(file)) != open_.end()) {
        diagnostics_.error(name.where,
                           "include: " + file.generic_string() + " includes itself in a circle");
        is_whole_ = false;
        continue;
      }
      auto node = read(file, &name.where);
      is_whole_ = is_whole_ && node.has_value();
      if (node) merge_scenario(base, std::move(*node));
    }
    return base;
  }

  Diagnostics& diagnostics_;
  std::vector<fs::path> open_;
  int files_read_ = 0;
  bool is_whole_ = true;
};

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

}  // namespace

std::optional<Node> read_with_includes(const fs::path& file, Diagnostics& diagnostics) {
  return IncludeReader(diagnostics).read_whole(file);
}

namespace {

/// What a map gave beside another model, which may be that one's alone, need not fit.
void take_model(Node& map, const std::string& model) {
  const Entry* before = find(map, "model");
  if (before == nullptr || !before->value.is_text() || before->value.text == model) return;
  for (Entry& entry : map.entries) entry.is_of_other_model = entry.key != "model";
}

}  // namespace

void merge(Node& base, Node over) {
  if (!base.is_map() || !over.is_map()) {
    base = std::move(over);
    return;
  }
  const Entry* model = find(over, "model");
  if (model != nullptr && model->value.is_text()) take_model(base, model->value.text);
  for (Entry& entry : over.entries) {
    Entry* const same = find(base, entry.key);
    if (same != nullptr && entry.value.takes_away()) {
      base.entries.erase(base.entries.begin() + (same - base.entries.data()));
    } else if (same != nullptr) {
      if (!same->value.is_map() || !entry.value.is_map()) same->where = entry.where;
      merge(same->value, std::move(entry.value));
      same->is_of_other_model = false;
    } else {
      base.entries.push_back(std::move(entry));
    }
  }
  base.where = over.where;
}

void merge_scenario(Node& base, Node over) {
  Entry* below = base.is_map() ? find(base, "interactions") : nullptr;
  Entry* above = over.is_map() ? find(over, "interactions") : nullptr;
  if (below != nullptr && above != nullptr && below->value.is_list() && above->value.is_list()) {
    below->where = above->where;
    merge_pairs(below->value, std::move(above->value));
    std::erase_if(over.entries, [](const Entry& e) { return e.key == "interactions"; });
  }
  merge(base, std::move(over));
}

namespace {

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

void take_away(Node& map, const std::string& key, const std::string& path, const Mark& here,
               Diagnostics& diagnostics) {
  const auto gone = std::erase_if(map.entries, [&](const Entry& e) { return e.key == key; });
  if (gone > 0) return;
  diagnostics.error(here, "there is no '" + printable(key) + "' to take away in " +
                              (path.empty() ? "the scenario" : path) +
                              suggestion(key, keys_of(map), "its keys are"));
}

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
  Node* node = &root;
  for (std::size_t n = 0; n < steps->size(); ++n) {
    const Step& step = (*steps)[n];
    const std::string so_far = joined(*steps, n);
    if (step.is_index) {
      if (const std::string problem = element_problem(*node, step.index); !problem.empty()) {
        diagnostics.error(here, so_far + problem);
        return;
      }
      if (n + 1 == steps->size() && value.takes_away()) {
        diagnostics.error(here, "an element of a list cannot be taken away: give " + so_far +
                                    " anew, without it");
        return;
      }
      if (n + 1 == steps->size()) spread_unit(*node);
      node = &node->items[step.index];
      continue;
    }
    if (n == 1 && node->is_list() && steps->front().key == "interactions") {
      Node* pair = find_pair(*node, step.key);
      if (pair == nullptr) {
        diagnostics.error(here, "there is no interaction '" + printable(step.key) + "'" +
                                    suggestion(step.key, pair_names(*node), "there are"));
        return;
      }
      node = pair;
      continue;
    }
    if (!node->is_map()) {
      diagnostics.error(here, so_far + " is " + kind_text(*node) + " and has no key '" +
                                  printable(step.key) + "'");
      return;
    }
    Entry* entry = find(*node, step.key);
    const bool is_last = n + 1 == steps->size();
    if (value.takes_away() && (entry == nullptr || is_last)) {
      take_away(*node, step.key, so_far, here, diagnostics);
      return;
    }
    if (entry == nullptr) {
      const char* thing = n == 1 ? thing_in(steps->front().key) : nullptr;
      if (thing != nullptr && !(is_last && value.is_map())) {
        diagnostics.error(here, std::string("there is no ") + thing + " '" + printable(step.key) +
                                    "'" + suggestion(step.key, keys_of(*node), "there are"));
        return;
      }
      Node made = Node::make_map();
      made.where = here;
      node->entries.push_back({step.key, here, std::move(made)});
      entry = &node->entries.back();
    }
    if (is_last) entry->where = here;
    entry->is_of_other_model = false;
    if (is_last && step.key == "model" && value.is_text()) take_model(*node, value.text);
    node = &find(*node, step.key)->value;
  }
  *node = std::move(value);
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
