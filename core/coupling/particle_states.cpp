// SPDX-License-Identifier: Apache-2.0
#include "coupling/particle_states.hpp"

#include <algorithm>

namespace dust::coupling {
namespace {

/// Numbers of a ParticleState that outlive a fluid step: velocity of the fluid, place, residual,
/// own velocity.
constexpr std::size_t k_saved = 13;
/// Numbers of an SelfFlow that do: the flow.
constexpr std::size_t k_saved_flow = 3 * self_disturbance::k_groups;

}  // namespace

void ParticleStates::align(const particles::GrainRows& grains) {
  if (grains.count == ids_.size() && std::equal(ids_.begin(), ids_.end(), grains.id)) return;
  ++order_;

  std::vector<std::pair<std::int64_t, std::size_t>> known(ids_.size());
  for (std::size_t row = 0; row < ids_.size(); ++row) known[row] = {ids_[row], row};
  std::sort(known.begin(), known.end());
  std::vector<char> is_here(ids_.size(), 0);
  std::vector<ParticleState> rows(grains.count);
  std::vector<double> columns(width_ * grains.count, 0.0);
  std::vector<SelfFlow> self_flow(has_self_flow_ ? grains.count : 0);
  for (std::size_t row = 0; row < grains.count; ++row) {
    const auto found =
        std::lower_bound(known.begin(), known.end(), std::pair{grains.id[row], std::size_t{0}});
    if (found == known.end() || found->first != grains.id[row]) continue;
    rows[row] = rows_[found->second];
    if (has_self_flow_) self_flow[row] = self_flow_[found->second];
    std::copy_n(columns_.data() + width_ * found->second, width_, columns.data() + width_ * row);
    is_here[found->second] = 1;
  }
  for (const auto& [id, row] : known) {
    if (is_here[row] == 0 && rows_[row].deferred != Triple{}) {
      escaped_.push_back({rows_[row].place, rows_[row].deferred});
    }
  }
  rows_ = std::move(rows);
  columns_ = std::move(columns);
  self_flow_ = std::move(self_flow);
  ids_.assign(grains.id, grains.id + grains.count);
}

void ParticleStates::number(std::span<const std::int32_t> rows) {
  for (std::size_t n = 0; n < rows.size(); ++n) {
    rows_[static_cast<std::size_t>(rows[n])].stencil = static_cast<std::int32_t>(n);
  }
}

std::vector<std::int32_t> ParticleStates::rows_now(std::uint64_t order,
                                                   std::span<const std::int32_t> then) const {
  if (order == order_) return {};
  std::vector<std::int32_t> now(then.size(), -1);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::int32_t stencil = rows_[row].stencil;
    if (stencil >= 0) now[static_cast<std::size_t>(stencil)] = static_cast<std::int32_t>(row);
  }
  return now;
}

void ParticleStates::save(sdk::ArchiveWriter& archive) const {
  std::vector<double> numbers;
  numbers.reserve(k_saved * rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const ParticleState& r = rows_[row];
    numbers.insert(numbers.end(), r.fluid_velocity.begin(), r.fluid_velocity.end());
    numbers.insert(numbers.end(), r.place.begin(), r.place.end());
    numbers.insert(numbers.end(), r.deferred.begin(), r.deferred.end());
    numbers.push_back(r.has_velocity ? 1.0 : 0.0);
    numbers.insert(numbers.end(), r.velocity.begin(), r.velocity.end());
  }
  std::vector<double> gone;
  for (const EscapedParticle& l : escaped_) {
    gone.insert(gone.end(), l.place.begin(), l.place.end());
    gone.insert(gone.end(), l.deferred.begin(), l.deferred.end());
  }
  archive.integers("grain_ids", ids_);
  archive.numbers("grains", numbers);
  archive.numbers("leavers", gone);
  if (width_ > 0) archive.numbers("kept", columns_);
  save_self_flow(archive);
}

void ParticleStates::save_self_flow(sdk::ArchiveWriter& archive) const {
  std::vector<double> flows;
  flows.reserve(k_saved_flow * self_flow_.size());
  for (const SelfFlow& own : self_flow_) {
    for (const Triple& part : own.flow) flows.insert(flows.end(), part.begin(), part.end());
  }
  archive.numbers("own_flow", flows);
}

void ParticleStates::load_self_flow(sdk::ArchiveReader& archive) {
  const std::vector<double> flows = archive.numbers("own_flow");
  has_self_flow_ = !flows.empty();
  self_flow_.assign(flows.size() / k_saved_flow, {});
  const double* n = flows.data();
  for (SelfFlow& own : self_flow_) {
    for (Triple& part : own.flow) {
      std::copy_n(n, 3, part.begin());
      // A flow is forgotten when its grain is no longer alone: the next begin_step() has to know of
      // it.
      own.is_smooth = own.is_smooth || part != Triple{};
      n += 3;
    }
  }
}

void ParticleStates::load(sdk::ArchiveReader& archive) {
  ids_ = archive.integers("grain_ids");
  const std::vector<double> numbers = archive.numbers("grains");
  const std::vector<double> gone = archive.numbers("leavers");
  rows_.assign(ids_.size(), {});
  if (width_ > 0) columns_ = archive.numbers("kept");
  const double* n = numbers.data();
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    ParticleState& r = rows_[row];
    std::copy_n(n, 3, r.fluid_velocity.begin());
    std::copy_n(n + 3, 3, r.place.begin());
    std::copy_n(n + 6, 3, r.deferred.begin());
    r.has_velocity = n[9] != 0.0;
    std::copy_n(n + 10, 3, r.velocity.begin());
    n += k_saved;
  }
  escaped_.assign(gone.size() / 6, {});
  for (std::size_t l = 0; l < escaped_.size(); ++l) {
    std::copy_n(gone.data() + 6 * l, 3, escaped_[l].place.begin());
    std::copy_n(gone.data() + 6 * l + 3, 3, escaped_[l].deferred.begin());
  }
  load_self_flow(archive);
}

}  // namespace dust::coupling
