// SPDX-License-Identifier: Apache-2.0
#include "angle_of_repose.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <limits>

namespace {

namespace formula = dust::model::angle_of_repose;
namespace sdk = dust::sdk;

constexpr double k_far = std::numeric_limits<double>::infinity();
constexpr double k_degrees = 180.0 / std::numbers::pi;
/// Edge of the cells over which the highest grain is looked for, in largest grains.
constexpr double k_edge = 2.0;

class AngleOfRepose final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    std::string form = "conical";
    sdk::Vec3 centre;
    sdk::Vec3 direction{1.0, 0.0, 0.0};
    sdk::Vec3 min{-k_far, -k_far, -k_far};
    sdk::Vec3 max{k_far, k_far, k_far};
    double from_share = 0.2;
    double to_share = 0.8;
    double cell = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::form, "form",
           "Form of the free surface: a cone, a plane slope, or the crater round an outlet.")
        .one_of({"conical", "planar", "crater"})
        .optional();
    s.vector(&Parameters::centre, "centre", sdk::dimension::length,
             "A point of the axis of a cone or crater.")
        .optional();
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Level direction down a plane slope.")
        .optional();
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the box looked at; without it, the whole domain.")
        .optional();
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.")
        .optional();
    s.number(&Parameters::from_share, "from_share", sdk::dimension::none,
             "Share of the slope's height from which it is fitted: the foot is left out.")
        .at_least(0)
        .below(1)
        .optional();
    s.number(&Parameters::to_share, "to_share", sdk::dimension::none,
             "Share of the slope's height up to which it is fitted: the rounded top is left out.")
        .above(0)
        .at_most(1)
        .optional();
    s.number(&Parameters::cell, "cell", sdk::dimension::length,
             "Edge of the cells whose highest grain is the surface; 0 = two largest grains.")
        .at_least(0)
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "angle_of_repose",
        .version = "1.0",
        .summary = "Slope of a free surface, fitted to its highest grains, with its uncertainty.",
        .equation = R"(\theta = \arctan |b|,\ h = a + b\,s)",
        .source = "own definition"};
  }

  explicit AngleOfRepose(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d]))
        throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
    }
    if (!(p.to_share > p.from_share))
      throw sdk::ParameterError("to_share must lie above from_share");
    if (!(norm(p.direction) > 0.0)) throw sdk::ParameterError("'direction' must not be zero");
  }

  void observe(const sdk::WorldView& world) override {
    found_ = {};
    has_slope_ = false;
    const double g = norm(world.gravity);
    if (g > 0.0) measure(world, world.gravity / -g);
    const auto points = static_cast<double>(found_.line.points);
    values_ = has_slope_ ? std::vector{k_degrees * found_.angle, found_.line.residual, points}
                         : std::vector{sdk::k_no_value, sdk::k_no_value, points};
    if (!has_slope_) return;
    if (sdk::is_after(world, p_.steady_after)) means_.add({values_.data(), 1}, world.interval);
    curve_.add(world.time, values_[0]);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("angle", values_[0], "deg", sdk::error_beside(values_[0], sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::angle));
  }
  void summary(sdk::FigureSink& sink) const override {
    sink.figure("angle", values_[0], "deg", sdk::error_beside(values_[0], error_),
                sdk::detail(sdk::Quantity::angle));
    const double mean = means_.known_mean(0);
    sink.figure("mean_angle", mean, "deg",
                sdk::error_beside(mean, mean > 0.0 ? means_.error(0) : sdk::k_no_estimate),
                sdk::overview(sdk::Quantity::angle, 1));
    sink.figure("residual", values_[1], "m", sdk::error_beside(values_[1], sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::length));
    sink.figure("surface_grains", values_[2], "1", sdk::Quantity::number);
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Angle of repose", "time [s]", "angle [deg]", "fit", curve_.x(), curve_.y());
    sink.curve("Free surface at the end", "down the slope [m]", "height [m]", "highest grains",
               along_, height_);
    sink.curve("Free surface at the end", "down the slope [m]", "height [m]", "fit", line_along_,
               line_height_);
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    a.number("error", error_);
    a.numbers("along", along_);
    a.numbers("height", height_);
    a.numbers("line_along", line_along_);
    a.numbers("line_height", line_height_);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    values_ = a.numbers("values");
    error_ = a.number("error");
    along_ = a.numbers("along");
    height_ = a.numbers("height");
    line_along_ = a.numbers("line_along");
    line_height_ = a.numbers("line_height");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  void measure(const sdk::WorldView& world, sdk::Vec3 up) {
    error_ = -1.0;
    // Level axes: the first down the slope for a plane.
    const sdk::Vec3 level = p_.direction - dot(p_.direction, up) * up;
    if (!(norm(level) > 0.0)) throw sdk::ModelError("angle_of_repose: 'direction' is not level");
    const sdk::Vec3 first = level / norm(level);
    const sdk::Vec3 second = cross(up, first);
    const double largest = world.class_diameters.empty() ? 1e-3 : world.class_diameters.back();
    formula::FreeSurface surface(p_.cell > 0.0 ? p_.cell : k_edge * largest);
    const sdk::GrainColumns& g = world.grains;
    double low = k_far;
    double high = -k_far;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!takes(g, i)) continue;
      const double v = dot(sdk::Vec3{g.x[i], g.y[i], g.z[i]}, second);
      low = std::min(low, v);
      high = std::max(high, v);
    }
    const bool is_planar = p_.form == "planar";
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!takes(g, i)) continue;
      const sdk::Vec3 x{g.x[i], g.y[i], g.z[i]};
      const sdk::Vec3 off = x - p_.centre;
      const double u = dot(off, first);
      const double v = dot(off, second);
      const double share = is_planar ? (dot(x, second) - low) / std::max(high - low, 1e-300)
                                     : std::atan2(v, u) / (2.0 * std::numbers::pi) + 0.5;
      const int sector =
          std::clamp(static_cast<int>(share * formula::k_sectors), 0, formula::k_sectors - 1);
      surface.add(u, v,
                  {is_planar ? u : std::hypot(u, v), dot(off, up) + 0.5 * g.diameter[i], sector});
    }
    found_ = formula::repose(surface.points(), p_.from_share, p_.to_share);
    has_slope_ = found_.line.points >= formula::k_min_points;
    // A crater rises outwards, a cone falls: a slope the other way is no such form.
    if ((p_.form == "crater" && found_.line.slope < 0.0) ||
        (p_.form == "conical" && found_.line.slope > 0.0)) {
      found_ = {};
    }
    error_ = found_.error < 0.0 ? -1.0 : k_degrees * found_.error;
    keep_picture(surface.points());
  }

  void keep_picture(const std::vector<formula::SurfacePoint>& points) {
    sdk::ThinnedCurve seen;
    auto sorted = points;
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
      return a.along != b.along ? a.along < b.along : a.height < b.height;
    });
    for (const auto& p : sorted) seen.add(p.along, p.height);
    along_.assign(seen.x().begin(), seen.x().end());
    height_.assign(seen.y().begin(), seen.y().end());
    line_along_ = {found_.low, found_.high};
    line_height_.clear();
    for (const double s : line_along_) {
      line_height_.push_back(found_.line.top + found_.line.slope * s);
    }
  }

  [[nodiscard]] bool takes(const sdk::GrainColumns& g, std::size_t i) const {
    return p_.takes(g.diameter[i]) && sdk::is_in_box({g.x[i], g.y[i], g.z[i]}, p_.min, p_.max);
  }

  Parameters p_;
  formula::Repose found_;   ///< no state between calls
  bool has_slope_ = false;  ///< likewise: enough grains for a line
  /// Angle [deg], residual, points.
  std::vector<double> values_ = {sdk::k_no_value, sdk::k_no_value, 0.0};
  double error_ = -1.0;  ///< [deg]
  std::vector<double> along_, height_, line_along_, line_height_;
  sdk::BatchMeans means_{1};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<AngleOfRepose>(); }
