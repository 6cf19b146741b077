// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/sensor.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dust::sdk {

/// Walls chosen by name: bodies, groups of bodies and sides of the domain.
class WallSelection {
 public:
  explicit WallSelection(std::vector<std::string> names) : names_(std::move(names)) {}

  /// Which of `walls` are chosen: for holds(), until the next call.
  void look(const WallColumns& walls) {
    is_chosen_.resize(walls.name.size());
    for (std::size_t n = 0; n < walls.name.size(); ++n) {
      is_chosen_[n] = has(walls.name[n]) || has(walls.group[n]);
    }
  }
  [[nodiscard]] bool holds(std::size_t wall) const { return is_chosen_[wall]; }
  [[nodiscard]] bool holds(std::int32_t wall) const {
    return is_chosen_[static_cast<std::size_t>(wall)];
  }
  [[nodiscard]] std::span<const std::string> names() const { return names_; }
  [[nodiscard]] bool is_empty() const { return names_.empty(); }

 private:
  [[nodiscard]] bool has(const std::string& name) const {
    return !name.empty() && std::find(names_.begin(), names_.end(), name) != names_.end();
  }

  std::vector<std::string> names_;
  std::vector<bool> is_chosen_;
};

/// Declares `walls`, the names of a WallSelection, of which `purpose` says what they are for.
template <class P>
auto& declare_walls(SchemaOf<P>& s, const std::string& purpose) {
  return s
      .texts(&P::walls, "walls",
             "Bodies, groups of bodies and sides of the domain " + purpose + ".")
      .refers_to(Refers::wall);
}

}  // namespace dust::sdk
