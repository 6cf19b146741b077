// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/scenes/synthetic_scene.hpp"
#include "dust/sdk/random.hpp"

namespace dust::contract {

/// A stream in free flight from a belt's end, dust that rides back, air with wells of
/// pressure, contacts among the riders, walls that carry and are hit.
class SensorStream {
 public:
  /// Shown in `units`.
  explicit SensorStream(bool is_empty = false, const Units& units = {});
  void show(sdk::Sensor& sensor);

 private:
  void fill(double time);
  void blow(double time);
  void touch(double time);
  void load_walls(double time);
  void finish(Grain& grain, int n);
  void add(int n, double since, double speed);
  void ride(int n, double time);

  SyntheticScene scene_;
  bool is_empty_;
  sdk::Random random_{7, sdk::stream_of("scene")};
};

}  // namespace dust::contract
