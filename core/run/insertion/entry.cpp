// SPDX-License-Identifier: Apache-2.0
#include "run/insertion/entry.hpp"

#include "base/cells.hpp"
#include "base/periodic.hpp"
#include "base/text.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dust::run {
namespace {

using sdk::Vec3;

/// A request written exactly on a side may miss it by rounding.
constexpr double k_box_rounding = 1e-12;
/// Of a place in a message: as a list of grains has it.
constexpr int k_place_digits = 6;
/// Roundings of a coordinate on its way from the scenario into a distance: written in another unit,
/// shifted or turned in a frame, carried back in time, subtracted, through a periodic side; some
/// thirty of half a unit in the last place at the worst.
constexpr double k_roundings = 16.0;

std::string grain_text(const InsertionCandidate& e) {
  std::ostringstream text;
  text << "a grain of " << e.grain.diameter << " m at "
       << base::place_text(e.grain.position, k_place_digits);
  if (e.line > 0) text << " (line " << e.line << ")";
  return text.str();
}

double largest_diameter(const std::vector<InsertionCandidate>& waiting,
                        const particles::GrainRows& rows) {
  double largest = 0.0;
  for (const InsertionCandidate& e : waiting) largest = std::max(largest, e.grain.diameter);
  for (std::size_t n = 0; n < rows.count; ++n) {
    largest = std::max(largest, rows.diameter(n));
  }
  return largest;
}

/// A negative label names a waiting grain, -1 - its index; others are ids.
std::string partner_text(const SphereGrid::Sphere& s,
                         const std::vector<InsertionCandidate>& waiting) {
  if (s.label < 0) return grain_text(waiting[static_cast<std::size_t>(-1 - s.label)]);
  return "grain " + std::to_string(s.label) + " in the domain, at " +
         base::place_text(s.centre, k_place_digits);
}

[[noreturn]] void refuse(const EntryScene& scene, const InsertionCandidate& e,
                         const std::string& what) {
  throw sdk::ModelError(scene.names[static_cast<std::size_t>(e.emitter)] + ": " + grain_text(e) +
                        " " + what);
}

/// What else to do than to move a grain that overlaps by more than `allowed`.
std::string other_ways(double allowed) {
  return allowed > 0.0 ? ", or allow more (allowed_overlap)"
                       : "; grains that touch at the start, as in a settled bed, come from a file "
                         "(model: file, whose allowed_overlap takes them)";
}

/// Of an emitter whose grains do not wait: inside the domain, clear of bodies and walls. The frame
/// of a run has grains beyond a periodic side by what they travelled since the neighbour list was
/// built, which is less than the `largest` diameter [m]: the list puts them back.
void check_place(const EntryScene& scene, const InsertionCandidate& e, double allowed,
                 double largest) {
  const Vec3 x = e.grain.position;
  const double radius = 0.5 * e.grain.diameter;
  for (int d = 0; d < 3; ++d) {
    const bool is_periodic = scene.is_periodic[static_cast<std::size_t>(d)];
    const double slack = is_periodic ? largest : k_box_rounding * (scene.max[d] - scene.min[d]);
    if (!(x[d] >= scene.min[d] - slack && x[d] <= scene.max[d] + slack)) {
      refuse(scene, e, "lies outside the domain");
    }
  }
  for (const particles::Surface& s : scene.surfaces) {
    if (s.is_removed() || !s.is_first_part()) continue;
    const double overlap = radius - s.nearest_at(scene.time, x).distance;
    if (overlap <= allowed * radius + rounding(scene)) continue;
    std::ostringstream text;
    text << "overlaps '" << s.name << "' by " << overlap << " m; move it clear"
         << other_ways(allowed);
    refuse(scene, e, text.str());
  }
}

/// Whether a body that moves stands where the grain wants to enter: a gate that has closed over a
/// feed. Those at rest stand clear of feeds, or `engine check` refuses them.
bool is_in_moving_body(const EntryScene& scene, Vec3 centre, double radius) {
  const double reach = radius - rounding(scene);
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                     [&](const particles::Surface& s) {
                       return s.is_displaced() && !s.is_removed() && s.is_first_part() &&
                              s.nearest_at(scene.time, centre).distance < reach;
                     });
}

}  // namespace

Vec3 separation(const EntryScene& scene, Vec3 from, Vec3 to) {
  Vec3 apart = to - from;
  for (int d = 0; d < 3; ++d) {
    if (!scene.is_periodic[static_cast<std::size_t>(d)]) continue;
    apart[d] = base::nearest_image_of_any(apart[d], scene.max[d] - scene.min[d]);
  }
  return apart;
}

double rounding(const EntryScene& scene) {
  // Of the coordinates, not of the radius: the distance of two of them is as exact as they are.
  double largest = 0.0;
  for (int d = 0; d < 3; ++d) {
    largest = std::max({largest, std::abs(scene.min[d]), std::abs(scene.max[d])});
  }
  return k_roundings * std::numeric_limits<double>::epsilon() * largest;
}

SphereGrid::SphereGrid(const EntryScene& scene, double largest)
    : scene_(scene), rounding_(rounding(scene)) {
  for (int d = 0; d < 3; ++d) {
    edge_[d] = largest > 0.0 ? largest : 1.0;
    if (!scene.is_periodic[static_cast<std::size_t>(d)]) continue;
    const double length = scene.max[d] - scene.min[d];
    const auto n = std::max<std::int64_t>(1, static_cast<std::int64_t>(length / edge_[d]));
    cells_[static_cast<std::size_t>(d)] = n;
    edge_[d] = length / static_cast<double>(n);
  }
}

std::array<std::int64_t, 3> SphereGrid::cell_of(Vec3 point) const {
  std::array<std::int64_t, 3> cell{};
  for (int d = 0; d < 3; ++d) {
    cell[static_cast<std::size_t>(d)] = base::cell_index((point[d] - scene_.min[d]) / edge_[d]);
  }
  return cell;
}

std::uint64_t SphereGrid::key_of(std::array<std::int64_t, 3> cell) const {
  for (std::size_t d = 0; d < 3; ++d) cell[d] = base::wrapped_cell(cell[d], cells_[d]);
  return base::cell_key(cell[0], cell[1], cell[2]);
}

void SphereGrid::add(const Sphere& sphere) {
  const auto [at, is_new] = first_.try_emplace(key_of(cell_of(sphere.centre)), -1);
  next_.push_back(at->second);
  at->second = static_cast<std::int32_t>(spheres_.size());
  spheres_.push_back(sphere);
}

const SphereGrid::Sphere* SphereGrid::overlapping(Vec3 centre, double radius,
                                                  double allowed) const {
  const auto cell = cell_of(centre);
  for (std::int64_t k = -1; k <= 1; ++k) {
    for (std::int64_t j = -1; j <= 1; ++j) {
      for (std::int64_t i = -1; i <= 1; ++i) {
        const auto found = first_.find(key_of({cell[0] + i, cell[1] + j, cell[2] + k}));
        if (found == first_.end()) continue;
        for (std::int32_t n = found->second; n >= 0; n = next_[static_cast<std::size_t>(n)]) {
          const Sphere& s = spheres_[static_cast<std::size_t>(n)];
          const double reach = radius + s.radius - allowed * std::min(radius, s.radius) - rounding_;
          const Vec3 apart = separation(scene_, s.centre, centre);
          if (dot(apart, apart) < reach * reach) return &s;
        }
      }
    }
  }
  return nullptr;
}

std::vector<InsertionCandidate> take_without_overlap(std::vector<InsertionCandidate>& waiting,
                                                     const particles::GrainRows& rows,
                                                     const EntryScene& scene) {
  if (waiting.empty()) return {};
  const double largest = largest_diameter(waiting, rows);
  SphereGrid grid(scene, largest);
  // Entries happen in one small place: only the grains in the box round all of them matter. A
  // periodic side leads round the box, so that there all grains do.
  Vec3 low = waiting.front().grain.position;
  Vec3 high = low;
  for (const InsertionCandidate& e : waiting) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], e.grain.position[d] - largest);
      high[d] = std::max(high[d], e.grain.position[d] + largest);
    }
  }
  for (std::size_t n = 0; n < rows.count; ++n) {
    const double* p = rows.position_of(n);
    bool is_near = true;
    for (int d = 0; d < 3; ++d) {
      is_near &=
          scene.is_periodic[static_cast<std::size_t>(d)] || (p[d] > low[d] && p[d] < high[d]);
    }
    if (is_near) grid.add({rows.centre(n), rows.radius(n), rows.id != nullptr ? rows.id[n] : 0});
  }
  std::vector<InsertionCandidate> free;
  std::vector<InsertionCandidate> blocked;
  for (std::size_t n = 0; n < waiting.size(); ++n) {
    const InsertionCandidate& e = waiting[n];
    const auto emitter = static_cast<std::size_t>(e.emitter);
    const sdk::InsertionRule rule =
        emitter < scene.rules.size() ? scene.rules[emitter] : sdk::InsertionRule{};
    const double radius = 0.5 * e.grain.diameter;
    if (!rule.waits) {
      check_place(scene, e, rule.allowed_overlap, largest);
    } else if (is_in_moving_body(scene, e.grain.position, radius)) {
      blocked.push_back(e);
      continue;
    }
    const auto* other = grid.overlapping(e.grain.position, radius, rule.allowed_overlap);
    if (other == nullptr) {
      grid.add({e.grain.position, radius, -1 - static_cast<std::int64_t>(n)});
      free.push_back(e);
    } else if (rule.waits) {
      blocked.push_back(e);
    } else {
      const double apart = norm(separation(scene, other->centre, e.grain.position));
      const double smaller = std::min(radius, other->radius);
      std::ostringstream text;
      text << "and " << partner_text(*other, waiting) << " overlap by "
           << radius + other->radius - apart << " m, " << (radius + other->radius - apart) / smaller
           << " of the smaller radius; " << rule.allowed_overlap << " is allowed: move one of them"
           << other_ways(rule.allowed_overlap);
      refuse(scene, e, text.str());
    }
  }
  waiting = std::move(blocked);
  return free;
}

bool LazySurroundings::is_free(Vec3 centre, double radius) const {
  if (!grid_) {
    grid_.emplace(scene_, std::max(largest_, largest_diameter(waiting_, rows_)));
    for (std::size_t n = 0; n < rows_.count; ++n) {
      grid_->add({rows_.centre(n), rows_.radius(n), rows_.id[n]});
    }
    for (const InsertionCandidate& e : waiting_)
      grid_->add({e.grain.position, 0.5 * e.grain.diameter, -1});
  }
  const Vec3 x = frame_ != nullptr ? turned(centre, *frame_) : centre;
  for (int d = 0; d < 3; ++d) {
    if (!(x[d] >= scene_.min[d] && x[d] <= scene_.max[d])) return false;
  }
  const double reach = radius - rounding(scene_);
  for (const particles::Surface& s : scene_.surfaces) {
    if (s.is_removed() || !s.is_first_part()) continue;
    if (s.nearest_at(scene_.time, x).distance < reach) return false;
  }
  return grid_->overlapping(x, radius, 0.0) == nullptr;
}

Vec3 turned(Vec3 point, const scenario::FrameSpec& frame) {
  const Vec3 axis = frame.axis / norm(frame.axis);
  return frame.origin + rotate(point - frame.origin, axis, frame.angle);
}

void save_waiting(const std::vector<InsertionCandidate>& waiting, sdk::ArchiveWriter& archive) {
  std::vector<double> rows;
  std::vector<std::int64_t> integers;
  for (const InsertionCandidate& e : waiting) {
    const particles::NewGrain& g = e.grain;
    rows.insert(rows.end(),
                {g.position.x, g.position.y, g.position.z, g.velocity.x, g.velocity.y, g.velocity.z,
                 g.rotation.x, g.rotation.y, g.rotation.z, g.diameter, g.weight});
    integers.insert(integers.end(), {g.material, e.emitter, e.line});
  }
  archive.numbers("waiting", rows);
  archive.integers("waiting_from", integers);
}

void load_waiting(std::vector<InsertionCandidate>& waiting, sdk::ArchiveReader& archive) {
  const auto rows = archive.numbers("waiting");
  const auto integers = archive.integers("waiting_from");
  waiting.clear();
  for (std::size_t n = 0; 3 * n + 2 < integers.size(); ++n) {
    const double* r = rows.data() + 11 * n;
    InsertionCandidate e;
    e.grain.position = {r[0], r[1], r[2]};
    e.grain.velocity = {r[3], r[4], r[5]};
    e.grain.rotation = {r[6], r[7], r[8]};
    e.grain.diameter = r[9];
    e.grain.weight = r[10];
    e.grain.material = static_cast<std::int32_t>(integers[3 * n]);
    e.emitter = static_cast<std::int32_t>(integers[3 * n + 1]);
    e.line = integers[3 * n + 2];
    waiting.push_back(e);
  }
}

}  // namespace dust::run
