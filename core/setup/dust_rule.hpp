// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dust::scenario {

/// What the `dust:` block of a scenario says.
struct DustSpec {
  double finer_than = std::numeric_limits<double>::infinity();  ///< [m]
  std::vector<double> classes;     ///< [m] sizes that are dust; empty = all
  std::vector<int> materials;      ///< indices into Setup::materials; empty = all
  std::vector<std::string> hoods;  ///< bodies with suction and sides that extract
  double steady_after = 0.0;       ///< [s] from which rates are means; 0 = half of the run
  double fall_height = 0.0;        ///< [m] of the load, for rules of practice; 0 = not known
  double open_area = 0.0;          ///< [m2] that air comes in through, likewise
};

/// Which grains are dust: judged by the diameter of the grains that one stands for, which is its
/// own over the `coarse_graining` of its material. The number of grains it counts for (its weight)
/// changes nothing.
class DustRule {
 public:
  /// Where a scenario says nothing: all that is finer than 100 um, where EN 481 ends.
  static constexpr double k_usual_limit = 100e-6;  ///< [m]

  DustRule() { spec_.finer_than = k_usual_limit; }
  /// `coarse_graining` by material.
  DustRule(DustSpec spec, std::vector<double> coarse_graining);

  /// Of a computed grain: `diameter` [m], `material` an index; -1 = not known, then as it is.
  [[nodiscard]] bool is_dust(double diameter, std::int64_t material = -1) const {
    return takes_size(represented(diameter, material)) && takes_material(material);
  }
  /// The diameter of the grains that one of this diameter stands for [m].
  [[nodiscard]] double represented(double diameter, std::int64_t material) const {
    const bool is_known =
        material >= 0 && material < static_cast<std::int64_t>(coarse_graining_.size());
    return is_known ? diameter / coarse_graining_[static_cast<std::size_t>(material)] : diameter;
  }
  /// "finer than 100 um" without the block's lists: [m], infinite where classes alone decide.
  [[nodiscard]] double limit() const { return spec_.finer_than; }
  [[nodiscard]] const DustSpec& spec() const { return spec_; }
  [[nodiscard]] std::span<const double> coarse_graining() const { return coarse_graining_; }

 private:
  [[nodiscard]] bool takes_size(double represented) const;
  [[nodiscard]] bool takes_material(std::int64_t material) const;

  DustSpec spec_;
  std::vector<double> coarse_graining_;
};

}  // namespace dust::scenario
