// SPDX-License-Identifier: Apache-2.0
#include "io/scenario_leaves.hpp"

#include "base/error.hpp"
#include "io/run_files.hpp"

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

ScenarioLeaves::ScenarioLeaves(const std::string& resolved_yaml,
                               const std::vector<InputFile>& inputs) {
  try {
    each_leaf(YAML::Load(resolved_yaml), "", [&](const std::string& path, std::string value) {
      const auto file = std::find_if(inputs.begin(), inputs.end(), [&](const InputFile& input) {
        return input.written == value;
      });
      leaves_.push_back(
          {path, std::move(value), file == inputs.end() ? std::string() : file->sha256});
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
  const auto same = [](const Leaf& x, const Leaf& y) { return x.means_same(y); };
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end(), same);
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
  const auto found = [](const std::vector<Leaf>& leaves, const std::string& path) {
    const auto at = std::find_if(leaves.begin(), leaves.end(),
                                 [&](const Leaf& leaf) { return leaf.path == path; });
    return at == leaves.end() ? nullptr : &*at;
  };
  const auto show = [](const Leaf* leaf) {
    return leaf == nullptr ? "nothing" : "'" + leaf->path + ": " + leaf->value + "'";
  };
  std::string text;
  std::size_t count = 0;
  const auto compare = [&](const std::string& path) {
    const Leaf* a = found(before, path);
    const Leaf* b = found(after, path);
    if (a != nullptr && b != nullptr && a->means_same(*b)) return;
    if (++count > k_shown) return;
    text += (text.empty() ? "" : "; ") + show(a) + " in the checkpoint, " + show(b) + " now";
  };
  for (const Leaf& leaf : before) compare(leaf.path);
  for (const Leaf& leaf : after) {
    if (found(before, leaf.path) == nullptr) compare(leaf.path);
  }
  if (count > k_shown) text += "; and " + std::to_string(count - k_shown) + " more";
  return text.empty() ? first_difference(now, ignored) : text;  // in another order
}

bool ScenarioLeaves::is_same_below(const std::string& path, const ScenarioLeaves& other,
                                   std::span<const std::string_view> ignored) const {
  const auto takes = [&](const std::string& leaf) {
    return is_below(leaf, path) && !is_below_any(leaf, ignored);
  };
  const std::vector<Leaf> a = chosen(takes);
  const std::vector<Leaf> b = other.chosen(takes);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Leaf& x, const Leaf& y) { return x.means_same(y); });
}

std::vector<ScenarioLeaves::FileChange> ScenarioLeaves::files_since(
    const ScenarioLeaves& then) const {
  std::vector<FileChange> changes;
  for (const Leaf& leaf : leaves_) {
    const auto was = std::find_if(then.leaves_.begin(), then.leaves_.end(),
                                  [&](const Leaf& other) { return other.path == leaf.path; });
    if (was == then.leaves_.end() || (leaf.content.empty() && was->content.empty())) continue;
    changes.push_back({leaf.path, was->value, leaf.value, was->content, leaf.content});
  }
  return changes;
}

std::string ScenarioLeaves::sha256() const {
  Sha256 digest;
  for (const Leaf& leaf : leaves_) {
    const std::string& meant = leaf.content.empty() ? leaf.value : leaf.content;
    const std::string line = leaf.path + ": " + meant + "\n";
    digest.update(line.data(), line.size());
  }
  return digest.hex_digest();
}

std::vector<std::string> ScenarioLeaves::values() const {
  std::vector<std::string> values;
  values.reserve(leaves_.size());
  for (const Leaf& leaf : leaves_) values.push_back(leaf.value);
  return values;
}

}  // namespace dust::io
