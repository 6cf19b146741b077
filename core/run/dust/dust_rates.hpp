// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sampling.hpp"
#include "dust/sdk/sensor.hpp"
#include "particles/dem.hpp"
#include "run/archive_parts.hpp"
#include "run/dust/dust_stage.hpp"
#include "run/dust/liberation_stage.hpp"
#include "run/dust/steady_window.hpp"
#include "setup/setup.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// The value of an amount per load of a feed that is not even.
inline constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

/// At what rates the dust of a field comes off grains and goes where it goes, once the stream is
/// steady: means over time since `steady_after`, with standard errors from batch means
/// (sdk::BatchMeans). What came before, while the stream began, is left out.
class DustRates {
 public:
  /// All are kept by reference; `liberation` may be null. `steady_after` in s.
  DustRates(const scenario::Setup& setup, const DustStage& dust, const LiberationStage* liberation,
            const particles::Dem& particles, double steady_after);

  /// Means begin anew, at `time` [s].
  void begin_at(double time);
  [[nodiscard]] const SteadyWindow& steady() const { return steady_; }
  /// At the end of a fluid step of `step` [s], at `time` [s].
  void sample(double time, double step);

  /// "observed" [s]; by way ("released": what sources give) the sum of its parts
  /// ("all"), then each of them, of all classes together and of each: "set_free/hood/rate" [kg/h]
  /// and, where material is released, "set_free/hood/per_load" [g/t];
  /// "left/right/class/10_um/rate".
  void report(sdk::FigureSink& sink) const;

  void add_parts(SaveParts& parts) const;
  void add_parts(LoadParts& parts);

 private:
  /// A part of a way: a cause, a side, a hood.
  struct Part {
    std::string way;
    std::string name;
    std::function<double(std::size_t n)> total;  ///< [kg] of class n since the start
  };
  void find_parts(const scenario::Setup& setup);
  void find_totals(std::vector<double>& totals) const;
  void report_part(sdk::FigureSink& sink, const std::string& name, std::size_t column) const;

  const DustStage& dust_;
  const LiberationStage* liberation_;
  const particles::Dem& particles_;
  SteadyWindow steady_;
  std::vector<airborne::DustBalance> balances_;  ///< by class, of the last step looked at
  std::vector<Part> parts_;                      ///< in the order of their ways
  /// [kg] since the start: material released; by way the sum of its parts, then each part; of each
  /// all classes, then each.
  std::vector<double> before_;
  std::vector<double> now_;
  double time_ = 0.0;  ///< [s] of `now_`
  /// [s] of `before_`; nothing: that of the checkpoint it comes from. A run that starts from
  /// another inherits totals of which it has no earlier ones.
  std::optional<double> before_time_ = 0.0;
  sdk::BatchMeans means_;  ///< [kg/s] of the columns of `now_`
};

}  // namespace dust::run
