// SPDX-License-Identifier: Apache-2.0
#include "wall_shear.hpp"

#include <dust/sdk/fluid_cells.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <array>

namespace {

namespace formula = dust::model::wall_shear;
namespace sdk = dust::sdk;

constexpr std::array<const char*, 6> k_sides = {"left", "right", "front", "back", "bottom", "top"};

class WallShear final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    std::string side;
    sdk::Vec3 wall_velocity;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::side, "side", "The side of the domain that is looked at.")
        .one_of({k_sides.begin(), k_sides.end()});
    s.vector(&Parameters::wall_velocity, "wall_velocity", sdk::dimension::velocity,
             "Velocity of the wall itself; its part along the wall counts.")
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "wall_shear",
            .version = "1.0",
            .summary = "Shear stress and friction force of the air on a side of the domain.",
            .equation = R"(\tau = \mu \frac{u_t - u_w}{h / 2}, \quad F = \int \tau\, dA)",
            .source = "own definition"};
  }

  explicit WallShear(const Parameters& p) : p_(p) {
    for (int n = 0; n < 6; ++n) {
      if (p.side == k_sides[static_cast<std::size_t>(n)]) side_ = n;
    }
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  [[nodiscard]] sdk::SurfacesWanted wanted_surfaces() const override {
    sdk::SurfacesWanted wanted;
    wanted.rubbed_side = p_.side;
    return wanted;
  }
  void observe(const sdk::WorldView& world) override {
    const sdk::FluidColumns& f = world.fluid;
    const sdk::FluidCells cells(f);
    if (cells.is_empty()) return;
    const int d = side_ / 2;
    const int e = (d + 1) % 3;
    const int g = (d + 2) % 3;
    const std::span<const float> u[3] = {f.velocity_x, f.velocity_y, f.velocity_z};
    double largest = 0.0;
    const auto layer = side_ % 2 == 0 ? 0 : cells.count(d) - 1;
    const auto stress = [&](int along, std::size_t c) {
      return formula::stress(
          f.viscosity, static_cast<double>(u[along][c]) - p_.wall_velocity[along], f.spacing[d]);
    };
    const auto size = [&](std::size_t c) {
      const double s = std::hypot(stress(e, c), stress(g, c));
      largest = std::max(largest, s);
      return s;
    };
    const sdk::FluidCells::LayerSum mean = cells.layer(d, layer, size);
    const double area = f.spacing[e] * f.spacing[g];
    sdk::Vec3 force;
    force[e] = area * cells.layer(d, layer, [&](std::size_t c) { return stress(e, c); }).sum;
    force[g] = area * cells.layer(d, layer, [&](std::size_t c) { return stress(g, c); }).sum;
    figures_.add(world,
                 {mean.open > 0.0 ? mean.sum / mean.open : sdk::k_no_value, largest, force.x,
                  force.y, force.z},
                 p_.steady_after);
  }

  void series(sdk::FigureSink& sink) const override { figures_.series(sink); }
  void summary(sdk::FigureSink& sink) const override { figures_.summary(sink); }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Wall shear stress", "time [s]", "stress [Pa]", p_.side, figures_.curve().x(),
               figures_.curve().y());
  }

  void save(sdk::ArchiveWriter& a) const override { figures_.save(a); }
  void load(sdk::ArchiveReader& a) override { figures_.load(a); }

 private:
  Parameters p_;
  int side_ = 0;
  sdk::SampledFigures figures_{{{"mean", "Pa", sdk::Quantity::pressure},
                                {"largest", "Pa", sdk::Quantity::pressure},
                                {"force_x", "N", sdk::Quantity::force},
                                {"force_y", "N", sdk::Quantity::force},
                                {"force_z", "N", sdk::Quantity::force}}};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<WallShear>(); }
