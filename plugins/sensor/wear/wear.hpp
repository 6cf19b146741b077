// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dust::model::wear {

/// [m3/s] Volume worn off per time by a contact that slides: \f$ \dot V = k F_n v_t / H \f$
/// (Archard 1953).
/// @param coefficient  [-] k, of the pair of materials and how abrasive the contact is
/// @param hardness     [Pa] H of the surface that wears
/// @param force        [N] normal force of the contact
/// @param slip         [m/s] speed of the grain's surface along that of the wall
constexpr double archard(double coefficient, double hardness, double force, double slip) {
  return coefficient * force * slip / hardness;
}

}  // namespace dust::model::wear
