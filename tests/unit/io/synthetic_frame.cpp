// SPDX-License-Identifier: Apache-2.0
#include "unit/io/synthetic_frame.hpp"

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace dust::test {

float SyntheticFrame::pressure_at(int i, int j, int k) {
  return static_cast<float>(i + 100 * j + 10000 * k);
}

SyntheticFrame::SyntheticFrame(std::int64_t number, int grains, int nx, int ny, int nz) {
  for (int n = 0; n < grains; ++n) {
    id_.push_back(1000 + n);
    material_.push_back(n % 3);
    for (int c = 0; c < 15; ++c) columns_[c].push_back(0.001 * c + n + 0.25 * number);
  }
  sdk::WorldView& world = frame_.world;
  frame_.number = number;
  frame_.time = 0.02 * static_cast<double>(number);
  world.time = frame_.time;
  sdk::GrainColumns& g = world.grains;
  g.id = id_;
  g.material = material_;
  std::span<const double>* targets[15] = {&g.x,
                                          &g.y,
                                          &g.z,
                                          &g.velocity_x,
                                          &g.velocity_y,
                                          &g.velocity_z,
                                          &g.angular_velocity_x,
                                          &g.angular_velocity_y,
                                          &g.angular_velocity_z,
                                          &g.force_x,
                                          &g.force_y,
                                          &g.force_z,
                                          &g.diameter,
                                          &g.mass,
                                          &g.weight};
  for (int c = 0; c < 15; ++c) *targets[c] = columns_[c];
  if (nx * ny * nz == 0) return;

  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const float p = pressure_at(i, j, k);
        fluid_[0].push_back(p);
        fluid_[1].push_back(2 * p);
        fluid_[2].push_back(3 * p);
        fluid_[3].push_back(p);
        fluid_[4].push_back(1.0f);
        fluid_[5].push_back(0.5f);
        for (int d = 0; d < 3; ++d) exchange_.push_back(p + 0.25f * static_cast<float>(d));
      }
    }
  }
  sdk::FluidColumns& f = world.fluid;
  f.origin = {0.1, 0.2, 0.3};
  f.spacing = {0.01, 0.02, 0.03};
  f.count[0] = nx;
  f.count[1] = ny;
  f.count[2] = nz;
  f.density = 1.2;
  f.viscosity = 1.8e-5;
  f.velocity_x = fluid_[0];
  f.velocity_y = fluid_[1];
  f.velocity_z = fluid_[2];
  f.pressure = fluid_[3];
  f.void_fraction = fluid_[4];
  f.open_fraction = fluid_[5];
  frame_.momentum_exchange = exchange_;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "dust_io_XXXXXX").string();
  path_ = ::mkdtemp(pattern.data());
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace dust::test
