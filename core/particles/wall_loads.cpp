// SPDX-License-Identifier: Apache-2.0
#include "particles/wall_loads.hpp"

#include "particles/impl.hpp"

#include <algorithm>

namespace dust::particles {

void WallLoads::begin(const std::vector<Surface>& surfaces, std::size_t walls) {
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

void WallLoads::take(std::vector<double>& sums, std::vector<sdk::WallImpact>& impacts) {
  for (std::size_t q = 0; q < sums.size(); ++q) sums_[q] += sums[q];
  std::fill(sums.begin(), sums.end(), 0.0);
  open_impacts_.insert(open_impacts_.end(), impacts.begin(), impacts.end());
  impacts.clear();
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
}

sdk::WallColumns WallLoads::columns() const {
  return {name_, group_, force_, torque_, power_, mass_, count_, impacts_};
}

/// Everything the chunks have added up, in their order.
void Dem::Impl::gather_wall_loads() {
  if (!wall_loads.is_on()) return;
  for (Chunk& c : chunks) wall_loads.take(c.wall_sums, c.wall_impacts);
}

void Dem::watch_walls() {
  Impl& dem = *impl_;
  std::size_t walls = 0;
  for (const Surface& s : dem.surfaces) walls = std::max<std::size_t>(walls, s.wall + 1u);
  dem.wall_loads.begin(dem.surfaces, walls);
  dem.must_rebuild = true;
}

sdk::WallColumns Dem::close_wall_loads(double interval) {
  Impl& dem = *impl_;
  if (!dem.wall_loads.is_on()) return {};
  dem.gather_wall_loads();
  dem.wall_loads.close(interval);
  // A grain that touches two parts of one body counts once.
  std::vector<std::vector<std::int32_t>> rows(dem.wall_loads.walls());
  const auto note = [&](std::int32_t surface, std::int32_t row) {
    rows[static_cast<std::size_t>(dem.surfaces[static_cast<std::size_t>(surface)].wall)].push_back(
        row);
  };
  for (const Chunk& c : dem.chunks) {
    for (std::size_t q = 0; q < c.surfaces.size(); ++q) {
      if (c.surfaces.is_touching[q] != 0) note(c.surfaces.b[q], c.surfaces.a[q]);
    }
  }
  for (std::size_t q = 0; q < dem.fine.size(); ++q) {
    if (dem.fine.is_touching[q] != 0 && dem.fine.b[q] < 0) note(-1 - dem.fine.b[q], dem.fine.a[q]);
  }
  for (std::size_t w = 0; w < rows.size(); ++w) {
    std::sort(rows[w].begin(), rows[w].end());
    rows[w].erase(std::unique(rows[w].begin(), rows[w].end()), rows[w].end());
    double mass = 0.0;
    for (const std::int32_t row : rows[w]) {
      const auto n = static_cast<std::size_t>(row);
      mass += dem.store.weight[n] / dem.store.velocity(n)[3];
    }
    dem.wall_loads.set_contact(w, mass, static_cast<std::int64_t>(rows[w].size()));
  }
  return dem.wall_loads.columns();
}

sdk::WallColumns Dem::wall_loads() const { return impl_->wall_loads.columns(); }

}  // namespace dust::particles
