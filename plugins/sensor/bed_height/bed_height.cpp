// SPDX-License-Identifier: Apache-2.0
#include "bed_height.hpp"

#include "dust/sdk/plugin.hpp"
#include "dust/sdk/sampling.hpp"

namespace {

using namespace dust::sdk;
namespace formula = dust::model::bed_height;

class BedHeight final : public Sensor {
 public:
  struct Parameters : SelectionParameters {
    Vec3 base;
    Vec3 direction;
    double share = 0.99;
  };

  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::base, "base", dimension::length, "A point of the floor of the bed.");
    s.vector(&Parameters::direction, "direction", dimension::none,
             "Upwards; [0, 0, 0] = against gravity.")
        .optional();
    s.number(&Parameters::share, "share", dimension::none,
             "Share of the grains' mass below the bed's surface.")
        .above(0)
        .at_most(1)
        .optional();
    declare_selection(s);
    return s.build();
  }

  static ModelInfo describe() {
    return {
        "",
        "bed_height",
        "1.0",
        "Height of a bed: of the share of its mass, and twice that of its centre.",
        R"(H: \sum_{z_i < H} w_i m_i = s \sum w_i m_i, \quad H_c = 2 \frac{\sum w_i m_i z_i}{\sum w_i m_i})",
        "own definition",
        {}};
  }

  explicit BedHeight(const Parameters& p) : p_(p) {}

  void observe(const WorldView& world) override {
    Vec3 up = norm(p_.direction) > 0.0 ? p_.direction : -world.gravity;
    if (!(norm(up) > 0.0)) {
      throw ModelError("bed_height needs a direction where there is no gravity");
    }
    up = up / norm(up);
    const GrainColumns& g = world.grains;
    heights_.clear();
    masses_.clear();
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      heights_.push_back(dot(up, Vec3{g.x[i], g.y[i], g.z[i]} - p_.base));
      masses_.push_back(g.weight[i] * g.mass[i]);
    }
    const formula::Profile profile(heights_, masses_);
    values_ = {heights_.empty() ? 0.0 : profile.below(p_.share), 2.0 * profile.mean()};
    if (is_after(world, p_.steady_after)) means_.add(values_, world.interval);
    curve_.add(world.time, values_[0]);
  }

  void series(FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) sink.figure(k_names[n], values_[n], "m");
  }
  void summary(FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) {
      const double mean = means_.mean(n);
      sink.figure(k_names[n], mean, "m", mean != 0.0 ? means_.error(n) : -1.0);
      sink.figure(std::string(k_names[n]) + "_at_end", values_[n], "m");
    }
  }
  void report(ReportSink& sink) const override {
    sink.curve("Bed height", "time [s]", "height [m]", "surface", curve_.x(), curve_.y());
  }

  void save(ArchiveWriter& a) const override {
    a.numbers("values", values_);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(ArchiveReader& a) override {
    values_ = a.numbers("values");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr std::size_t k_columns = 2;
  static constexpr const char* k_names[k_columns] = {"height", "twice_centre"};

  Parameters p_;
  std::vector<double> values_ = std::vector<double>(k_columns, 0.0);  ///< at the last sample
  std::vector<double> heights_;
  std::vector<double> masses_;
  BatchMeans means_{k_columns};
  ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<BedHeight>(); }
