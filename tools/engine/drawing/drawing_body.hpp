// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "drawing/drawing_view.hpp"

#include <optional>
#include <string>
#include <utility>

namespace dust::engine {

/// A body as SVG: grey where the middle of the domain cuts it, and its edges as the side view shows
/// them.
struct BodyPicture {
  std::string svg;
  /// [px] its highest point inside the picture; nothing if none of it is.
  std::optional<std::pair<double, double>> mark;
};
BodyPicture draw_body(const bodies::Body& body, const scenario::DomainSpec& domain,
                      const SideView& view);

}  // namespace dust::engine
