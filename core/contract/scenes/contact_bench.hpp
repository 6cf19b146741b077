// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/as_kind.hpp"
#include "dust/sdk/contact_law.hpp"
#include "dust/sdk/vec3.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dust::contract {

/// Two materials that differ in everything.
inline sdk::MaterialProperties material(bool is_second, const Units& units) {
  const double density = units.of(sdk::dimension::density);
  const double pressure = units.of(sdk::dimension::pressure);
  if (is_second) return {1200.0 * density, 5e6 * pressure, 0.4};
  return {2500.0 * density, 1e7 * pressure, 0.3};
}

/// Throws a Violation for a number of history columns that the core has no room for.
void require_history(int columns);

/// One contact as the core would show it, in SI.
struct Touch {
  double overlap = 0.0;
  sdk::Vec3 normal, velocity, angular_velocity;
  double radius = 0.0, mass = 0.0;  // R*, m*
  /// Of R* over the radius of side i, and of m* over its mass; the other side has the rest.
  double share_i = 0.5;
  double normal_force = 0.0, stiffness = 0.0;  ///< inputs of the rolling stage
  /// Since the last look; without them that of a straight course over the time step.
  std::optional<sdk::Vec3> displacement, angle;
};

/// Contacts of all directions, speeds and sizes, always the same ones. Overlaps reach from
/// `-range` to 3 % of the radius; the second look at a contact is turned and pressed a little on.
std::vector<Touch> standard_contacts(double range, int look);

/// The same contacts seen from side j.
std::vector<Touch> swapped(std::vector<Touch> contacts);
/// The same contacts in a turned world, and a vector turned alike.
std::vector<Touch> turned(std::vector<Touch> contacts);
sdk::Vec3 turned(sdk::Vec3 v);

/// Columns with guards behind every one of them, history included; tells who writes where.
class ContactBench {
 public:
  enum Output {
    normal_force,
    normal_stiffness,
    tangential_stiffness,
    force,
    torque = 6,
    k_outputs = 9
  };

  ContactBench(std::size_t count, int history);

  /// Fills the inputs (SI times `units`) and forgets the outputs, not the history. For the rolling
  /// stage force and stiffness are inputs.
  void show(const std::vector<Touch>& contacts, double time_step, const Units& units,
            bool is_rolling);
  /// Calls `evaluate` in batches of `size` rows (0 = all); Violation where a guard or an input was
  /// overwritten.
  void evaluate(const std::function<void(const sdk::ContactBatch&)>& evaluate, std::size_t size);

  [[nodiscard]] double output(int column, std::size_t row) const {
    return at(k_inputs + column, row);
  }
  [[nodiscard]] sdk::Vec3 vector(int first, std::size_t row) const {
    return {output(first, row), output(first + 1, row), output(first + 2, row)};
  }
  [[nodiscard]] double history(int column, std::size_t row) const {
    return at(k_inputs + k_outputs + column, row);
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  static constexpr int k_inputs = 22;
  static constexpr std::size_t k_guard = 8;
  [[nodiscard]] double at(int column, std::size_t row) const {
    return data_[offset_ + static_cast<std::size_t>(column) * stride_ + row];
  }
  double* column(int n) { return data_.data() + offset_ + static_cast<std::size_t>(n) * stride_; }
  void check_untouched() const;

  std::size_t count_;
  std::size_t stride_;
  std::size_t offset_ = 0;  ///< to the first address that is a multiple of 64 bytes
  int history_;
  double time_step_ = 0.0;
  bool is_rolling_ = false;
  std::vector<double> data_;
  std::vector<double> before_;
};

}  // namespace dust::contract
