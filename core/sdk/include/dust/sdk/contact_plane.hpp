// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

namespace dust::sdk {

/// A vector and its part in the plane of a contact.
struct InPlane {
  Vec3 part;              ///< v - (v . n) n
  double squared_before;  ///< v . v
  double squared;         ///< part . part
};

/// What a contact remembers as a vector (the tangential spring, the couple of a rolling spring)
/// seen in the plane across the unit normal `n` of now: the normal has turned since. A spring keeps
/// its length when it turns along, \f$ \xi' = \sqrt{\xi^2 / \xi_t^2}\, \xi_t \f$ with
/// \f$ \xi_t = \xi - (\xi \cdot n)\, n \f$; the root of the ratio is the caller's, since a law
/// takes many roots at once (square_roots.hpp) or joins the factor with others. Source: Luding,
/// Granular Matter 10 (2008) 235, doi:10.1007/s10035-008-0099-x, "tangential contact law"; the
/// length kept: own choice.
[[gnu::always_inline]] inline InPlane in_contact_plane(Vec3 v, Vec3 n) {
  const double along = dot(v, n);
  const Vec3 part = v - along * n;
  return {part, dot(v, v), dot(part, part)};
}

}  // namespace dust::sdk
