// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/branch/origin.hpp"
#include "run/branch/used_models.hpp"
#include "scenario/reader.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::run {

/// A scenario beside that of the run which it starts from: what is the same, so that the state of
/// then still means the same now.
class Comparison {
 public:
  /// Reads the other run's scenario; `now` is kept by reference, `inputs` is what stands in the
  /// files of `now`.
  Comparison(const scenario::ReadResult& now, const std::vector<io::InputFile>& inputs,
             const registry::Registry& registry);

  [[nodiscard]] const scenario::ReadResult& now() const { return now_; }
  [[nodiscard]] const Origin& origin() const { return origin_; }
  [[nodiscard]] const std::vector<ChangedModel>& changes_of_models() const {
    return changed_models_;
  }

  /// Whether they differ in nothing that the state depends on; then, but for what lets things in
  /// and what looks at them.
  [[nodiscard]] bool is_same() const { return is_same_; }
  [[nodiscard]] bool is_same_world() const { return is_same_world_; }
  /// Whether both say the same below a key, leaving out keys `ignored`.
  [[nodiscard]] bool same(std::string_view path,
                          std::span<const std::string_view> ignored = {}) const;
  /// Whether a model is no longer the one that the state was kept by.
  [[nodiscard]] bool is_changed(std::string_view kind, std::string_view name) const;
  /// Whether a law keeps other numbers per contact: none of the histories can be told apart then.
  [[nodiscard]] bool has_other_histories() const;
  [[nodiscard]] bool is_same_grid() const;
  /// Whether grains keep the dust that they carry: what they came with is that of their materials.
  [[nodiscard]] bool keeps_loads() const;
  /// Whether what an emitter remembers, be it a number of grains, stands for the same mass.
  [[nodiscard]] bool has_same_densities(const scenario::EmitterSpec& ours,
                                        const scenario::EmitterSpec& theirs) const;
  /// Whether nothing differs but sensors, the end and what is written. Else it is another plant,
  /// and means over both would be of neither.
  [[nodiscard]] bool is_same_plant(const std::vector<double>& class_diameters) const;
  /// Whether what a sensor has added up is of what it looks at now.
  [[nodiscard]] bool keeps_statistics(const std::string& name,
                                      const std::vector<double>& class_diameters) const;

 private:
  const scenario::ReadResult& now_;
  Origin origin_;
  io::ScenarioLeaves leaves_;
  std::vector<ChangedModel> changed_models_;
  bool is_same_ = false;
  bool is_same_but_sensors_ = false;
  bool is_same_world_ = false;
};

}  // namespace dust::run
