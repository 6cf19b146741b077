// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "dust/sdk/sensor.hpp"
#include "particles/energy/working_contact.hpp"
#include "particles/forces/pair_batch.hpp"
#include "particles/forces/wall_loads.hpp"
#include "particles/neighbours/inner_list.hpp"
#include "particles/openings/opening_marks.hpp"
#include "particles/pair_law_table.hpp"
#include "particles/store/particle_store.hpp"
#include "particles/store/tile.hpp"
#include "particles/surfaces.hpp"
#include "particles/work/contact_work.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// What contacts are evaluated on: views of what others own.
struct ContactScene {
  const ParticleStore& particles;
  const PairLawTable& laws;
  std::span<const Surface> surfaces;
  const contact::Images& images;
  double step = 0.0;                ///< [s]
  double time = 0.0;                ///< [s] of the positions
  bool has_weights = false;         ///< coarse particles of different statistical weights
  OpeningMarks opening_marks = {};  ///< of scenes that forces are evaluated on
  ContactWork* work = nullptr;      ///< of the same, if it is kept
  EnergyAccount* energy = nullptr;  ///< of the same, if it is kept

  [[nodiscard]] contact::RowView rows() const { return particles.contact_rows(); }
};

/// The contacts of coarse particles, tile by tile, through the laws in batches; and what they leave
/// beside forces: counts, overlaps, loads on walls. Tiles may be worked through at once.
class ContactForces {
 public:
  /// New tiles for the walls whose loads are kept.
  void restart(std::size_t tiles, const WallLoads& loads);
  /// Adds the forces of all contacts of a tile to `force`, rows of a ForceBuffer.
  void evaluate(const ContactScene& scene, Tile tile, TileContacts& contacts, double* force);

  [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }
  /// In touch at the last step.
  [[nodiscard]] std::int64_t contacts() const;
  [[nodiscard]] std::int64_t contacts(std::size_t tile) const { return tiles_[tile].contacts; }
  void set_contacts(std::size_t tile, std::int64_t count) { tiles_[tile].contacts = count; }
  /// [-] overlap / smaller radius, since the start.
  [[nodiscard]] double largest_overlap() const;
  void set_largest_overlap(double overlap) { largest_before_ = overlap; }
  /// Gives what tiles have added up, in their order.
  void give_wall_loads(WallLoads& loads);

 private:
  struct OfTile {
    std::int64_t contacts = 0;
    double largest_overlap = 0.0;
    std::vector<double> wall_sums;              ///< WallLoads::k_sums per wall, if kept
    std::vector<sdk::WallImpact> wall_impacts;  ///< in the order of the contacts
    bool keeps_sliding = false;
    WallSlidings slidings;
    EnergySums* energy = nullptr;  ///< of the step at hand, if an account is kept
  };
  /// One batch of contacts with a surface.
  struct WallBatch;

  // contact_forces.cpp
  void persistent_pairs(const ContactScene& scene, const LawRange& range, TileContacts& contacts,
                        OfTile& tile, double* force);
  static void note_work(const ContactScene& scene, const PairBatch& batch,
                        std::span<const contact::Places> slots, bool has_scales, double* force);
  void new_pairs(const ContactScene& scene, const LawRange& range, TileContacts& contacts,
                 OfTile& tile, double* force);
  // wall_forces.cpp
  void walls(const ContactScene& scene, Tile range, TileContacts& contacts, OfTile& tile,
             double* force);

  std::vector<OfTile> tiles_;
  double largest_before_ = 0.0;  ///< of tiles that are gone
};

}  // namespace dust::particles
