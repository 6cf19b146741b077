// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/overlay.hpp"

#include "scenario/interactions/pair_list.hpp"

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

}  // namespace

std::optional<Node> read_with_includes(const fs::path& file, Diagnostics& diagnostics) {
  return IncludeReader(diagnostics).read_whole(file);
}

void take_model(Node& map, const std::string& model) {
  const Entry* before = find(map, "model");
  if (before == nullptr || !before->value.is_text() || before->value.text == model) return;
  for (Entry& entry : map.entries) entry.is_of_other_model = entry.key != "model";
}

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

}  // namespace dust::scenario
