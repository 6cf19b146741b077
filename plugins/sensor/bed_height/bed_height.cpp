// SPDX-License-Identifier: Apache-2.0
#include "bed_height.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::bed_height;
namespace sdk = dust::sdk;

class BedHeight final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 base;
    sdk::Vec3 direction;
    double share = 0.99;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::base, "base", sdk::dimension::length, "A point of the floor of the bed.");
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Upwards; [0, 0, 0] = against gravity.")
        .optional();
    s.number(&Parameters::share, "share", sdk::dimension::none,
             "Share of the grains' mass below the bed's surface.")
        .above(0)
        .at_most(1)
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "bed_height",
        .version = "1.0",
        .summary = "Height of a bed: of the share of its mass, and twice that of its centre.",
        .equation =
            R"(H: \sum_{z_i < H} w_i m_i = s \sum w_i m_i, \quad H_c = 2 \frac{\sum w_i m_i z_i}{\sum w_i m_i})",
        .source = "own definition"};
  }

  explicit BedHeight(const Parameters& p) : p_(p) {}

  void observe(const sdk::WorldView& world) override {
    sdk::Vec3 up = norm(p_.direction) > 0.0 ? p_.direction : -world.gravity;
    if (!(norm(up) > 0.0)) {
      throw sdk::ModelError("bed_height needs a direction where there is no gravity");
    }
    up = up / norm(up);
    const sdk::GrainColumns& g = world.grains;
    heights_.clear();
    masses_.clear();
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      heights_.push_back(dot(up, sdk::Vec3{g.x[i], g.y[i], g.z[i]} - p_.base));
      masses_.push_back(g.weight[i] * g.mass[i]);
    }
    const formula::Profile profile(heights_, masses_);
    figures_.add(world, {profile.below(p_.share), 2.0 * profile.mean()}, p_.steady_after);
  }

  void series(sdk::FigureSink& sink) const override { figures_.series(sink); }
  void summary(sdk::FigureSink& sink) const override { figures_.summary(sink); }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Bed height", "time [s]", "height [m]", "surface", figures_.curve().x(),
               figures_.curve().y());
  }

  void save(sdk::ArchiveWriter& a) const override { figures_.save(a); }
  void load(sdk::ArchiveReader& a) override { figures_.load(a); }

 private:
  Parameters p_;
  std::vector<double> heights_;
  std::vector<double> masses_;
  sdk::SampledFigures figures_{
      {{"height", "m", sdk::Quantity::length}, {"twice_centre", "m", sdk::Quantity::length}}};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<BedHeight>(); }
