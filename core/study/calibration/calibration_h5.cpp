// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/calibration_h5.hpp"

#include "study/study_report.hpp"

#include <cmath>

namespace dust::study {
namespace {

/// One dataset per name; a link in an HDF5 file must not hold '/'.
void write_column(hid_t group, std::string name, const std::vector<double>& values,
                  const std::string& unit, const std::string& meaning) {
  for (char& c : name) c = c == '/' ? '|' : c;
  io::write_array(group, name, H5T_NATIVE_DOUBLE, values.data(), {values.size()},
                  io::Storage::plain, {unit.c_str(), meaning.c_str()});
}

/// Values of the parameters, in their units.
void write_places(hid_t group, const WeighedPlaces& of, const CalibrationSettings& settings,
                  const char* meaning) {
  for (std::size_t d = 0; d < settings.parameters.size(); ++d) {
    const Freedom& p = settings.parameters[d];
    std::vector<double> values;
    for (const auto& share : of.places) values.push_back(p.low + share[d] * (p.high - p.low));
    write_column(group, p.name, values, p.unit, meaning);
  }
}

}  // namespace

void write_landscape(hid_t root, const CalibrationAnswer& answer) {
  const Landscape& landscape = answer.calibration.landscape;
  if (landscape.places.empty()) return;  // interrupted before the first surrogate was learnt
  const io::Handle group = io::create_group(root, "calibration");
  io::write_attribute(group.get(), "region_level", landscape.region_level);
  io::write_attribute(group.get(), "confidence", answer.settings.confidence);
  write_column(group.get(), "minus_log_density", landscape.minus_log, "1",
               "minus the logarithm of the density, from 0 at the best place; the region is where "
               "it is at most region_level");
  const io::Handle places = io::create_group(group.get(), "places");
  write_places(places.get(), landscape, answer.settings, "place of the grid");
  if (!landscape.cloud.places.empty()) {
    const io::Handle drawn = io::create_group(group.get(), "drawn_places");
    write_places(drawn.get(), landscape.cloud, answer.settings,
                 "place drawn from the density, each of the same weight");
  }
  const io::Handle means = io::create_group(group.get(), "targets");
  const io::Handle errors = io::create_group(group.get(), "targets_error");
  for (std::size_t g = 0; g < answer.settings.goals.size(); ++g) {
    const Goal& goal = answer.settings.goals[g];
    std::vector<double> mean;
    std::vector<double> error;
    for (const Prediction& p : landscape.predictions[g]) {
      mean.push_back(p.mean);
      error.push_back(std::sqrt(p.variance));
    }
    write_column(means.get(), goal.name, mean, goal.unit, "what the surrogate says");
    write_column(errors.get(), goal.name, error, goal.unit, "standard error of the surrogate");
  }
}

}  // namespace dust::study
