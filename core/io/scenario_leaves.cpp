// SPDX-License-Identifier: Apache-2.0
#include "io/scenario_leaves.hpp"

#include "base/error.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <iterator>

namespace dust::io {
namespace {

template <class Visit>
void each_leaf(const YAML::Node& node, const std::string& path, const Visit& visit) {
  if (node.IsMap() && node.size() > 0) {
    for (const auto& entry : node) {
      each_leaf(entry.second, (path.empty() ? "" : path + ".") + entry.first.Scalar(), visit);
    }
  } else if (node.IsSequence() && node.size() > 0) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      each_leaf(node[i], path + "[" + std::to_string(i) + "]", visit);
    }
  } else {
    visit(path, node.IsScalar() ? node.Scalar() : "nothing");
  }
}

bool is_below(std::string_view path, std::string_view above) {
  if (!path.starts_with(above)) return false;
  return path.size() == above.size() || path[above.size()] == '.' || path[above.size()] == '[';
}

bool is_below_any(std::string_view path, std::span<const std::string_view> list) {
  return std::any_of(list.begin(), list.end(),
                     [&](std::string_view above) { return is_below(path, above); });
}

}  // namespace

ScenarioLeaves::ScenarioLeaves(const std::string& resolved_yaml) {
  try {
    each_leaf(YAML::Load(resolved_yaml), "", [&](const std::string& path, std::string value) {
      leaves_.push_back({path, std::move(value)});
    });
  } catch (const YAML::Exception& e) {
    throw base::RunError(std::string("its scenario cannot be read: ") + e.what());
  }
}

template <class Takes>
std::vector<ScenarioLeaves::Leaf> ScenarioLeaves::chosen(const Takes& takes) const {
  std::vector<Leaf> taken;
  std::copy_if(leaves_.begin(), leaves_.end(), std::back_inserter(taken),
               [&](const Leaf& leaf) { return takes(leaf.path); });
  return taken;
}

std::string ScenarioLeaves::first_difference(const ScenarioLeaves& now,
                                             std::span<const std::string_view> ignored) const {
  const auto takes = [&](const std::string& path) { return !is_below_any(path, ignored); };
  const std::vector<Leaf> a = chosen(takes);
  const std::vector<Leaf> b = now.chosen(takes);
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (in_a == a.end() && in_b == b.end()) return "";
  const auto show = [](auto leaf, auto end) {
    return leaf == end ? std::string("nothing more") : "'" + leaf->path + ": " + leaf->value + "'";
  };
  return show(in_a, a.end()) + " in the checkpoint, " + show(in_b, b.end()) + " now";
}

std::string ScenarioLeaves::differences(const ScenarioLeaves& now,
                                        std::span<const std::string_view> ignored) const {
  constexpr std::size_t k_shown = 5;
  const auto takes = [&](const std::string& path) { return !is_below_any(path, ignored); };
  const std::vector<Leaf> before = chosen(takes);
  const std::vector<Leaf> after = now.chosen(takes);
  const auto show = [](const std::vector<Leaf>& leaves, const std::string& path) {
    const auto found = std::find_if(leaves.begin(), leaves.end(),
                                    [&](const Leaf& leaf) { return leaf.path == path; });
    return found == leaves.end() ? "nothing" : "'" + path + ": " + found->value + "'";
  };
  std::string text;
  std::size_t count = 0;
  const auto compare = [&](const std::string& path) {
    const std::string a = show(before, path);
    const std::string b = show(after, path);
    if (a == b || ++count > k_shown) return;
    text += (text.empty() ? "" : "; ") + a + " in the checkpoint, " + b + " now";
  };
  for (const Leaf& leaf : before) compare(leaf.path);
  for (const Leaf& leaf : after) {
    if (show(before, leaf.path) == "nothing") compare(leaf.path);
  }
  if (count > k_shown) text += "; and " + std::to_string(count - k_shown) + " more";
  return text.empty() ? first_difference(now, ignored) : text;  // in another order
}

bool ScenarioLeaves::is_same_below(const std::string& path, const ScenarioLeaves& other,
                                   std::span<const std::string_view> ignored) const {
  const auto takes = [&](const std::string& leaf) {
    return is_below(leaf, path) && !is_below_any(leaf, ignored);
  };
  return chosen(takes) == other.chosen(takes);
}

std::vector<std::string> ScenarioLeaves::values() const {
  std::vector<std::string> values;
  values.reserve(leaves_.size());
  for (const Leaf& leaf : leaves_) values.push_back(leaf.value);
  return values;
}

}  // namespace dust::io
