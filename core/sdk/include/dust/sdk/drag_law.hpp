// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"

#include <cstddef>

namespace dust::sdk {

/// Columns of `count` grains.
struct DragBatch {
  std::size_t count = 0;
  const double* reynolds = nullptr;  ///< [-] Re = eps rho_f |w| D / mu, w the interstitial slip
  const double* void_fraction = nullptr;  ///< [-] eps at the grain, in (0, 1]
  double* factor = nullptr;               ///< [-] out: F(Re, eps)
  /// [-] D over the Sauter mean diameter of the grains in the same cell; null unless
  /// DragLaw::needs_size_ratio.
  const double* size_ratio = nullptr;
};

/// Drag closure. The one convention: \f$ f_d = 3 \pi \mu D F(Re, \varepsilon) w \f$ [N] on one
/// grain, w = u_f - u_p the interstitial slip [m/s], Re with the superficial slip. F is finite and
/// above 0, at Re = 0 too: its growth with the slip is taken relative to it (a law of beds may end
/// at 0 where eps = 1). Must not: clamp, scale, log, know the grid,
/// keep state. Called from several threads at once.
class DragLaw : public Model {
 public:
  static constexpr const char* k_kind = "drag";
  virtual void evaluate(const DragBatch& batch) const = 0;
  /// Does `evaluate` read DragBatch::size_ratio? Asked once, at the start.
  [[nodiscard]] virtual bool needs_size_ratio() const { return false; }
};

}  // namespace dust::sdk
