// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dust::study {

/// A mean with its standard error; negative: none.
struct Uncertain {
  double value = 0.0;
  double error = -1.0;
};

/// What a hood did at one flow, over the time after its flow had come about. Rates are of dust; one
/// that still changes has as its error how far stretches of the time lie from the mean.
struct HoodTrial {
  double flow = 0.0;          ///< [m3/s]
  Uncertain drawn;            ///< [kg/s] through the hood that is tried; none in the plain run
  Uncertain drawn_by_others;  ///< [kg/s] through hoods that stand there anyway
  Uncertain escaping;         ///< [kg/s] through the openings and open sides that are watched
  double load = 0.0;          ///< [kg/s] released, dust and all; 0 without grains
  double computed = -1.0;  ///< computed grains of dust that all hoods have drawn; negative: a field
  std::size_t replicas = 1;     ///< runs that it is the mean of
  double capture_error = -1.0;  ///< [-] of three replicas or more; negative: that of both rates

  /// What all hoods draw over that and what escapes; nothing where neither was seen. Without an
  /// error where one of the two rates has none.
  [[nodiscard]] std::optional<Uncertain> capture() const;
};

/// A place with the trials of its flows, ascending.
struct HoodPlace {
  std::string name;  ///< "place_1"
  std::vector<HoodTrial> trials;
  std::optional<sdk::Vec3> opening =
      std::nullopt;  ///< [m] the middle of the hood's opening, where it is known
};

/// A finished study of hoods.
struct HoodResults {
  std::vector<HoodPlace> places;
  std::optional<HoodTrial> plain;  ///< without a hood that is tried

  /// Do hoods draw that stand there anyway?
  [[nodiscard]] bool has_others() const;
};

/// The mean of trials of one hood with other seeds. Its errors are those of the trials in the mean,
/// for all begin with the same state, or, of three and more, that of their scatter, whichever is
/// larger.
[[nodiscard]] HoodTrial mean_of(std::span<const HoodTrial> trials);

/// How amounts of dust are given: per tonne of load, or per hour where nothing is loaded.
struct HoodScale {
  bool is_per_load = true;

  explicit HoodScale(const HoodResults& results);
  [[nodiscard]] std::string unit() const { return is_per_load ? "g/t" : "g/h"; }
  /// By which a rate of the trial in kg/s is multiplied.
  [[nodiscard]] double factor(const HoodTrial& trial) const;
};

/// A hood that has drawn fewer computed grains says how many instead of an error.
inline constexpr double k_few_drawn = 20.0;

/// Reads the points of a study that hood_study wrote. Throws base::UserError with a remedy where
/// points are missing or have not finished, or where it is another study.
[[nodiscard]] HoodResults hood_results(const std::filesystem::path& study);

/// Whether the folder holds a study, finished or not.
[[nodiscard]] bool is_study(const std::filesystem::path& folder);

/// The smallest flow [m3/s] at which a hood at a place, with those that stand there anyway,
/// captures `wanted` (0 to 1), between two trials on a straight line; nothing where no trial
/// reaches it, or the smallest is above it already and `is_bound` is set: then the flow is an upper
/// bound.
struct NeededFlow {
  double flow = 0.0;
  bool is_bound = false;
};
[[nodiscard]] std::optional<NeededFlow> needed_flow(const HoodPlace& place, double wanted);

/// What the page of the study shows (tools/report/report.schema.json, hoods).
[[nodiscard]] nlohmann::json hoods_json(const HoodResults& results);

/// The table and the flows needed for `wanted`, for a terminal.
[[nodiscard]] std::string hood_table(const HoodResults& results, double wanted);

}  // namespace dust::study
