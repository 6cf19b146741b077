// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/memory_archive.hpp"
#include "contract/scenes/synthetic_scene.hpp"
#include "dust/sdk/plugin.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <string>

/// What tests of sensors share: a plugin loaded by name, beside the world that the contract's rules
/// show to every sensor.
namespace dust::test {

using contract::begin;
using contract::Contact;
using contract::Figure;
using contract::Figures;
using contract::for_cells;
using contract::Grain;
using contract::MemoryArchive;
using contract::pressure_at;
using contract::series_of;
using contract::set_cells;
using contract::step;
using contract::summary_of;
using contract::SyntheticScene;
using contract::Wall;

/// A sensor's description and a way to make one, straight from its library.
struct SensorKind {
  sdk::ModelInfo info;
  sdk::ModelFactory factory;

  /// Parameters by name; those not given take their defaults. Fails on a name the schema lacks.
  [[nodiscard]] std::unique_ptr<sdk::Sensor> make(
      const std::map<std::string, sdk::Value>& parameters) const;
};
SensorKind load_sensor(const std::string& name);

/// Whether a figure says that it has no value, for nothing has passed.
inline bool is_of_nothing(const Figure& figure) {
  return std::isnan(figure.value) && figure.uncertainty == sdk::k_nothing_passed;
}

}  // namespace dust::test
