// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dust::study {

/// Something that a finished run tells in its summary.json.
struct Quantity {
  std::string path;        ///< dotted: sensors.stream.drop_140_mm.median, particles.max
  std::string unit;        ///< "1" for bare numbers
  bool has_error = false;  ///< the run tells one beside it
  /// A run that tells of this other one tells nothing of something that is 0 (no dust on a
  /// surface). Empty: always told.
  std::string zero_beside;
};

/// Every quantity a run of `setup` will tell, known before it is run: those of summary.json, and
/// the figures its sensors name when they look at a domain without grains. `dust` is what the
/// scenario says of dust.
std::vector<Quantity> quantities_of(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry);

/// The quantity at `path`, where '/' stands for '.' as well; null where there is none.
const Quantity* find_quantity(const std::vector<Quantity>& all, const std::string& path);

/// "; did you mean ...?" or what there is under the part of the path that is right.
std::string quantity_hint(const std::vector<Quantity>& all, const std::string& path);

/// Factor from numbers in unit `from` to those in `to`; nothing where they do not measure the same.
std::optional<double> unit_factor(const std::string& from, const std::string& to);

/// A figure of a finished run.
struct Figure {
  double value = 0.0;   ///< NaN where the run says that there is none
  double error = -1.0;  ///< one standard error, negative: none
  std::string unit;     ///< of sensors
  std::string no_error =
      {};  ///< why there is no error: "few grains", "nothing passed"; "" = not said
};

/// All figures of a summary.json by dotted path. Throws base::RunError where it cannot be read.
std::map<std::string, Figure> read_figures(const std::filesystem::path& summary);

}  // namespace dust::study
