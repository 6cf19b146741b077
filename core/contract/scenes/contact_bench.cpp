// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/contact_bench.hpp"

#include "contact/batch.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/sphere.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace dust::contract {
namespace {

using sdk::Vec3;

constexpr std::uint32_t k_contacts = 64;
constexpr double k_guard_value = -7.25e77;
const Vec3 k_axis = Vec3{1.0, 2.0, -0.5} / norm(Vec3{1.0, 2.0, -0.5});
constexpr double k_angle = 0.7;

/// Sets a column of the batch that not every version of the interface has.
template <class Batch>
void set_normal_stiffness(Batch& batch, double* column) {
  if constexpr (requires { batch.normal_stiffness; }) batch.normal_stiffness = column;
}

constexpr const char* k_names[] = {"overlap",
                                   "normal.x",
                                   "normal.y",
                                   "normal.z",
                                   "velocity.x",
                                   "velocity.y",
                                   "velocity.z",
                                   "angular_velocity.x",
                                   "angular_velocity.y",
                                   "angular_velocity.z",
                                   "displacement.x",
                                   "displacement.y",
                                   "displacement.z",
                                   "angle.x",
                                   "angle.y",
                                   "angle.z",
                                   "effective_radius",
                                   "effective_mass",
                                   "radius_i",
                                   "radius_j",
                                   "inverse_mass_i",
                                   "inverse_mass_j"};

}  // namespace

void require_history(int columns) {
  require(columns >= 0 && columns <= contact::k_max_history,
          "it keeps " + std::to_string(columns) + " numbers per contact; expected: 0 to " +
              std::to_string(contact::k_max_history) +
              ", which it shares with the other laws of the contact");
}

std::vector<Touch> standard_contacts(double range, int look) {
  std::vector<Touch> contacts;
  const sdk::Random random(5, sdk::stream_of("touches"));
  for (std::uint32_t n = 0; n < k_contacts; ++n) {
    const auto draw = [&](std::uint32_t slot) { return random.uniform(n, 0, slot); };
    const auto direction = [&](std::uint32_t slot) {
      const double z = 2.0 * draw(slot) - 1.0;
      const double angle = 6.283185307179586 * draw(slot + 1);
      const double flat = std::sqrt(1.0 - z * z);
      return Vec3{flat * std::cos(angle), flat * std::sin(angle), z};
    };
    Touch t;
    t.radius = 1e-4 + 9e-4 * draw(0);
    t.mass = 2500.0 * sdk::sphere_volume(2.0 * t.radius);
    t.overlap = (0.001 + 0.029 * draw(1)) * t.radius * (1.0 + 0.01 * look);
    if (range > 0.0 && n % 8 == 0) t.overlap = -range * draw(2);
    t.normal = direction(3);
    if (look > 0) t.normal = rotate(t.normal, direction(5), 1e-3 * look);
    t.velocity = 0.5 * direction(7);
    t.angular_velocity = 100.0 * direction(9);
    t.normal_force = (n % 8 == 1 ? -1.0 : 1.0) * 1e-3 * draw(11);
    t.stiffness = 1000.0 * draw(12);
    t.share_i = 0.2 + 0.6 * draw(13);
    contacts.push_back(t);
  }
  return contacts;
}

std::vector<Touch> swapped(std::vector<Touch> contacts) {
  for (Touch& t : contacts) {
    t.normal = -t.normal;
    t.velocity = -t.velocity;
    t.angular_velocity = -t.angular_velocity;
    t.share_i = 1.0 - t.share_i;
  }
  return contacts;
}

Vec3 turned(Vec3 v) { return rotate(v, k_axis, k_angle); }

std::vector<Touch> turned(std::vector<Touch> contacts) {
  for (Touch& t : contacts) {
    t.normal = turned(t.normal);
    t.velocity = turned(t.velocity);
    t.angular_velocity = turned(t.angular_velocity);
  }
  return contacts;
}

ContactBench::ContactBench(std::size_t count, int history)
    : count_((count + 7) / 8 * 8), stride_(count_ + k_guard), history_(history) {
  const auto columns = static_cast<std::size_t>(k_inputs + k_outputs + history);
  data_.assign(columns * stride_ + k_guard, k_guard_value);
  const auto address = reinterpret_cast<std::uintptr_t>(data_.data());
  constexpr std::uintptr_t k_line = 64;
  offset_ = (k_line - address % k_line) % k_line / sizeof(double);
  for (int h = 0; h < history; ++h) {
    std::fill_n(column(k_inputs + k_outputs + h), count_, 0.0);
  }
}

void ContactBench::show(const std::vector<Touch>& contacts, double time_step, const Units& units,
                        bool is_rolling) {
  const double length = units.length;
  const double speed = units.of(sdk::dimension::velocity);
  const double turning = units.of(sdk::dimension::angular_velocity);
  time_step_ = time_step * units.time;
  is_rolling_ = is_rolling;
  for (std::size_t n = 0; n < count_; ++n) {
    const Touch& t = contacts[n % contacts.size()];
    const Vec3 displacement = t.displacement.value_or(time_step * t.velocity);
    const Vec3 angle = t.angle.value_or(time_step * t.angular_velocity);
    const double row[k_inputs] = {t.overlap * length,
                                  t.normal.x,
                                  t.normal.y,
                                  t.normal.z,
                                  t.velocity.x * speed,
                                  t.velocity.y * speed,
                                  t.velocity.z * speed,
                                  t.angular_velocity.x * turning,
                                  t.angular_velocity.y * turning,
                                  t.angular_velocity.z * turning,
                                  displacement.x * length,
                                  displacement.y * length,
                                  displacement.z * length,
                                  angle.x,
                                  angle.y,
                                  angle.z,
                                  t.radius * length,
                                  t.mass * units.mass,
                                  t.radius / t.share_i * length,
                                  t.radius / (1.0 - t.share_i) * length,
                                  t.share_i / (t.mass * units.mass),
                                  (1.0 - t.share_i) / (t.mass * units.mass)};
    for (int c = 0; c < k_inputs; ++c) column(c)[n] = row[c];
    for (int c = 0; c < k_outputs; ++c) {
      column(k_inputs + c)[n] = std::numeric_limits<double>::quiet_NaN();
    }
    if (!is_rolling) continue;
    const double stiffness = t.stiffness * units.of(sdk::dimension::stiffness);
    column(k_inputs + normal_force)[n] = t.normal_force * units.of(sdk::dimension::force);
    column(k_inputs + normal_stiffness)[n] = stiffness;
    column(k_inputs + tangential_stiffness)[n] = stiffness;
    const Vec3 pushed = t.normal_force * t.normal;
    for (int d = 0; d < 3; ++d) {
      column(k_inputs + force + d)[n] = pushed[d] * units.of(sdk::dimension::force);
    }
  }
  before_ = data_;
}

void ContactBench::evaluate(const std::function<void(const sdk::ContactBatch&)>& evaluate,
                            std::size_t size) {
  if (size == 0) size = count_;
  std::vector<double*> history(static_cast<std::size_t>(history_));
  for (std::size_t first = 0; first < count_; first += size) {
    sdk::ContactBatch b;
    b.count = std::min(size, count_ - first);
    b.time_step = time_step_;
    const double** inputs[k_inputs] = {&b.overlap,
                                       &b.normal.x,
                                       &b.normal.y,
                                       &b.normal.z,
                                       &b.velocity.x,
                                       &b.velocity.y,
                                       &b.velocity.z,
                                       &b.angular_velocity.x,
                                       &b.angular_velocity.y,
                                       &b.angular_velocity.z,
                                       &b.displacement.x,
                                       &b.displacement.y,
                                       &b.displacement.z,
                                       &b.angle.x,
                                       &b.angle.y,
                                       &b.angle.z,
                                       &b.effective_radius,
                                       &b.effective_mass,
                                       &b.radius_i,
                                       &b.radius_j,
                                       &b.inverse_mass_i,
                                       &b.inverse_mass_j};
    for (int c = 0; c < k_inputs; ++c) *inputs[c] = column(c) + first;
    double* outputs[k_outputs];
    for (int c = 0; c < k_outputs; ++c) outputs[c] = column(k_inputs + c) + first;
    b.normal_force = outputs[normal_force];
    set_normal_stiffness(b, outputs[normal_stiffness]);
    b.tangential_stiffness = outputs[tangential_stiffness];
    b.force.x = outputs[force];
    b.force.y = outputs[force + 1];
    b.force.z = outputs[force + 2];
    b.torque.x = outputs[torque];
    b.torque.y = outputs[torque + 1];
    b.torque.z = outputs[torque + 2];
    for (int h = 0; h < history_; ++h) {
      history[static_cast<std::size_t>(h)] = column(k_inputs + k_outputs + h) + first;
    }
    b.history = history.data();
    evaluate(b);
  }
  check_untouched();
}

void ContactBench::check_untouched() const {
  const int columns = k_inputs + k_outputs + history_;
  for (int c = 0; c < columns; ++c) {
    for (std::size_t n = count_; n < stride_; ++n) {
      require(at(c, n) == k_guard_value, "it writes beyond the end of a column");
    }
  }
  const auto is_same = [&](int c) {
    for (std::size_t n = 0; n < count_; ++n) {
      const std::size_t place = offset_ + static_cast<std::size_t>(c) * stride_ + n;
      const bool both_nan = std::isnan(before_[place]) && std::isnan(data_[place]);
      if (before_[place] != data_[place] && !both_nan) return false;
    }
    return true;
  };
  for (int c = 0; c < k_inputs; ++c) {
    require(is_same(c), std::string("it overwrites the input ") + k_names[c]);
  }
  if (is_rolling_) {
    require(is_same(k_inputs + normal_force) && is_same(k_inputs + tangential_stiffness),
            "it overwrites what the contact stage wrote");
  } else {
    require(is_same(k_inputs + torque), "it writes the torque, which belongs to the rolling stage");
  }
}

}  // namespace dust::contract
