// SPDX-License-Identifier: Apache-2.0
#include "run/snapshots/sensor_fields.hpp"

#include "dust/sdk/error.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace dust::run {
namespace {

class Collector final : public sdk::FieldSink {
 public:
  explicit Collector(const Simulation& simulation) {
    const auto& sensors = simulation.models().sensors;
    for (std::size_t n = 0; n < sensors.size(); ++n) {
      sensor_ = simulation.setup().sensors[n].name;
      sensors[n]->fields(*this);
    }
  }
  void field(std::string_view name, std::string_view unit, const sdk::GridShape& grid,
             std::span<const double> values, const sdk::FigureRole& role) override {
    const auto cells = static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2];
    if (values.size() != cells) {
      throw sdk::ModelError("the sensor " + sensor_ + " gives " + std::to_string(values.size()) +
                            " numbers for its field " + std::string(name) +
                            "; expected: one for "
                            "each of its " +
                            std::to_string(cells) + " cells");
    }
    fields_.push_back({sensor_,
                       std::string(name),
                       std::string(unit),
                       grid,
                       {values.begin(), values.end()},
                       std::string(sdk::name_of(role.role)),
                       std::string(sdk::info_of(role.quantity).name)});
  }
  std::vector<io::SensorField> take() { return std::move(fields_); }

 private:
  std::string sensor_;
  std::vector<io::SensorField> fields_;
};

}  // namespace

std::vector<io::SensorField> fields_of_sensors(const Simulation& simulation) {
  return Collector(simulation).take();
}

}  // namespace dust::run
