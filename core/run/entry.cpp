// SPDX-License-Identifier: Apache-2.0
#include "run/entry.hpp"

#include <algorithm>

namespace dust::run {
namespace {

struct Ball {
  sdk::Vec3 centre;
  double radius;
};

bool touch(const Ball& a, const Ball& b) {
  const double reach = a.radius + b.radius;
  const sdk::Vec3 apart = a.centre - b.centre;
  return dot(apart, apart) < reach * reach;
}

/// The grains in the box round all waiting ones: entries happen in one small place.
std::vector<Ball> grains_nearby(const std::vector<particles::NewGrain>& waiting,
                                const particles::GrainRows& rows) {
  std::vector<Ball> near;
  if (waiting.empty()) return near;
  sdk::Vec3 low = waiting.front().position;
  sdk::Vec3 high = low;
  for (const auto& g : waiting) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], g.position[d] - 0.5 * g.diameter);
      high[d] = std::max(high[d], g.position[d] + 0.5 * g.diameter);
    }
  }
  for (std::size_t n = 0; n < rows.count; ++n) {
    const double* p = rows.position + 4 * n;
    bool is_near = true;
    for (int d = 0; d < 3; ++d) is_near &= p[d] > low[d] - p[3] && p[d] < high[d] + p[3];
    if (is_near) near.push_back({{p[0], p[1], p[2]}, p[3]});
  }
  return near;
}

}  // namespace

std::vector<particles::NewGrain> take_free_places(std::vector<particles::NewGrain>& waiting,
                                                  const particles::GrainRows& rows) {
  std::vector<Ball> near = grains_nearby(waiting, rows);
  std::vector<particles::NewGrain> free;
  std::vector<particles::NewGrain> blocked;
  for (const auto& g : waiting) {
    const Ball ball{g.position, 0.5 * g.diameter};
    if (std::any_of(near.begin(), near.end(), [&](const Ball& b) { return touch(ball, b); })) {
      blocked.push_back(g);
    } else {
      near.push_back(ball);
      free.push_back(g);
    }
  }
  waiting = std::move(blocked);
  return free;
}

void save_waiting(const std::vector<particles::NewGrain>& waiting, sdk::ArchiveWriter& archive) {
  std::vector<double> rows;
  for (const auto& g : waiting) {
    rows.insert(rows.end(), {g.position.x, g.position.y, g.position.z, g.velocity.x, g.velocity.y,
                             g.velocity.z, g.diameter, g.weight, static_cast<double>(g.material)});
  }
  archive.numbers("waiting", rows);
}

void load_waiting(std::vector<particles::NewGrain>& waiting, sdk::ArchiveReader& archive) {
  const auto rows = archive.numbers("waiting");
  waiting.clear();
  for (std::size_t n = 0; n + 8 < rows.size(); n += 9) {
    particles::NewGrain g;
    g.position = {rows[n], rows[n + 1], rows[n + 2]};
    g.velocity = {rows[n + 3], rows[n + 4], rows[n + 5]};
    g.diameter = rows[n + 6];
    g.weight = rows[n + 7];
    g.material = static_cast<std::int32_t>(rows[n + 8]);
    waiting.push_back(g);
  }
}

}  // namespace dust::run
