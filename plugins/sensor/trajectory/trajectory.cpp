// SPDX-License-Identifier: Apache-2.0
#include "trajectory.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::trajectory;
namespace sdk = dust::sdk;

/// Everything that crossed one level, in order of time.
struct Crossings {
  std::vector<double> place;   ///< [m] along the belt, from A
  std::vector<double> speed;   ///< [m/s] along gravity
  std::vector<double> weight;  ///< real grains per computed one
  std::vector<std::int64_t> size_class;
  std::vector<std::int64_t> until;  ///< number of crossings after each sample taken
  double weight_sum = 0.0;
  double moment = 0.0;  ///< [m] sum of weight * place

  void add(double x, double v, double w, std::size_t c) {
    place.push_back(x);
    speed.push_back(v);
    weight.push_back(w);
    size_class.push_back(static_cast<std::int64_t>(c));
    weight_sum += w;
    moment += w * x;
  }
  void end_sample() { until.push_back(static_cast<std::int64_t>(place.size())); }

  void save(sdk::ArchiveWriter& a, const std::string& name) const {
    const double sums[] = {weight_sum, moment};
    a.numbers(name + "_place", place);
    a.numbers(name + "_speed", speed);
    a.numbers(name + "_weight", weight);
    a.numbers(name + "_sums", sums);
    a.integers(name + "_class", size_class);
    a.integers(name + "_until", until);
  }
  void load(sdk::ArchiveReader& a, const std::string& name) {
    place = a.numbers(name + "_place");
    speed = a.numbers(name + "_speed");
    weight = a.numbers(name + "_weight");
    const std::vector<double> sums = a.numbers(name + "_sums");
    weight_sum = sums.at(0);
    moment = sums.at(1);
    size_class = a.integers(name + "_class");
    until = a.integers(name + "_until");
  }
};

class Trajectory final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 from;
    std::vector<double> drops;
    sdk::Vec3 along{1.0, 0.0, 0.0};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::from, "from", sdk::dimension::length,
             "Point A where the belt meets the head pulley; places and drops count from it.")
        .symbol("A");
    s.numbers(&Parameters::drops, "drops", sdk::dimension::length,
              "Distances below A, along gravity, at which the stream is measured.")
        .symbol("h")
        .above(0);
    s.vector(&Parameters::along, "along", sdk::dimension::none,
             "Direction of the belt; its part across gravity is used.")
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "trajectory",
        .version = "1.0",
        .summary =
            "Edges and middle of a falling stream at given drops: quantiles of where grains cross.",
        .equation = R"(Q(p) = \inf\{x : \sum_{x_i \le x} w_i \ge p \sum w_i\})",
        .source =
            "quantiles: Hyndman and Fan 1996, definition 5, doi:10.1080/00031305.1996.10473566; "
            "errors: Woodruff 1952, doi:10.1080/01621459.1952.10483443"};
  }

  explicit Trajectory(const Parameters& p) : p_(p), levels_(p.drops.size()) {
    if (p.drops.empty()) throw sdk::ParameterError("'drops' needs at least one length");
    for (std::size_t d = 1; d < p.drops.size(); ++d) {
      if (p.drops[d] <= p.drops[d - 1]) throw sdk::ParameterError("'drops' must ascend");
    }
    if (!(norm(p.along) > 0.0)) throw sdk::ParameterError("'along' must not be zero");
  }

  void observe(const sdk::WorldView& world) override {
    if (classes_.empty()) {
      classes_.assign(world.class_diameters.begin(), world.class_diameters.end());
    }
    const double gravity = norm(world.gravity);
    if (!(gravity > 0.0)) {
      throw sdk::ModelError(
          "needs gravity to know which way is down, and there is none: give gravity, or take the "
          "sensor out");
    }
    const sdk::Vec3 down = world.gravity / gravity;
    const sdk::Vec3 across = p_.along - dot(p_.along, down) * down;
    constexpr double k_rounding = 1e-9;
    if (!(norm(across) > k_rounding * norm(p_.along))) {
      throw sdk::ModelError(
          "'along' lies along gravity, and its part across gravity is what counts: give the way "
          "that the belt runs");
    }
    if (!sdk::is_after(world, p_.steady_after)) return;
    const sdk::Vec3 along = across / norm(across);

    const Axes axes{along, down};
    for (std::size_t i = 0; i < world.grains.id.size(); ++i) {
      if (p_.takes(world.grains.diameter[i])) add_grain(world, i, axes);
    }
    at_a_.end_sample();
    for (Crossings& level : levels_) level.end_sample();
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      const Crossings& level = levels_[d];
      const double mean =
          level.weight_sum > 0.0 ? level.moment / level.weight_sum : sdk::k_no_value;
      sink.figure(drop_name(d) + "/mean", mean, "m", sdk::error_beside(mean, sdk::k_no_estimate),
                  sdk::detail(sdk::Quantity::length));
      sink.figure(drop_name(d) + "/number", level.weight_sum, "1", sdk::Quantity::number);
    }
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view) const override {
    return sdk::RowValue::total;
  }

  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      const Crossings& level = levels_[d];
      const std::string name = drop_name(d) + "/";
      sink.figure(name + "crossings", static_cast<double>(level.place.size()), "1",
                  sdk::Quantity::number);
      sink.figure(name + "number", level.weight_sum, "1", sdk::Quantity::number);
      sdk::FigureRole role{.role = sdk::Role::stream_quantile,
                           .quantity = sdk::Quantity::length,
                           .drop = p_.drops[d]};
      for (const auto& [p, quantile] : k_quantiles) {
        figure(sink, name + quantile, sample_of(level, level.place, -1), p,
               {"m", blocks_of(level), p_.sized(at(role, p))});
      }
      figure(sink, name + "median_vertical_speed", sample_of(level, level.speed, -1), 0.5,
             {"m/s", blocks_of(level), sdk::detail(sdk::Quantity::velocity)});
      for (std::size_t c = 0; c < classes_.size(); ++c) {
        if (!p_.takes(classes_[c])) continue;
        figure(sink, name + sdk::class_name(classes_[c]) + "/median",
               sample_of(level, level.place, static_cast<std::int64_t>(c)), 0.5,
               {"m", blocks_of(level), at(role, 0.5).sizes(classes_[c], classes_[c])});
      }
    }
    std::vector<double> upright(at_a_.speed);
    for (double& v : upright) v = std::abs(v);
    sink.figure("at_a/crossings", static_cast<double>(at_a_.place.size()), "1",
                sdk::Quantity::number);
    figure(sink, "at_a/median_vertical_speed", sample_of(at_a_, upright, -1), 0.5,
           {"m/s", blocks_of(at_a_), sdk::detail(sdk::Quantity::velocity)});
  }

  void report(sdk::ReportSink& sink) const override {
    for (const auto& [p, quantile] : k_quantiles) {
      std::vector<double> places;
      std::vector<double> depth;
      for (std::size_t d = 0; d < levels_.size(); ++d) {
        if (levels_[d].place.empty()) continue;
        places.push_back(formula::quantile(sample_of(levels_[d], levels_[d].place, -1), p));
        depth.push_back(-p_.drops[d]);
      }
      sink.curve("Trajectory of the stream", "distance from A [m]", "height above A [m]", quantile,
                 places, depth);
    }
    const std::vector<std::string> columns = {"drop [m]", "5 % [m]", "median [m]", "95 % [m]",
                                              "crossings"};
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      const formula::SortedSample sample = sample_of(levels_[d], levels_[d].place, -1);
      const double values[] = {p_.drops[d], formula::quantile(sample, 0.05),
                               formula::quantile(sample, 0.5), formula::quantile(sample, 0.95),
                               static_cast<double>(sample.value.size())};
      sink.row("Stream below A", columns, values);
    }
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("classes", classes_);
    at_a_.save(a, "at_a");
    for (std::size_t d = 0; d < levels_.size(); ++d) levels_[d].save(a, level_name(d));
  }
  void load(sdk::ArchiveReader& a) override {
    classes_ = a.numbers("classes");
    at_a_.load(a, "at_a");
    for (std::size_t d = 0; d < levels_.size(); ++d) levels_[d].load(a, level_name(d));
  }

 private:
  static constexpr std::size_t k_blocks = 20;
  static constexpr std::pair<double, const char*> k_quantiles[] = {
      {0.05, "quantile_5"}, {0.5, "median"}, {0.95, "quantile_95"}};

  /// Of length 1.
  struct Axes {
    sdk::Vec3 along, down;
  };
  /// A way as seen from A.
  struct Seen {
    double place_before, place_now;  ///< [m] along the belt
    double depth_before, depth_now;  ///< [m] along gravity
  };
  [[nodiscard]] Seen seen(const sdk::Path& way, const Axes& axes) const {
    const sdk::Vec3 before = way.before - p_.from;
    const sdk::Vec3 now = way.now - p_.from;
    return {dot(before, axes.along), dot(now, axes.along), dot(before, axes.down),
            dot(now, axes.down)};
  }
  /// Whether a way of grain `i` is in the domain there: levels have no ends, and where it has gone
  /// through a periodic side its place is that of the image within.
  static bool is_within(const sdk::WorldView& world, std::size_t i, sdk::Vec3 there) {
    constexpr double k_rounding = 1e-12;
    const sdk::Vec3 back = sdk::place_before(world, i) - sdk::path_of(world, i).before;
    for (int d = 0; d < 3; ++d) {
      if (back[d] == 0.0) continue;
      const double tolerance = k_rounding * std::abs(back[d]);
      if (there[d] < world.domain_min[d] - tolerance) return false;
      if (there[d] > world.domain_max[d] + tolerance) return false;
    }
    return true;
  }

  void add_grain(const sdk::WorldView& world, std::size_t i, const Axes& axes) {
    const sdk::GrainColumns& g = world.grains;
    const std::size_t c = sdk::nearest_class(g.diameter[i], classes_);
    const sdk::Vec3 velocity{g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]};
    sdk::any_way(world, i, [&](const sdk::Path& way) {
      const Seen w = seen(way, axes);
      const sdk::Passage p = sdk::passage(w.place_before, w.place_now);
      if (p.direction <= 0 || w.depth_now > 0.0) return false;
      if (!is_within(world, i, way.at(p.fraction))) return false;
      at_a_.add(w.depth_now, dot(velocity, axes.down), g.weight[i], c);
      return true;
    });
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      sdk::any_way(world, i, [&](const sdk::Path& way) {
        const Seen w = seen(way, axes);
        const sdk::Passage p =
            sdk::passage(w.depth_before - p_.drops[d], w.depth_now - p_.drops[d]);
        if (p.direction <= 0 || !is_within(world, i, way.at(p.fraction))) return false;
        // Speed where the level is met: back along the acceleration at the end of the interval.
        const sdk::Vec3 force{g.force_x[i], g.force_y[i], g.force_z[i]};
        const double since = (1.0 - p.fraction) * world.interval;
        const double speed = dot(velocity - (since / g.mass[i]) * force, axes.down);
        levels_[d].add(w.place_before + p.fraction * (w.place_now - w.place_before), speed,
                       g.weight[i], c);
        return true;
      });
    }
  }

  [[nodiscard]] std::string drop_name(std::size_t d) const {
    return "drop_" + sdk::name_of(p_.drops[d] * 1e3) + "_mm";
  }
  static std::string level_name(std::size_t d) { return "level_" + std::to_string(d); }

  /// Blocks of equal numbers of samples taken, hence of equal time.
  static std::size_t blocks_of(const Crossings& level) {
    return std::min(k_blocks, level.until.size());
  }

  /// `values` of one size class, or of all for `size_class` -1.
  static formula::SortedSample sample_of(const Crossings& level, std::span<const double> values,
                                         std::int64_t size_class) {
    std::vector<double> chosen;
    std::vector<double> weights;
    std::vector<std::size_t> blocks;
    const std::size_t samples = level.until.size();
    std::size_t i = 0;
    for (std::size_t s = 0; s < samples; ++s) {
      const std::size_t block = s * blocks_of(level) / samples;
      for (; i < static_cast<std::size_t>(level.until[s]); ++i) {
        if (size_class >= 0 && level.size_class[i] != size_class) continue;
        chosen.push_back(values[i]);
        weights.push_back(level.weight[i]);
        blocks.push_back(block);
      }
    }
    return formula::sorted(chosen, weights, blocks);
  }

  /// What a quantile is, beside its name.
  struct QuantileKind {
    const char* unit;
    std::size_t blocks;
    sdk::FigureRole role;
  };
  static void figure(sdk::FigureSink& sink, const std::string& name,
                     const formula::SortedSample& sample, double p, const QuantileKind& kind) {
    const double value = formula::quantile(sample, p);
    const double error = formula::quantile_error(sample, p, kind.blocks);
    sink.figure(name, value, kind.unit, sdk::error_beside(value, error), kind.role);
  }
  static sdk::FigureRole at(sdk::FigureRole role, double probability) {
    role.probability = probability;
    return role;
  }

  Parameters p_;
  std::vector<double> classes_;
  std::vector<Crossings> levels_;
  Crossings at_a_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Trajectory>(); }
