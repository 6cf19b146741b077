// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/mesh/triangle_surface.hpp"

#include <cstdint>
#include <vector>

namespace dust::bodies {

/// Where a surface folds towards the grains twice, so near that a sphere touches both faces beyond
/// and bridges the flat one between: in a hole, a fillet or a slot narrower than the sphere.
struct NarrowHollows {
  std::vector<bool> is_fold;            ///< [edges] beside a bridged face
  std::vector<double> turn;             ///< [edges; rad] of the fold, 0 where it stands out
  std::vector<std::int32_t> flat_face;  ///< [triangles] its number if it is bridged, else -1
};

/// A face of width w [m] between parallel folds of angles a and b is bridged by a sphere of
/// `radius` [m] where w < radius (tan(a / 2) + tan(b / 2)); a tenth more counts, so that a sphere
/// on the rounded rim of a hole, where the face is just as wide, lies well within. On a thin sheet
/// folds to either side count.
NarrowHollows find_narrow_hollows(const TriangleSurface& surface, double radius, bool is_sheet);

}  // namespace dust::bodies
