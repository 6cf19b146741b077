// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/wall_loads.hpp"

#include "particles/forces/contact_forces.hpp"
#include "particles/neighbours/inner_list.hpp"

#include <algorithm>

namespace dust::particles {

void WallLoads::begin(const std::vector<Surface>& surfaces, std::size_t walls, bool has_sliding) {
  has_sliding_ = has_sliding;
  name_.resize(walls);
  group_.resize(walls);
  for (const Surface& s : surfaces) {
    const auto wall = static_cast<std::size_t>(s.wall);
    name_[wall] = s.name;
    group_[wall] = s.body != nullptr ? s.body->group : std::string();
  }
  sums_.assign(k_sums * walls, 0.0);
  force_.assign(walls, {});
  torque_.assign(walls, {});
  power_.assign(walls, 0.0);
  mass_.assign(walls, 0.0);
  count_.assign(walls, 0);
}

void WallLoads::take(std::vector<double>& sums, std::vector<sdk::WallImpact>& impacts,
                     WallSlidings& slidings) {
  for (std::size_t q = 0; q < sums.size(); ++q) sums_[q] += sums[q];
  std::fill(sums.begin(), sums.end(), 0.0);
  open_impacts_.insert(open_impacts_.end(), impacts.begin(), impacts.end());
  impacts.clear();
  slidings.take(open_slidings_);
}

void WallLoads::close(double interval) {
  const double inverse = interval > 0.0 ? 1.0 / interval : 0.0;
  for (std::size_t w = 0; w < name_.size(); ++w) {
    const double* s = sums_.data() + k_sums * w;
    force_[w] = inverse * sdk::Vec3{s[0], s[1], s[2]};
    torque_[w] = inverse * sdk::Vec3{s[3], s[4], s[5]};
    power_[w] = inverse * s[6];
  }
  std::fill(sums_.begin(), sums_.end(), 0.0);
  impacts_.swap(open_impacts_);
  open_impacts_.clear();
  slidings_.swap(open_slidings_);
  open_slidings_.clear();
}

sdk::WallColumns WallLoads::columns() const {
  return {name_, group_, force_, torque_, power_, mass_, count_, impacts_, slidings_};
}

void WallLoads::note_contacts(const ContactScene& scene, const InnerList& lists) {
  // A particle that touches two parts of one body counts once.
  std::vector<std::vector<std::int32_t>> rows(walls());
  const bool may_be_apart = scene.laws.largest_range() > 0.0;
  const auto note = [&](std::int32_t number, std::int32_t row) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(number)];
    if (may_be_apart) {
      const double* p = scene.particles.position(static_cast<std::size_t>(row));
      if (!(surface.contact({p[0], p[1], p[2]}, p[3]).distance < p[3])) return;
    }
    rows[static_cast<std::size_t>(surface.wall)].push_back(row);
  };
  for (std::size_t t = 0; t < lists.tiles(); ++t) {
    const ContactList& list = lists.contacts(t).walls;
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.touching()[q] != 0) note(list.b()[q], list.a()[q]);
    }
  }
  const ContactList& fine = lists.fine();
  for (std::size_t q = 0; q < fine.size(); ++q) {
    if (fine.touching()[q] != 0 && fine.b()[q] < 0) note(-1 - fine.b()[q], fine.a()[q]);
  }
  for (std::size_t w = 0; w < rows.size(); ++w) {
    std::sort(rows[w].begin(), rows[w].end());
    rows[w].erase(std::unique(rows[w].begin(), rows[w].end()), rows[w].end());
    mass_[w] = 0.0;
    for (const std::int32_t row : rows[w]) {
      const auto n = static_cast<std::size_t>(row);
      mass_[w] += scene.particles.weight(n) / scene.particles.inverse_mass(n);
    }
    count_[w] = static_cast<std::int64_t>(rows[w].size());
  }
}

}  // namespace dust::particles
