// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/conditions.hpp"
#include "particles/neighbours/inner_list.hpp"
#include "particles/store/particle_store.hpp"
#include "particles/transfer/transfer.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dust::particles {

/// Numbers of another solver in ours: things are the same that have the same name.
class Translation {
 public:
  Translation(const Conditions& from, const Conditions& to);
  /// -1: there is none.
  [[nodiscard]] std::span<const std::int32_t> materials() const { return material_; }
  /// First part of the wall that each surface belongs to.
  [[nodiscard]] std::span<const std::int32_t> walls() const { return wall_; }
  /// -1, too, where the wall is cut into other parts.
  [[nodiscard]] std::span<const std::int32_t> surfaces() const { return surface_; }
  [[nodiscard]] std::span<const std::int32_t> openings() const { return opening_; }

 private:
  std::vector<std::int32_t> material_, wall_, surface_, opening_;  ///< by the other's number
};

/// The contacts of another solver on their way into ours. Particles keep their rows.
class ContactTransfer {
 public:
  struct Side {
    const Conditions& conditions;
    const ParticleStore& particles;
  };
  ContactTransfer(Side from, Side to, const Translation& names, std::span<const LawTransfer> laws)
      : from_(from), to_(to), names_(names), laws_(laws) {}

  /// The contacts in touch of a list, those with surfaces that are gone left out.
  [[nodiscard]] ContactList translated(const ContactList& list);
  /// Contacts so far, and those of them that lost their history.
  [[nodiscard]] std::int64_t contacts() const { return contacts_; }
  [[nodiscard]] std::int64_t without_past() const { return without_past_; }

 private:
  [[nodiscard]] bool is_fine(std::int32_t row) const;
  [[nodiscard]] std::int32_t same_place(std::size_t row, std::int32_t surface) const;
  /// Whether side i of a pair is the one that it is here.
  [[nodiscard]] bool is_in_order(std::int32_t i, std::int32_t j) const;
  /// False where a part begins anew.
  [[nodiscard]] bool translate(std::int32_t law, const double* history, double* into) const;

  Side from_, to_;
  const Translation& names_;
  std::span<const LawTransfer> laws_;
  std::int64_t contacts_ = 0;
  std::int64_t without_past_ = 0;
};

/// See TransferObstacles.
TransferObstacles find_obstacles(ContactTransfer::Side from, const Conditions& to);

/// Rows of particles that lie in the body of a new hood, with the number of its opening.
std::vector<std::pair<std::size_t, int>> find_inside_hoods(ContactTransfer::Side from,
                                                           const Conditions& to,
                                                           const Translation& names);

}  // namespace dust::particles
