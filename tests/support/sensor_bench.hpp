// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/plugin.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// What tests of sensors share: a plugin loaded by name, a world made by hand, figures as a table.
namespace dust::test {

/// A sensor's description and a way to make one, straight from its library.
struct SensorKind {
  sdk::ModelInfo info;
  sdk::ModelFactory factory;

  /// Parameters by name; those not given take their defaults. Fails on a name the schema lacks.
  [[nodiscard]] std::unique_ptr<sdk::Sensor> make(
      const std::map<std::string, sdk::Value>& parameters) const;
};
SensorKind load_sensor(const std::string& name);

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

/// State kept in memory; fails on a name used twice or missing.
class MemoryArchive final : public sdk::ArchiveWriter, public sdk::ArchiveReader {
 public:
  void numbers(std::string_view name, std::span<const double> values) override;
  void integers(std::string_view name, std::span<const std::int64_t> values) override;
  std::vector<double> numbers(std::string_view name) override;
  std::vector<std::int64_t> integers(std::string_view name) override;
  using sdk::ArchiveReader::integer;
  using sdk::ArchiveReader::number;

 private:
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};

struct Grain {
  sdk::Vec3 before;
  sdk::Vec3 now;
  sdk::Vec3 velocity;
  double diameter = 300e-6;
  double mass = 1e-9;
  double weight = 1.0;
  sdk::Vec3 force;
  sdk::Vec3 rotation = {};
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
  std::vector<float> pressure;
  std::vector<float> open_fraction;

  /// Sets the number of cells; pressure 0, all open.
  void set_cells(int nx, int ny, int nz);
  float& pressure_at(int i, int j, int k) { return pressure[i + count[0] * (j + count[1] * k)]; }
  /// Valid until the world changes.
  const sdk::WorldView& view();

 private:
  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  std::vector<double> columns_[18];
  std::vector<std::int32_t> partners_[2];
  std::vector<double> contact_columns_[7];
  std::vector<std::string> wall_name_, wall_group_;
  std::vector<sdk::Vec3> wall_force_, wall_torque_;
  std::vector<double> wall_power_, wall_mass_;
  std::vector<std::int64_t> wall_contacts_;
  std::vector<float> still_air_;
  std::vector<float> no_solids_;
  sdk::WorldView view_;
};

/// Shows `world` to `sensor` as the next sample.
void step(sdk::Sensor& sensor, World& world);

}  // namespace dust::test
