// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dust::particles {

/// What becomes of the histories of contacts under one of the laws of another solver: the law of
/// the same materials here, and whose numbers mean the same to it.
struct LawTransfer {
  int law = -1;  ///< -1: the materials have none here
  bool keeps_contact = false, keeps_rolling = false, keeps_cohesion = false;
};

/// What stands in the way of another solver's particles.
struct TransferObstacles {
  /// Particles that lie in a surface which was not there before, or deeper than before.
  struct Blocked {
    std::string surface;
    std::int64_t count = 0;
    std::int64_t first_id = 0;
    sdk::Vec3 first_place;          ///< [m]
    double largest_diameter = 0.0;  ///< [m]
    bool is_hood = false;           ///< its opening draws out what touches it
  };
  std::vector<Blocked> blocked;
  std::vector<std::string> materials;          ///< of particles that are there
  std::vector<std::string> missing_materials;  ///< of these, those unknown here
  std::int64_t outside = 0;                    ///< beyond a side that is no opening to them
  sdk::Vec3 first_outside;                     ///< [m]

  [[nodiscard]] bool none() const {
    return blocked.empty() && missing_materials.empty() && outside == 0;
  }
};

/// What came of a transfer.
struct TransferReport {
  std::int64_t particles = 0;
  std::int64_t contacts = 0;      ///< in touch, of surfaces that are still there
  std::int64_t without_past = 0;  ///< of these, whose history or part of it begins anew
  std::int64_t drawn_out = 0;     ///< particles that lay in a new hood and are gone
};

}  // namespace dust::particles
