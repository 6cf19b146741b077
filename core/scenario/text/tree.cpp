// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/tree.hpp"

#include "base/utf8.hpp"
#include "scenario/text/suggest.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <regex>
#include <sstream>
#include <string_view>

namespace dust::scenario {
namespace {

/// Largest number of pieces of one scenario: aliases of aliases would otherwise fill the memory.
constexpr std::size_t k_max_nodes = 200000;
/// Deepest nesting, far above what a scenario needs and far below what the stack holds.
constexpr std::size_t k_deepest = 64;

/// Ends a parse whose problem has been told.
struct Stop {};

std::size_t count_nodes(const Node& node) {
  std::size_t n = 1;
  for (const Node& item : node.items) n += count_nodes(item);
  for (const Entry& entry : node.entries) n += count_nodes(entry.value);
  return n;
}

/// Builds our tree from the parser's events: with the place of every key, and with duplicate keys
/// seen, both of which the library's own tree hides.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const std::string& file, bool is_command_line,
              Diagnostics& diagnostics)
      : text_(text), file_(file), is_command_line_(is_command_line), diagnostics_(diagnostics) {}

  Node& root() { return root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node;
    node.where = mark_of(mark);
    node.text = null_at(mark);
    if (!open_.empty() && open_.back().has_key) node.where = open_.back().key_mark;
    put(std::move(node), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check_tag(mark, tag);
    Node node = Node::make_text(value, tag == "!");
    node.where = mark_of(mark);
    // Plain words that YAML 1.2 reads as nothing.
    if (!node.is_quoted && (value.empty() || value == "~" || value == "null")) {
      node.kind = Node::Kind::nothing;
    }
    put(std::move(node), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    if (found == anchored_.end()) {
      diagnostics_.error(mark_of(mark), "the alias refers to a part that contains it");
      throw Stop{};
    }
    put(Node(found->second), 0);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Node node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    bool is_key_usable = false;
    std::string key;
    Mark key_mark;
  };

  [[nodiscard]] Mark mark_of(const YAML::Mark& mark) const {
    if (is_command_line_) return {file_, 0, 0};
    return mark.is_null() ? Mark{file_, 1, 1} : Mark{file_, mark.line + 1, mark.column + 1};
  }
  /// The word that means nothing; empty where there is none.
  [[nodiscard]] std::string null_at(const YAML::Mark& mark) const {
    if (mark.is_null() || static_cast<std::size_t>(mark.pos) >= text_.size()) return {};
    const auto rest = std::string_view(text_).substr(static_cast<std::size_t>(mark.pos));
    for (const char* word : {"~", "null", "Null", "NULL"}) {
      if (rest.starts_with(word)) return "null";
    }
    return {};
  }
  void check_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    diagnostics_.error(mark_of(mark),
                       "tags like '" + printable(tag) + "' are not used in scenarios");
    throw Stop{};
  }
  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            Node::Kind kind) {
    check_tag(mark, tag);
    if (open_.size() >= k_deepest) {
      diagnostics_.error(mark_of(mark),
                         "nested more than " + std::to_string(k_deepest) + " levels deep");
      throw Stop{};
    }
    Open next;
    next.node.kind = kind;
    next.node.where = mark_of(mark);
    next.anchor = anchor;
    open_.push_back(std::move(next));
  }
  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    put(std::move(done.node), done.anchor);
  }
  void put(Node node, YAML::anchor_t anchor) {
    nodes_ += count_nodes(node);
    if (nodes_ > k_max_nodes) {
      diagnostics_.error(node.where, "the scenario is too large (aliases that multiply?)");
      throw Stop{};
    }
    if (anchor != 0) anchored_[anchor] = node;
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.is_list()) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      take_key(parent, node);
    } else {
      parent.has_key = false;
      if (parent.is_key_usable) {
        parent.node.entries.push_back({parent.key, parent.key_mark, std::move(node)});
      }
    }
  }
  void take_key(Open& parent, const Node& node) {
    parent.has_key = true;
    parent.key = node.text;
    parent.key_mark = node.where;
    parent.is_key_usable = node.is_text();
    if (!node.is_text()) {
      diagnostics_.error(node.where, "a key must be a word, not " + kind_text(node));
      return;
    }
    if (node.is_word("<<")) {
      parent.is_key_usable = false;
      diagnostics_.error(node.where,
                         "YAML's merge keys (<<) are not supported: an interaction takes the laws "
                         "of another with 'like', a scenario the keys of another file with "
                         "'include'; a whole value is repeated with an alias (*name)");
      return;
    }
    if (const Entry* first = parent.node.find(parent.key)) {
      parent.is_key_usable = false;
      std::string text = "duplicate key '" + printable(parent.key) + "'";
      if (first->where.line > 0)
        text += ": already given in line " + std::to_string(first->where.line);
      diagnostics_.error(parent.key_mark, std::move(text));
    }
  }

  const std::string& text_;
  std::string file_;
  bool is_command_line_;
  Diagnostics& diagnostics_;
  Node root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Node> anchored_;
  std::size_t nodes_ = 0;
};

/// Length of the UTF-8 character at `text[at]`, 0 when it is none that YAML allows.
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const bool is_control = first < 0x20 || first == 0x7f;
  if (is_control && first != '\n' && first != '\r' && first != '\t') return 0;
  return base::utf8_length(text, at);
}

/// Refuses what is not text before the parser sees it; true if all is well.
bool check_encoding(const std::string& text, const std::string& file, bool is_command_line,
                    Diagnostics& diagnostics) {
  Mark mark{file, 1, 1};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = character_length(text, at);
    if (n == 0) {
      if (is_command_line) mark = {file, 0, 0};
      diagnostics.error(mark, "not a text in UTF-8");
      return false;
    }
    if (text[at] == '\n') {
      ++mark.line;
      mark.column = 1;
    } else {
      ++mark.column;
    }
    at += n;
  }
  return true;
}

}  // namespace

Node Node::make_map() {
  Node node;
  node.kind = Kind::map;
  return node;
}

Node Node::make_list() {
  Node node;
  node.kind = Kind::list;
  return node;
}

Node Node::make_text(std::string text, bool is_quoted) {
  Node node;
  node.kind = Kind::text;
  node.text = std::move(text);
  node.is_quoted = is_quoted;
  return node;
}

void add(Node& map, std::string key, Node value) {
  map.entries.push_back({std::move(key), {}, std::move(value)});
}

bool Node::is_word(std::string_view word) const {
  return kind == Kind::text && !is_quoted && text == word;
}

const Entry* Node::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

Entry* find(Node& map, std::string_view key) {
  return const_cast<Entry*>(std::as_const(map).find(key));
}

std::string kind_text(const Node& node) {
  switch (node.kind) {
    case Node::Kind::text:
      return in_quotes(node.text);
    case Node::Kind::list:
      return "a list";
    case Node::Kind::map:
      return "a map of keys";
    case Node::Kind::nothing:
      break;
  }
  return "nothing";
}

namespace {

/// A path with an index, "interactions[0].contact", ends a {...} at its bracket: the commonest
/// slip.
std::string bracket_hint(const std::string& text, const YAML::Mark& mark) {
  if (mark.is_null()) return {};
  std::istringstream lines(text);
  std::string line;
  for (int n = 0; n <= mark.line; ++n) std::getline(lines, line);
  static const std::regex path(R"([A-Za-z_]+\[[0-9]+\][A-Za-z0-9_.\[\]]*)");
  std::smatch found;
  if (line.find('{') == std::string::npos || !std::regex_search(line, found, path)) return {};
  return "; a key with brackets stands in quotes: '" + found.str() + "'";
}

/// What to look for, in the words of somebody who writes the file; the parser tells what it missed.
std::string remedy_of(const std::string& problem) {
  static const std::pair<const char*, const char*> remedies[] = {
      {"end of map not found",
       ": this line or one above it is indented by other than those beside it; keys of one block "
       "begin in one column"},
      {"end of map flow not found", ": a '}' or a ',' is missing here or above"},
      {"end of sequence flow not found", ": a ']' or a ',' is missing here or above"},
      {"illegal map value",
       ": the line above lacks its ':', or a text that holds one needs quotes"},
      {"illegal EOF in scalar", ": a quote that was opened is never closed"}};
  for (const auto& [name, remedy] : remedies) {
    if (problem == name) return remedy;
  }
  return {};
}

/// Where a tab indents the line of the problem, or those above it: YAML takes spaces alone, and its
/// parser tells of what follows. Inside brackets tabs are allowed.
std::optional<Mark> indenting_tab(const std::string& text, const YAML::Exception& problem,
                                  const std::string& file) {
  if (problem.mark.is_null() || problem.msg.find("flow") != std::string::npos) return std::nullopt;
  std::istringstream lines(text);
  std::string line;
  std::optional<Mark> first;
  for (int n = 0; n <= problem.mark.line && std::getline(lines, line); ++n) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::size_t tab = line.find('\t');
    const bool is_indenting = begin != std::string::npos && tab < begin;
    if (!is_indenting) first.reset();
    if (is_indenting && !first) first = Mark{file, n + 1, static_cast<int>(tab) + 1};
  }
  return first;
}

}  // namespace

std::optional<Node> parse_yaml(const std::string& text, const std::string& file,
                               bool is_command_line, Diagnostics& diagnostics) {
  if (!check_encoding(text, file, is_command_line, diagnostics)) return std::nullopt;
  TreeBuilder builder(text, file, is_command_line, diagnostics);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    TreeBuilder rest(text, file, is_command_line, diagnostics);
    if (parser && parser.HandleNextDocument(rest) && rest.root().kind != Node::Kind::nothing) {
      diagnostics.error(rest.root().where, "a second document: one file holds one scenario");
      return std::nullopt;
    }
  } catch (const Stop&) {
    return std::nullopt;
  } catch (const YAML::Exception& problem) {
    if (const auto tab = indenting_tab(text, problem, file); tab && !is_command_line) {
      diagnostics.error(*tab, "not valid YAML: a tab indents this line: write spaces instead");
      return std::nullopt;
    }
    const Mark where = is_command_line || problem.mark.is_null()
                           ? Mark{file, is_command_line ? 0 : 1, is_command_line ? 0 : 1}
                           : Mark{file, problem.mark.line + 1, problem.mark.column + 1};
    const std::string brackets = bracket_hint(text, problem.mark);
    const std::string hint = brackets.empty() ? remedy_of(problem.msg) : brackets;
    diagnostics.error(where, "not valid YAML: " + problem.msg + hint);
    return std::nullopt;
  } catch (const std::exception&) {
    diagnostics.error({file, is_command_line ? 0 : 1, is_command_line ? 0 : 1}, "not valid YAML");
    return std::nullopt;
  }
  return std::move(builder.root());
}

}  // namespace dust::scenario
