// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/archive.hpp"
#include "contract/units.hpp"
#include "dust/sdk/sensor.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

/// A world made by hand for sensors to look at, and their figures as a table.
namespace dust::contract {

struct Figure {
  double value = 0.0;
  std::string unit;
  double uncertainty = -1.0;
};

/// Figures in the order given; `at` throws for an unknown name.
class Figures final : public sdk::FigureSink {
 public:
  void figure(std::string_view name, double value, std::string_view unit,
              double uncertainty) override;
  [[nodiscard]] const Figure& at(const std::string& name) const;
  [[nodiscard]] double operator[](const std::string& name) const { return at(name).value; }
  [[nodiscard]] const std::vector<std::pair<std::string, Figure>>& all() const { return figures_; }
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::vector<std::pair<std::string, Figure>> figures_;
};
Figures summary_of(const sdk::Sensor& sensor);
Figures series_of(const sdk::Sensor& sensor);

struct Grain {
  sdk::Vec3 before;
  sdk::Vec3 now;
  sdk::Vec3 velocity;
  double diameter = 300e-6;
  double mass = 1e-9;
  double weight = 1.0;
  sdk::Vec3 force;
  sdk::Vec3 angular_velocity = {};
};

/// A contact of grain `i` with grain `j`, or with a wall (-1).
struct Contact {
  std::int32_t i = 0;
  std::int32_t j = -1;
  sdk::Vec3 force;   ///< on i
  sdk::Vec3 branch;  ///< from i to j, or to the wall
  double overlap = 1e-9;
};

struct Wall {
  std::string name;
  std::string group;
  sdk::Vec3 force;
  sdk::Vec3 torque;
  double power = 0.0;
  double mass = 0.0;
  std::int64_t contacts = 0;
};

/// A world that owns its columns.
class World {
 public:
  double time = 0.0;
  double interval = 0.001;
  sdk::Vec3 domain_min{0, 0, 0};
  sdk::Vec3 domain_max{0.33, 0.011, 0.35};
  sdk::Vec3 gravity{0, 0, -9.81};
  std::vector<double> class_diameters = {10e-6, 300e-6, 600e-6};
  double emitted_mass = 0.0;
  std::vector<Grain> grains;
  std::vector<Contact> contacts;
  std::vector<Wall> walls;
  std::vector<sdk::WallImpact> impacts;
  int count[3] = {0, 0, 0};
  sdk::Vec3 spacing{0.001, 0.001, 0.001};
  double density = 1.2;
  double viscosity = 1.8e-5;
  std::vector<float> pressure;
  std::vector<float> open_fraction;
  std::vector<float> velocity[3];
  std::vector<float> void_fraction;
  Units units;  ///< in which the world is shown; everything above is SI

  /// Sets the number of cells; still air, pressure 0, all open, no solids.
  void set_cells(int nx, int ny, int nz);
  float& pressure_at(int i, int j, int k) {
    return pressure[static_cast<std::size_t>(i + count[0] * (j + count[1] * k))];
  }
  /// Calls set(cell, centre [m]) for all cells.
  template <class Set>
  void for_cells(const Set& set) const {
    for (int k = 0; k < count[2]; ++k) {
      for (int j = 0; j < count[1]; ++j) {
        for (int i = 0; i < count[0]; ++i) {
          set(static_cast<std::size_t>(i + count[0] * (j + count[1] * k)),
              domain_min +
                  sdk::Vec3{(i + 0.5) * spacing.x, (j + 0.5) * spacing.y, (k + 0.5) * spacing.z});
        }
      }
    }
  }
  /// Valid until the world changes.
  const sdk::WorldView& view();

 private:
  void show_grains();
  void show_contacts();
  void show_walls();
  void show_fluid();

  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  std::vector<double> columns_[18];
  std::vector<std::int32_t> partners_[2];
  std::vector<double> contact_columns_[7];
  std::vector<std::string> wall_name_, wall_group_;
  std::vector<sdk::Vec3> wall_force_, wall_torque_;
  std::vector<double> wall_power_, wall_mass_;
  std::vector<std::int64_t> wall_contacts_;
  std::vector<sdk::WallImpact> impacts_shown_;
  std::vector<float> pressure_shown_;
  std::vector<float> velocity_shown_[3];
  std::vector<double> classes_shown_;
  sdk::WorldView view_;
};

/// Shows `world` to `sensor` as the next sample.
void step(sdk::Sensor& sensor, World& world);

}  // namespace dust::contract
