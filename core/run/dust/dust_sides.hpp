// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"
#include "particles/openings/opening.hpp"
#include "run/models.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace dust::run {

/// What the sides of the domain are to dust, which goes where the air goes: it gets out of faces
/// that the air passes, in or out, is drawn out of openings, and settles on what else there is,
/// whether grains get out there or not.
class DustSides {
 public:
  /// `openings`: see openings_of; those of bodies are passed over.
  DustSides(const scenario::Setup& setup, const Models& models, const fluid::Grid& grid,
            const std::vector<particles::Opening>& openings);

  /// Does dust get out of a side that has no opening?
  [[nodiscard]] bool lets_dust_out(std::size_t side) const { return lets_out_[side]; }
  /// By face of a side (side, second direction, third direction): the number of the opening that
  /// draws there, -1; empty: of a side without one.
  [[nodiscard]] const std::array<std::vector<std::int32_t>, 6>& outlets() const { return outlets_; }
  /// Does dust settle on the face of this cell in a side that is not periodic? The gas may pass it
  /// all the same where the side holds grains alone.
  [[nodiscard]] bool settles_on(std::size_t side, const std::array<int, 3>& cell) const;

 private:
  void mark_opening(std::int32_t number, const particles::Opening& opening);
  [[nodiscard]] bool is_passed(std::size_t side, const std::array<int, 3>& cell) const;

  const fluid::Grid& grid_;
  std::array<bool, 6> holds_grains_{};
  std::array<bool, 6> lets_out_{};
  std::array<std::vector<bool>, 6> passed_;  ///< as preflight::passed_faces
  std::array<std::vector<std::int32_t>, 6> outlets_;
};

}  // namespace dust::run
