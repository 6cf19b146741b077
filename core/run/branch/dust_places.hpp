// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "scenario/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace dust::run {

/// Where the dust of another run is in this one: on surfaces and in openings of the same names.
/// What bodies and openings that are gone had taken is in none of its balances.
class DustPlaces {
 public:
  DustPlaces(const scenario::ReadResult& then, const scenario::ReadResult& now);

  /// Looks at what the other run's field of dust has saved, class by class.
  void find_dropped(sdk::ArchiveReader& field);
  /// [kg] of all classes.
  [[nodiscard]] double dropped() const;

  /// Numbers of the field as they are here.
  void change(std::string_view name, std::vector<double>& values) const;
  void change(std::string_view name, std::vector<std::int64_t>& values) const;

 private:
  /// Sums that go by surface or by opening: to what number here, or -1.
  [[nodiscard]] const std::vector<std::int64_t>* numbers_of(std::string_view name) const;

  std::vector<std::int64_t> surface_;  ///< number here by that in the other run; -1: gone
  std::vector<std::int64_t> opening_;
  std::size_t surfaces_ = 0;     ///< here
  std::size_t openings_ = 0;     ///< here
  std::vector<double> dropped_;  ///< [kg] by class
  double cell_volume_ = 1.0;     ///< [m3] which sums of openings are over
  bool do_surfaces_run_ = false;
};

}  // namespace dust::run
