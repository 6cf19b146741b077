// SPDX-License-Identifier: Apache-2.0
#include "scenario/interactions/pair_list.hpp"

#include "scenario/text/overlay.hpp"
#include "scenario/text/suggest.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace dust::scenario {
namespace {

using Pair = std::pair<std::string, std::string>;

/// In alphabetical order; empty names where `node` is no pair.
Pair pair_of(const Node* node) {
  if (node == nullptr || !node->is_list() || node->items.size() != 2) return {};
  const std::string& a = node->items[0].text;
  const std::string& b = node->items[1].text;
  return std::minmax(a, b);
}

const Node* value_of(const Node& map, const char* key) {
  const Entry* entry = map.find(key);
  return entry == nullptr ? nullptr : &entry->value;
}

Pair pair_in(const Node& interaction) { return pair_of(value_of(interaction, "between")); }

std::string model_of(const Node& law) {
  const Node* model = value_of(law, "model");
  return model == nullptr ? std::string() : model->text;
}

/// As merge(), but a law under another name takes no parameters of the one before.
void merge_interaction(Node& base, Node over) {
  for (Entry& entry : over.entries) {
    Entry* same = find(base, entry.key);
    const std::string model = model_of(entry.value);
    if (same != nullptr && !model.empty() && model != model_of(same->value)) {
      same->value = Node::make_map();
    }
  }
  merge(base, std::move(over));
}

/// The interaction of `pair`; null if there is none.
Node* find(Node& interactions, const Pair& pair) {
  for (Node& one : interactions.items) {
    if (one.is_map() && !pair.first.empty() && pair_in(one) == pair) return &one;
  }
  return nullptr;
}

/// A pair that one file gives a second time, complete, so that the reader refuses it for that
/// alone.
Node repeated(const Node& first, Node again) {
  Node whole = first;
  whole.where = again.where;
  merge_interaction(whole, std::move(again));
  return whole;
}

/// Follows `like` from pair to pair.
class Completion {
 public:
  Completion(Node& interactions, Diagnostics& diagnostics)
      : interactions_(interactions), diagnostics_(diagnostics) {}

  void complete(Node& interaction) {
    const Entry* like = interaction.find("like");
    if (like == nullptr) return;
    const Entry taken = *like;
    const Pair pair = pair_of(&taken.value);
    if (pair.first.empty()) {
      diagnostics_.error(taken.where,
                         "like: two materials of another interaction are expected, "
                         "like [sand, belt], not " +
                             kind_text(taken.value));
      return;
    }
    Node* model = find(interactions_, pair);
    if (model == nullptr) {
      const std::string name = pair.first + "-" + pair.second;
      diagnostics_.error(taken.where, "like: there is no interaction between " + pair.first +
                                          " and " + pair.second +
                                          suggestion(name, pair_names(interactions_), "there are"));
      return;
    }
    if (std::find(open_.begin(), open_.end(), model) != open_.end() || model == &interaction) {
      diagnostics_.error(taken.where, "like: the interactions refer to each other in a circle");
      return;
    }
    open_.push_back(&interaction);
    complete(*model);
    open_.pop_back();
    if (model->find("like") != nullptr) return;  // told there
    std::erase_if(interaction.entries, [](const Entry& e) { return e.key == "like"; });
    Node whole = *model;
    whole.where = interaction.where;
    merge_interaction(whole, std::move(interaction));
    interaction = std::move(whole);
  }

 private:
  Node& interactions_;
  Diagnostics& diagnostics_;
  std::vector<const Node*> open_;
};

}  // namespace

Node* find_pair(Node& interactions, const std::string& name) {
  for (Node& one : interactions.items) {
    if (!one.is_map()) continue;
    const Pair pair = pair_in(one);
    if (pair.first.empty()) continue;
    if (name == pair.first + "-" + pair.second || name == pair.second + "-" + pair.first) {
      return &one;
    }
  }
  return nullptr;
}

std::vector<std::string> pair_names(const Node& interactions) {
  std::vector<std::string> names;
  for (const Node& one : interactions.items) {
    const Node* between = one.is_map() ? value_of(one, "between") : nullptr;
    if (!pair_of(between).first.empty()) {
      names.push_back(between->items[0].text + "-" + between->items[1].text);
    }
  }
  return names;
}

void merge_pairs(Node& base, Node over) {
  std::set<Pair> given;
  for (Node& one : over.items) {
    Node* same = one.is_map() ? find(base, pair_in(one)) : nullptr;
    const Mark where = one.where;
    if (same != nullptr && !given.insert(pair_in(one)).second) {
      base.items.push_back(repeated(*same, std::move(one)));
    } else if (same != nullptr) {
      std::erase_if(one.entries, [](const Entry& e) { return e.key == "between"; });
      merge_interaction(*same, std::move(one));
      same->where = where;
    } else {
      given.insert(pair_in(one));
      base.items.push_back(std::move(one));
    }
  }
  base.where = over.where;
}

void complete_pairs(Node& interactions, Diagnostics& diagnostics) {
  if (!interactions.is_list()) return;
  Completion completion(interactions, diagnostics);
  for (Node& one : interactions.items) {
    if (one.is_map()) completion.complete(one);
  }
}

}  // namespace dust::scenario
