// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::io {

/// The settings of a resolved scenario, one by one in the order of the document: however they are
/// broken into lines.
class ScenarioLeaves {
 public:
  /// Throws base::RunError where the text is no scenario.
  explicit ScenarioLeaves(const std::string& resolved_yaml);

  /// "'time.end: 2' in the checkpoint, 'time.end: 3' now"; empty where both say the same but for
  /// `ignored` paths and what is below them.
  [[nodiscard]] std::string first_difference(const ScenarioLeaves& now,
                                             std::span<const std::string_view> ignored) const;
  /// The same of up to five settings, separated by ';', and how many more there are.
  [[nodiscard]] std::string differences(const ScenarioLeaves& now,
                                        std::span<const std::string_view> ignored) const;
  /// Whether both say the same below `path`, but for `ignored` paths.
  [[nodiscard]] bool is_same_below(const std::string& path, const ScenarioLeaves& other,
                                   std::span<const std::string_view> ignored = {}) const;
  /// What is set, without where.
  [[nodiscard]] std::vector<std::string> values() const;

 private:
  struct Leaf {
    std::string path;
    std::string value;
    bool operator==(const Leaf&) const = default;
  };
  template <class Takes>
  [[nodiscard]] std::vector<Leaf> chosen(const Takes& takes) const;

  std::vector<Leaf> leaves_;
};

}  // namespace dust::io
