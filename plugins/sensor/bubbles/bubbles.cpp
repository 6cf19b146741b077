// SPDX-License-Identifier: Apache-2.0
#include "bubbles.hpp"

#include <dust/sdk/fluid_cells.hpp>
#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <array>
#include <map>
#include <numbers>

namespace {

namespace formula = dust::model::bubbles;
namespace sdk = dust::sdk;

class Bubbles final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
    double threshold = 0.7;
    sdk::Vec3 direction;
    double smallest = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length, "Lower corner of the box looked at.");
    s.vector(&Parameters::max, "max", sdk::dimension::length,
             "Upper corner; what is connected with the upper face is the space over the bed.");
    s.number(&Parameters::threshold, "threshold", sdk::dimension::none,
             "Void fraction above which a cell belongs to a bubble.")
        .symbol("\\varepsilon_b")
        .above(0)
        .below(1)
        .optional();
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Upwards, along one axis; [0, 0, 0] = against gravity.")
        .optional();
    s.number(&Parameters::smallest, "smallest", sdk::dimension::length,
             "Bubbles of a smaller diameter do not count; 0 = all.")
        .at_least(0)
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "bubbles",
            .version = "1.0",
            .summary = "Number, size and rise velocity of the connected empty regions of a bed.",
            .equation = R"(\varepsilon > \varepsilon_b,\quad d_b = (6 V_b / \pi)^{1/3})",
            .source = "own definition"};
  }

  explicit Bubbles(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (p.max[d] > p.min[d]) continue;
      throw sdk::ParameterError("'max' must lie above 'min' along each axis");
    }
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    // First: before a run there are no cells yet, but the axis is known.
    find_axis(world);
    const sdk::FluidCells cells(world.fluid);
    if (cells.is_empty()) return;
    read(world, cells);
    const std::vector<std::int64_t> region = formula::connected_regions(box_);
    std::vector<Bubble> found = gather(world, region);
    double number = 0.0;
    double volume = 0.0;
    double diameters = 0.0;
    for (const Bubble& b : found) {
      if (!counts(b)) continue;
      number += 1.0;
      volume += b.volume;
      diameters += diameter(b);
    }
    // Rise: the way of each bubble since the last sample, weighted with its volume.
    double weights = 0.0;
    double moved = 0.0;
    if (was_.size() == region.size() && world.interval > 0.0) {
      for (const auto& [now, before] : kept(region, found)) {
        weights += found[now].volume;
        moved += found[now].volume * (found[now].height - last_[before].height) / world.interval;
      }
    }
    values_ = {number, bed_volume_ > 0.0 ? volume / bed_volume_ : 0.0,
               number > 0.0 ? diameters / number : sdk::k_no_value,
               weights > 0.0 ? moved / weights : sdk::k_no_value};
    if (sdk::is_after(world, p_.steady_after)) {
      const double sums[] = {number, values_[1], diameters, weights, moved};
      means_.add(sums, world.interval);
    }
    curve_.add(world.time, values_[1]);
    was_ = region;
    last_ = std::move(found);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) {
      sink.figure(k_names[n], values_[n], k_units[n],
                  sdk::error_beside(values_[n], sdk::k_no_estimate), sdk::detail(k_quantities[n]));
    }
  }
  void summary(sdk::FigureSink& sink) const override {
    const auto mean = [&](std::size_t n) {
      const double value = means_.known_mean(n);
      const double error = value != 0.0 ? means_.error(n) : sdk::k_no_estimate;
      sink.figure(k_names[n], value, "1", sdk::error_beside(value, error),
                  n == 0 ? sdk::overview(k_quantities[n], 1) : sdk::detail(k_quantities[n]));
    };
    // Of no bubble there is neither.
    const auto ratio = [&](std::size_t column, std::size_t above, std::size_t below) {
      const double value =
          means_.mean(below) > 0.0 ? means_.mean(above) / means_.mean(below) : sdk::k_no_value;
      sink.figure(k_names[column], value, k_units[column],
                  sdk::error_beside(value, sdk::k_no_estimate), sdk::detail(k_quantities[column]));
    };
    mean(0);
    mean(1);
    ratio(2, 2, 0);
    ratio(3, 4, 3);
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Bubbles", "time [s]", "share of the box [1]", "bubbles", curve_.x(), curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    std::vector<double> last;
    for (const Bubble& b : last_) {
      last.insert(last.end(), {b.volume, b.height, b.is_over_bed ? 1.0 : 0.0});
    }
    a.numbers("values", values_);
    a.integers("regions", was_);
    a.numbers("bubbles", last);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    values_ = a.numbers("values");
    was_ = a.integers("regions");
    const std::vector<double> last = a.numbers("bubbles");
    last_.clear();
    for (std::size_t n = 0; n + 2 < last.size(); n += 3) {
      last_.push_back({last[n], last[n + 1], last[n + 2] != 0.0});
    }
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  struct Bubble {
    double volume = 0.0;       ///< [m3]
    double height = 0.0;       ///< [m] of its centre, along the axis
    bool is_over_bed = false;  ///< connected with the upper face of the box
  };

  /// Change of volume between two samples beyond which a bubble has merged or split.
  static constexpr double k_max_growth = 1.5;

  void find_axis(const sdk::WorldView& world) {
    const sdk::Vec3 up = norm(p_.direction) > 0.0 ? p_.direction : -world.gravity;
    axis_ = -1;
    for (int d = 0; d < 3; ++d) {
      if (std::abs(up[d]) > (1.0 - 1e-9) * norm(up) && norm(up) > 0.0) axis_ = d;
    }
    if (axis_ < 0) throw sdk::ModelError("bubbles needs a direction along one of the axes");
    sign_ = up[axis_] > 0.0 ? 1.0 : -1.0;
  }

  /// The part of the grid inside the box.
  void read(const sdk::WorldView& world, const sdk::FluidCells& cells) {
    const sdk::FluidColumns& f = world.fluid;
    int last[3];
    for (int d = 0; d < 3; ++d) {
      // Cells whose centre lies inside.
      first_[d] =
          std::max(0, static_cast<int>(std::ceil((p_.min[d] - f.origin[d]) / f.spacing[d] - 0.5)));
      last[d] =
          std::min(f.count[d] - 1,
                   static_cast<int>(std::ceil((p_.max[d] - f.origin[d]) / f.spacing[d] - 0.5)) - 1);
      box_.count[d] = std::max(0, last[d] - first_[d] + 1);
    }
    box_.share.clear();
    bed_volume_ = 0.0;
    const double volume = f.spacing.x * f.spacing.y * f.spacing.z;
    for (int k = first_[2]; k <= last[2]; ++k) {
      for (int j = first_[1]; j <= last[1]; ++j) {
        for (int i = first_[0]; i <= last[0]; ++i) {
          const std::size_t c = cells.index(i, j, k);
          const double excess = static_cast<double>(f.void_fraction[c]) - p_.threshold;
          box_.share.push_back(cells.is_open(c) ? excess / (1.0 - p_.threshold) : -1.0);
          if (cells.is_open(c)) bed_volume_ += volume;
        }
      }
    }
  }

  std::vector<Bubble> gather(const sdk::WorldView& world,
                             const std::vector<std::int64_t>& region) const {
    const sdk::FluidColumns& f = world.fluid;
    const double volume = f.spacing.x * f.spacing.y * f.spacing.z;
    std::int64_t regions = 0;
    for (const std::int64_t r : region) regions = std::max(regions, r);
    std::vector<Bubble> found(static_cast<std::size_t>(regions));
    std::vector<double> weights(found.size(), 0.0);
    for (std::size_t c = 0; c < region.size(); ++c) {
      if (region[c] == 0) continue;
      const auto b = static_cast<std::size_t>(region[c] - 1);
      const int at = layer(c);
      const int top = sign_ > 0.0 ? box_.count[axis_] - 1 : 0;
      found[b].is_over_bed = found[b].is_over_bed || at == top;
      found[b].volume += volume;
      // The share makes the centre move while the borders of the region rest on cells.
      const double height = f.origin[axis_] + (first_[axis_] + at + 0.5) * f.spacing[axis_];
      found[b].height += box_.share[c] * sign_ * height;
      weights[b] += box_.share[c];
    }
    for (std::size_t b = 0; b < found.size(); ++b) found[b].height /= weights[b];
    return found;
  }
  [[nodiscard]] int layer(std::size_t cell) const {
    std::size_t stride = 1;
    for (int d = 0; d < axis_; ++d) stride *= static_cast<std::size_t>(box_.count[d]);
    return static_cast<int>(cell / stride % static_cast<std::size_t>(box_.count[axis_]));
  }

  static double diameter(const Bubble& b) { return std::cbrt(6.0 * b.volume / std::numbers::pi); }
  [[nodiscard]] bool counts(const Bubble& b) const {
    return !b.is_over_bed && diameter(b) >= p_.smallest;
  }

  /// Pairs (now, before) of bubbles that are the same: each holds most of the other's cells in
  /// common, and the volume has hardly changed.
  [[nodiscard]] std::vector<std::array<std::size_t, 2>> kept(
      const std::vector<std::int64_t>& region, const std::vector<Bubble>& found) const {
    std::map<std::array<std::int64_t, 2>, std::int64_t> common;
    for (std::size_t c = 0; c < region.size(); ++c) {
      if (region[c] != 0 && was_[c] != 0) ++common[{region[c], was_[c]}];
    }
    std::map<std::int64_t, std::array<std::int64_t, 2>> best_now;
    std::map<std::int64_t, std::array<std::int64_t, 2>> best_before;
    for (const auto& [pair, cells] : common) {
      auto& now = best_now[pair[0]];
      if (cells > now[1]) now = {pair[1], cells};
      auto& before = best_before[pair[1]];
      if (cells > before[1]) before = {pair[0], cells};
    }
    std::vector<std::array<std::size_t, 2>> pairs;
    for (const auto& [now, best] : best_now) {
      if (best_before[best[0]][0] != now) continue;
      const auto a = static_cast<std::size_t>(now - 1);
      const auto b = static_cast<std::size_t>(best[0] - 1);
      if (!counts(found[a]) || !counts(last_[b])) continue;
      const double growth = found[a].volume / last_[b].volume;
      if (growth > k_max_growth || growth * k_max_growth < 1.0) continue;
      pairs.push_back({a, b});
    }
    return pairs;
  }

  static constexpr std::size_t k_columns = 4;
  static constexpr const char* k_names[k_columns] = {"number", "volume_share", "diameter",
                                                     "rise_velocity"};
  static constexpr const char* k_units[k_columns] = {"1", "1", "m", "m/s"};
  static constexpr sdk::Quantity k_quantities[k_columns] = {
      sdk::Quantity::number, sdk::Quantity::ratio, sdk::Quantity::length, sdk::Quantity::velocity};

  Parameters p_;
  int axis_ = 2;
  double sign_ = 1.0;
  int first_[3] = {0, 0, 0};
  double bed_volume_ = 0.0;  ///< [m3] open cells of the box
  formula::Cells box_;
  std::vector<std::int64_t> was_;  ///< regions at the last sample
  std::vector<Bubble> last_;
  std::vector<double> values_ = {0.0, 0.0, sdk::k_no_value, sdk::k_no_value};
  sdk::BatchMeans means_{5};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Bubbles>(); }
