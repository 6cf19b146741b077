// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/body_places.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {
namespace {

/// Looks for the surface of a body in a box of the domain.
class BoxSearch {
 public:
  /// Boxes smaller than `finest` [m] that come that near the surface count as met.
  BoxSearch(const bodies::Body& body, double finest) : body_(body), finest_(finest) {}

  /// False only where no part of the surface lies in the box: boxes that are farther from it than
  /// they reach are left out, others halved along their longest edge.
  bool may_be_in(sdk::Vec3 min, sdk::Vec3 max) {
    constexpr int k_max_boxes = 20000;
    const sdk::Vec3 half = 0.5 * (max - min);
    const double reach = norm(half) + finest_;
    if (std::abs(body_.nearest(0.5 * (min + max)).distance) > reach) return false;
    if (reach < 2.0 * finest_ || ++boxes_ > k_max_boxes) return true;
    int d = half.y > half.x ? 1 : 0;
    if (half.z > half[d]) d = 2;
    sdk::Vec3 low_max = max, high_min = min;
    low_max[d] = high_min[d] = min[d] + half[d];
    return may_be_in(min, low_max) || may_be_in(high_min, max);
  }

 private:
  const bodies::Body& body_;
  double finest_;
  int boxes_ = 0;
};

}  // namespace

void check_body_places(const scenario::Setup& setup, const ParticleModels& models,
                       scenario::Diagnostics& diagnostics) {
  const sdk::Vec3 middle = 0.5 * (setup.domain.min + setup.domain.max);
  constexpr double k_finest = 2e-3;  // of the domain's diagonal
  const double finest = k_finest * norm(setup.domain.max - setup.domain.min);
  for (std::size_t n = 0; n < models.bodies.size(); ++n) {
    const bodies::Body& body = models.bodies[n];
    const bool is_moved = std::any_of(body.motions.begin(), body.motions.end(),
                                      [](const auto& m) { return m->moves_body(); });
    if (is_moved) continue;
    const double distance = std::abs(body.nearest(middle).distance);
    if (BoxSearch(body, finest).may_be_in(setup.domain.min, setup.domain.max)) continue;
    const bool is_mesh = !body.shape->notes().empty();
    diagnostics.warning(setup.bodies[n].shape.where,
                        "bodies." + body.name +
                            ": none of its surface is in the domain, the "
                            "nearest of it " +
                            base::length_text(distance) +
                            " from the domain's middle: nothing "
                            "meets it; " +
                            (is_mesh ? "is the unit of its file right (unit: 1 mm)?"
                                     : "are its place and size right?"));
  }
}

}  // namespace dust::preflight
