// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/deferred_impulse.hpp"

#include "base/digest.hpp"

#include <algorithm>

namespace dust::particles {
namespace {

constexpr std::size_t k_numbers = 12;

bool is_earlier(const DeferredImpulse& a, const DeferredImpulse& b) {
  return a.particle < b.particle;
}

}  // namespace

DeferredImpulse& DeferredImpulse::operator+=(const DeferredImpulse& other) {
  velocity += other.velocity;
  angular_velocity += other.angular_velocity;
  predicted_velocity += other.predicted_velocity;
  predicted_angular_velocity += other.predicted_angular_velocity;
  return *this;
}

void DeferredImpulse::act_on(ParticleStore& particles) const {
  const auto n = static_cast<std::size_t>(particle);
  for (int d = 0; d < 3; ++d) {
    particles.half_velocity(n)[d] += velocity[d];
    particles.half_rotation(n)[d] += angular_velocity[d];
  }
}

void DeferredImpulses::merge() {
  std::stable_sort(impulses_.begin(), impulses_.end(), is_earlier);
  std::size_t kept = 0;
  for (std::size_t n = 0; n < impulses_.size(); ++n) {
    if (n > 0 && impulses_[kept - 1].particle == impulses_[n].particle) {
      impulses_[kept - 1] += impulses_[n];
    } else {
      impulses_[kept++] = impulses_[n];
    }
  }
  impulses_.resize(kept);
}

std::span<const DeferredImpulse> DeferredImpulses::of(std::int32_t begin, std::int32_t end) const {
  const auto first = std::lower_bound(impulses_.begin(), impulses_.end(),
                                      DeferredImpulse{.particle = begin}, is_earlier);
  const auto last =
      std::lower_bound(first, impulses_.end(), DeferredImpulse{.particle = end}, is_earlier);
  return {first, last};
}

const DeferredImpulse* DeferredImpulses::find(std::int32_t particle) const {
  const auto found = of(particle, particle + 1);
  return found.empty() ? nullptr : found.data();
}

void DeferredImpulses::renumber(std::span<const std::int32_t> new_index) {
  for (DeferredImpulse& i : impulses_) i.particle = new_index[static_cast<std::size_t>(i.particle)];
  std::erase_if(impulses_, [](const DeferredImpulse& i) { return i.particle < 0; });
  std::sort(impulses_.begin(), impulses_.end(), is_earlier);
}

std::uint64_t DeferredImpulses::digest() const {
  base::Digest digest;
  for (const DeferredImpulse& i : impulses_) {
    digest.add(&i.particle, 1);
    for (const sdk::Vec3& v :
         {i.velocity, i.angular_velocity, i.predicted_velocity, i.predicted_angular_velocity}) {
      digest.add(&v.x, 1).add(&v.y, 1).add(&v.z, 1);
    }
  }
  return digest.value();
}

void DeferredImpulses::save(sdk::ArchiveWriter& archive) const {
  std::vector<std::int64_t> particles;
  std::vector<double> values;
  for (const DeferredImpulse& i : impulses_) {
    particles.push_back(i.particle);
    for (const sdk::Vec3& v :
         {i.velocity, i.angular_velocity, i.predicted_velocity, i.predicted_angular_velocity}) {
      values.insert(values.end(), {v.x, v.y, v.z});
    }
  }
  archive.integers("left_rows", particles);
  archive.numbers("left_values", values);
}

void DeferredImpulses::load(sdk::ArchiveReader& archive) {
  const auto particles = archive.integers("left_rows");
  const auto values = archive.numbers("left_values");
  impulses_.clear();
  for (std::size_t n = 0; n < particles.size(); ++n) {
    DeferredImpulse i{.particle = static_cast<std::int32_t>(particles[n])};
    const double* value = values.data() + k_numbers * n;
    for (sdk::Vec3* v :
         {&i.velocity, &i.angular_velocity, &i.predicted_velocity, &i.predicted_angular_velocity}) {
      *v = {value[0], value[1], value[2]};
      value += 3;
    }
    impulses_.push_back(i);
  }
}

}  // namespace dust::particles
