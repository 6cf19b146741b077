// SPDX-License-Identifier: Apache-2.0
#include "particles/energy/working_contact.hpp"

#include "particles/forces/wall_contacts.hpp"

namespace dust::particles {
namespace {

using contact::BatchColumns;
using B = BatchColumns;
using sdk::Vec3;

Vec3 vector_of(BatchColumns& columns, int name, std::size_t q) {
  return {columns.column(name)[q], columns.column(name + 1)[q], columns.column(name + 2)[q]};
}

}  // namespace

ContactMotion& thread_motion() {
  thread_local ContactMotion motion;
  return motion;
}

void ContactMotion::take_pairs(BatchColumns& columns, std::size_t count) {
  for (std::size_t q = 0; q < count; ++q) {
    displacement_[q] = vector_of(columns, B::displacement_x, q);
    angle_i_[q] = vector_of(columns, B::angle_i_x, q);
    angle_j_[q] = vector_of(columns, B::angle_j_x, q);
    wall_[q] = {};
  }
}

void ContactMotion::set_particle(std::size_t q, Vec3 displacement, Vec3 angle) {
  displacement_[q] = displacement;
  angle_i_[q] = angle;
  angle_j_[q] = {};
}

void ContactMotion::take_walls(BatchColumns& columns, std::size_t count, bool is_turning) {
  for (std::size_t q = 0; q < count; ++q) {
    const double since = columns.column(k_wall_since)[q];
    wall_[q] = since * vector_of(columns, k_wall_mean_velocity, q);
    wall_angle_[q] = is_turning ? since * vector_of(columns, k_wall_mean_rotation, q) : Vec3{};
  }
}

void add_work(const WorkingContact& c, double* history, std::size_t stride, EnergySums& sums) {
  const auto old = [&](std::size_t n) -> double& { return history[n * stride]; };
  const double normal = dot(c.force, c.normal);
  const Vec3 tangential = c.force - normal * c.normal;
  const double normal_before = old(0);
  const Vec3 tangential_before{old(1), old(2), old(3)};
  const Vec3 couple_before{old(4), old(5), old(6)};
  const double half = 0.5 * c.weight;
  sums.normal -= half * (normal_before + normal) * c.approach;
  sums.tangential += half * dot(tangential_before + tangential, c.slip);
  sums.rolling += half * dot(couple_before + c.couple, c.turn);
  sums.walls +=
      half * dot((normal_before + normal) * c.normal + tangential_before + tangential, c.wall);
  sums.walls += half * dot(couple_before + c.couple, c.wall_angle);
  old(0) = normal;
  for (std::size_t d = 0; d < 3; ++d) {
    old(1 + d) = tangential[static_cast<int>(d)];
    old(4 + d) = c.couple[static_cast<int>(d)];
  }
}

}  // namespace dust::particles
