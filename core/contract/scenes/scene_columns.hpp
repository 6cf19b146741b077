// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/scenes/synthetic_scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dust::contract {

/// A scene's columns as a sensor sees them, in the scene's units: no more than a run shows it.
class SceneColumns {
 public:
  SceneColumns(const SyntheticScene& scene, const sdk::Sensor& sensor);
  SceneColumns(const SceneColumns&) = delete;  // the view points into the columns
  SceneColumns& operator=(const SceneColumns&) = delete;
  ~SceneColumns() = default;
  /// Valid as long as this is.
  [[nodiscard]] const sdk::WorldView& view() const { return view_; }

 private:
  /// Of the faces across one direction.
  struct Faces {
    std::vector<float> flux, open, void_fraction;
  };
  struct WallColumns {
    std::vector<std::string> name, group;
    std::vector<sdk::Vec3> force, torque;
    std::vector<double> power, mass;
    std::vector<std::int64_t> contacts;
  };

  void show_domain(const SyntheticScene& scene);
  void show_particles(const SyntheticScene& scene);
  void show_contacts(const SyntheticScene& scene);
  void show_walls(const SyntheticScene& scene);
  void show_slidings(const SyntheticScene& scene);
  void show_fluid(const SyntheticScene& scene);
  void show_faces(const SyntheticScene& scene);

  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  std::vector<double> columns_[18];
  std::vector<std::int32_t> partners_[2];
  std::vector<double> contact_columns_[10];
  WallColumns walls_;
  std::vector<sdk::WallImpact> impacts_;
  std::vector<sdk::WallSliding> slidings_;
  std::vector<float> pressure_;
  std::vector<float> velocity_[3];
  Faces faces_[3];
  std::vector<double> class_diameters_;
  sdk::WorldView view_;
};

}  // namespace dust::contract
