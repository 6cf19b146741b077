// SPDX-License-Identifier: Apache-2.0
#include "particles/store/particle_store.hpp"

#include "particles/dem.hpp"
#include "particles/motion/leapfrog.hpp"
#include "particles/store/reorder_rows.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <functional>

namespace dust::particles {
namespace {

using Rows = contact::AlignedVector<double>;

template <class T>
std::vector<std::int64_t> widened(const std::vector<T>& v) {
  return {v.begin(), v.end()};
}

void save_rows(sdk::ArchiveWriter& archive, const char* name, const Rows& rows) {
  archive.numbers(name, {rows.data(), rows.size()});
}

void load_rows(sdk::ArchiveReader& archive, const char* name, Rows& rows) {
  const auto values = archive.numbers(name);
  rows.assign(values.begin(), values.end());
}

}  // namespace

GrainRows ParticleStore::rows() {
  return {.count = size(),
          .position = position_.data(),
          .velocity = motion_.data(),
          .rotation = spin_.data(),
          .id = id_.data(),
          .material = material_.data(),
          .weight = weight_.data(),
          .drag_relaxation = of_fluid_.drag.data(),
          .fluid_impulse = of_fluid_.impulse.data(),
          .motion_stride = k_motion_stride,
          .wind = of_fluid_.keeps_wind ? of_fluid_.wind.data() : nullptr};
}

ParticleStore::Motion ParticleStore::motion() {
  return {position_.data(),      motion_.data(),         spin_.data(),    of_fluid_.impulse.data(),
          of_fluid_.drag.data(), of_fluid_.decay.data(), material_.data()};
}

void ParticleStore::append(const NewGrain& g, double mass, std::int32_t population) {
  const double radius = 0.5 * g.diameter;
  const sdk::Vec3& v = g.velocity;
  const sdk::Vec3& w = g.rotation;
  position_.insert(position_.end(), {g.position.x, g.position.y, g.position.z, radius});
  // Time since the last kick 0: the first one lasts half a step, as if positions and velocities had
  // come together.
  motion_.insert(motion_.end(), {v.x, v.y, v.z, 1.0 / mass, v.x, v.y, v.z, 0.0});
  spin_.insert(spin_.end(), {w.x, w.y, w.z, radius, w.x, w.y, w.z, radius});
  if (has_fluid_) {
    of_fluid_.drag.insert(of_fluid_.drag.end(), 4, 0.0);
    of_fluid_.impulse.insert(of_fluid_.impulse.end(), 4, 0.0);
    of_fluid_.decay.insert(of_fluid_.decay.end(), 2, 1.0);
  }
  if (of_fluid_.keeps_wind) of_fluid_.wind.insert(of_fluid_.wind.end(), 4, 0.0);
  id_.push_back(next_id_++);
  material_.push_back(g.material);
  population_.push_back(population);
  weight_.push_back(g.weight);
  if (has_openings_) touched_.push_back(-1);
}

void ParticleStore::transfer_from(const ParticleStore& other,
                                  std::span<const std::int32_t> materials,
                                  std::span<const std::int32_t> openings,
                                  std::span<const double> mass) {
  position_ = other.position_;
  motion_ = other.motion_;
  spin_ = other.spin_;
  id_ = other.id_;
  population_ = other.population_;
  weight_ = other.weight_;
  next_id_ = other.next_id_;
  material_.clear();
  for (const std::int32_t m : other.material_) {
    material_.push_back(materials[static_cast<std::size_t>(m)]);
  }
  for (std::size_t n = 0; n < size(); ++n) {
    velocity(n)[3] = 1.0 / mass[static_cast<std::size_t>(population_[n])];
  }
  if (has_fluid_ && other.has_fluid_) {
    of_fluid_.drag = other.of_fluid_.drag;
    of_fluid_.impulse = other.of_fluid_.impulse;
    of_fluid_.decay = other.of_fluid_.decay;
  } else if (has_fluid_) {
    of_fluid_.drag.assign(4 * size(), 0.0);
    of_fluid_.impulse.assign(4 * size(), 0.0);
    of_fluid_.decay.assign(2 * size(), 1.0);
  }
  if (of_fluid_.keeps_wind) keep_wind();
  set_openings(has_openings_);
  for (std::size_t n = 0; n < touched_.size() && n < other.touched_.size(); ++n) {
    if (other.touched_[n] >= 0) touched_[n] = openings[static_cast<std::size_t>(other.touched_[n])];
  }
}

void ParticleStore::reorder(std::span<const std::int32_t> order) {
  reorder_rows(position_, order, 4);
  for (auto* rows : {&motion_, &spin_}) reorder_rows(*rows, order, k_motion_stride);
  if (has_fluid_) {
    reorder_rows(of_fluid_.drag, order, 4);
    reorder_rows(of_fluid_.impulse, order, 4);
    reorder_rows(of_fluid_.decay, order, 2);
  }
  if (of_fluid_.keeps_wind) reorder_rows(of_fluid_.wind, order, 4);
  reorder_rows(id_, order, 1);
  reorder_rows(material_, order, 1);
  reorder_rows(population_, order, 1);
  reorder_rows(weight_, order, 1);
  if (has_openings_) reorder_rows(touched_, order, 1);
}

void ParticleStore::keep_wind() {
  of_fluid_.keeps_wind = true;
  of_fluid_.wind.assign(4 * size(), 0.0);
}

void ParticleStore::set_openings(bool has_openings) {
  has_openings_ = has_openings;
  touched_.assign(has_openings ? size() : 0, -1);
}

void ParticleStore::update_decay(double step) {
  has_drag_ = false;
  if (!has_fluid_) return;
  using Rows = oneapi::tbb::blocked_range<std::size_t>;
  constexpr std::size_t k_block = 4096;  // particles, some 0.1 ms
  has_drag_ = oneapi::tbb::parallel_reduce(
      Rows(0, size(), k_block), false,
      [&](const Rows& rows, bool has_drag) {
        for (std::size_t n = rows.begin(); n < rows.end(); ++n) {
          const double rate = of_fluid_.drag[4 * n + 3];
          has_drag = has_drag || rate * step > 0.0;
          const leapfrog::Relaxation relaxation = leapfrog::relaxation(rate, step);
          of_fluid_.decay[2 * n] = relaxation.decay;
          of_fluid_.decay[2 * n + 1] = relaxation.mean;
        }
        return has_drag;
      },
      std::logical_or<>());
}

bool ParticleStore::has_weights(std::size_t count) const {
  for (std::size_t n = 1; n < count; ++n) {
    if (weight_[n] != weight_[0]) return true;
  }
  return false;
}

std::uint64_t ParticleStore::position_digest() const {
  return base::Digest().add(position_).value();
}
std::uint64_t ParticleStore::motion_digest() const {
  return base::Digest().add(motion_).add(spin_).value();
}
std::uint64_t ParticleStore::drag_digest() const {
  return base::Digest().add(of_fluid_.drag).add(of_fluid_.decay).value();
}
std::uint64_t ParticleStore::impulse_digest() const {
  return base::Digest().add(of_fluid_.impulse).value();
}

void ParticleStore::save(sdk::ArchiveWriter& archive) const {
  save_rows(archive, "position", position_);
  save_rows(archive, "motion", motion_);
  save_rows(archive, "spin", spin_);
  if (has_fluid_) {
    save_rows(archive, "action", of_fluid_.drag);
    save_rows(archive, "impulse", of_fluid_.impulse);
    save_rows(archive, "decay", of_fluid_.decay);
  }
  archive.integers("id", id_);
  archive.integers("material", widened(material_));
  archive.integers("population", widened(population_));
  archive.numbers("weight", weight_);
  if (has_openings_) archive.integers("touched_opening", widened(touched_));
}

void ParticleStore::load(sdk::ArchiveReader& archive, std::int64_t next_id, bool has_drag) {
  next_id_ = next_id;
  has_drag_ = has_drag;
  load_rows(archive, "position", position_);
  load_rows(archive, "motion", motion_);
  load_rows(archive, "spin", spin_);
  if (has_fluid_) {
    load_rows(archive, "action", of_fluid_.drag);
    load_rows(archive, "impulse", of_fluid_.impulse);
    load_rows(archive, "decay", of_fluid_.decay);
  }
  id_ = archive.integers("id");
  const auto material = archive.integers("material");
  const auto population = archive.integers("population");
  material_.assign(material.begin(), material.end());
  population_.assign(population.begin(), population.end());
  weight_ = archive.numbers("weight");
  if (of_fluid_.keeps_wind) keep_wind();
  if (has_openings_) {
    const auto touched = archive.integers("touched_opening");
    touched_.assign(touched.begin(), touched.end());
  }
}

}  // namespace dust::particles
