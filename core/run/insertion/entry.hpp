// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/emitter.hpp"
#include "particles/dem.hpp"
#include "particles/surfaces.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace dust::run {

/// A grain on its way in.
struct InsertionCandidate {
  particles::NewGrain grain;
  std::int32_t emitter = 0;  ///< index into Setup::emitters
  std::int64_t line = 0;     ///< of the file it was read from; 0 = none
};

/// What the places of entering grains are checked against.
struct EntryScene {
  sdk::Vec3 min, max;  ///< [m] of the domain
  std::array<bool, 3> is_periodic{};
  double time = 0.0;  ///< [s] at which bodies that move are looked at
  std::vector<particles::Surface> surfaces;
  std::vector<sdk::InsertionRule> rules;  ///< by emitter
  std::vector<std::string> names;         ///< by emitter, "file:line:column: error: emitters.bed"
};

/// From `from` to `to`, the shortest way through periodic sides.
[[nodiscard]] sdk::Vec3 separation(const EntryScene& scene, sdk::Vec3 from, sdk::Vec3 to);
/// [m] Distances below this are rounding: what touches exactly does not overlap.
[[nodiscard]] double rounding(const EntryScene& scene);

/// Spheres in cells of a grid, found by place; periodic sides are looked through.
class SphereGrid {
 public:
  struct Sphere {
    sdk::Vec3 centre;
    double radius = 0.0;
    std::int64_t label = 0;
  };
  /// `largest`: [m] diameter of the largest sphere that comes.
  SphereGrid(const EntryScene& scene, double largest);
  void add(const Sphere& sphere);
  /// A sphere that overlaps by more than `allowed` [-] of the smaller radius and than rounding;
  /// null if there is none.
  [[nodiscard]] const Sphere* overlapping(sdk::Vec3 centre, double radius, double allowed) const;

 private:
  [[nodiscard]] std::array<std::int64_t, 3> cell_of(sdk::Vec3 point) const;
  [[nodiscard]] std::uint64_t key_of(std::array<std::int64_t, 3> cell) const;

  const EntryScene& scene_;
  double rounding_;  ///< [m]
  sdk::Vec3 edge_;
  std::array<std::int64_t, 3> cells_{};  ///< along periodic directions
  std::vector<Sphere> spheres_;
  std::vector<std::int32_t> next_;
  std::unordered_map<std::uint64_t, std::int32_t> first_;
};

/// Takes out of `waiting` those grains that touch neither a grain in the domain, nor one taken
/// before them, nor a body that moves, in their order. The others stay and are tried again at the
/// next fluid step, where their emitter lets them wait: an overlap at entry would be an explosion,
/// and moving either grain aside would be made up. A grain that may not wait must lie in the
/// domain, clear of bodies and walls, too; throws ModelError that names both sides.
std::vector<InsertionCandidate> take_without_overlap(std::vector<InsertionCandidate>& waiting,
                                                     const particles::GrainRows& rows,
                                                     const EntryScene& scene);

/// The grains (in the domain and about to enter), bodies and walls, for emitters that look for
/// places; sorted into cells when first asked, because most emitters never ask. In a frame, points
/// are turned as the core turns the emitter's requests. One thread.
class LazySurroundings final : public sdk::Surroundings {
 public:
  LazySurroundings(const EntryScene& scene, const particles::GrainRows& rows,
                   const std::vector<InsertionCandidate>& waiting, double largest,
                   const scenario::FrameSpec* frame)
      : scene_(scene), rows_(rows), waiting_(waiting), largest_(largest), frame_(frame) {}
  [[nodiscard]] bool is_free(sdk::Vec3 centre, double radius) const override;

 private:
  const EntryScene& scene_;
  particles::GrainRows rows_;
  const std::vector<InsertionCandidate>& waiting_;
  double largest_;  ///< [m] diameter
  const scenario::FrameSpec* frame_;
  mutable std::optional<SphereGrid> grid_;
};

/// A point of a turned frame in the domain's frame.
sdk::Vec3 turned(sdk::Vec3 point, const scenario::FrameSpec& frame);

void save_waiting(const std::vector<InsertionCandidate>& waiting, sdk::ArchiveWriter& archive);
void load_waiting(std::vector<InsertionCandidate>& waiting, sdk::ArchiveReader& archive);

}  // namespace dust::run
