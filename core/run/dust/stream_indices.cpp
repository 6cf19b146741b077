// SPDX-License-Identifier: Apache-2.0
#include "run/dust/stream_indices.hpp"

#include "run/dust/dust_rates.hpp"

#include <algorithm>
#include <cmath>

namespace dust::run {
namespace {

constexpr double k_tonne = 1e3;  // kg
/// A cell holds grains of the stream from this solids fraction on: below it, dust and stray grains.
constexpr double k_min_solids = 1e-3;
/// Of the mean feed: where less goes down, it is not the stream.
constexpr double k_feed_share = 0.5;

}  // namespace

StreamIndices::StreamIndices(const scenario::Setup& setup, const FluidStage& fluid,
                             const DustStage& dust, const LiberationStage* liberation,
                             particles::Dem& particles, double steady_after)
    : fluid_(fluid),
      dust_(dust),
      liberation_(liberation),
      particles_(particles),
      steady_(steady_after),
      first_level_(k_power + (liberation != nullptr ? liberation->impact_causes() : 0)) {
  for (int d = 0; d < 3; ++d) {
    if (std::abs(setup.gravity[d]) > std::abs(setup.gravity[axis_])) axis_ = d;
  }
  down_ = setup.gravity[axis_] > 0.0 ? 1.0 : -1.0;
  // Where the fluid does not feel the grains it is not drawn along by them, nor is there a void
  // fraction.
  if (setup.gravity[axis_] != 0.0 && !setup.fluid->is_one_way) {
    levels_ = static_cast<std::size_t>(fluid.grid().count[static_cast<std::size_t>(axis_)]);
  }
  now_.assign(first_level_ + k_columns * levels_, 0.0);
  means_ = sdk::BatchMeans(now_.size());
}

/// In the order of rows, so that sums are the same on any threads.
void StreamIndices::find_grains() {
  const fluid::Grid& grid = fluid_.grid();
  const particles::GrainRows grains = particles_.rows();
  const double layer = grid.spacing[axis_];
  for (std::size_t row = 0; row < grains.count; ++row) {
    const sdk::Vec3 x = grid.inside(grains.centre(row));
    const double speed = down_ * grains.velocity_of(row)[axis_];
    const double level = std::floor((x[axis_] - grid.origin[axis_]) / layer);
    if (!(speed > 0.0) || !(level >= 0.0 && level < static_cast<double>(levels_))) continue;
    const double flow = grains.weight[row] / grains.inverse_mass(row) * speed / layer;
    const auto n = static_cast<std::size_t>(level);
    now_[column(n, mass_flow)] += flow;
    now_[column(n, solids_flow)] += flow * (1.0 - dust_.void_fraction_at(x));
  }
}

void StreamIndices::find_air() {
  const fluid::Grid& grid = fluid_.grid();
  const fluid::CellField& eps = fluid_.void_fraction();
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const auto cell = static_cast<std::int32_t>(grid.index(i, j, k));
        if (1.0 - eps[static_cast<std::size_t>(cell)] < k_min_solids) continue;
        const double speed = down_ * dust_.gas_velocity(cell)[axis_];
        if (!(speed > 0.0)) continue;
        const int place[3] = {i, j, k};
        now_[column(static_cast<std::size_t>(place[axis_]), air_flow)] +=
            speed * dust_.gas_volume(cell) / grid.spacing[axis_];
      }
    }
  }
}

void StreamIndices::begin_at(double time) {
  steady_ = SteadyWindow(time);
  means_ = sdk::BatchMeans(now_.size());
}

void StreamIndices::sample(double time, double step) {
  const double fed = particles_.balance().mass_emitted;
  const std::optional<double> before = fed_;
  fed_ = fed;
  if (!before || !steady_.holds(time - step, step)) return;
  std::fill(now_.begin(), now_.end(), 0.0);
  now_[k_load] = (fed - *before) / step;
  for (std::size_t n = k_power; n < first_level_; ++n) {
    now_[n] = liberation_->impact_energy(n - k_power) / step;
  }
  if (levels_ > 0) {
    find_grains();
    find_air();
  }
  means_.add(now_, step);
}

double StreamIndices::height(std::size_t level) const {
  const fluid::Grid& grid = fluid_.grid();
  return grid.origin[axis_] + (static_cast<double>(level) + 0.5) * grid.spacing[axis_];
}

double StreamIndices::void_fraction(std::size_t level) const {
  return 1.0 - means_.mean(column(level, solids_flow)) / means_.mean(column(level, mass_flow));
}

double StreamIndices::power() const {
  double sum = 0.0;
  for (std::size_t n = k_power; n < first_level_; ++n) sum += means_.mean(n);
  return sum;
}

/// Of `value`, a function of the power of all causes together and of the load, from its derivatives
/// by them.
double StreamIndices::error_of_power(double by_power, double by_load, double value) const {
  std::vector<double> partials(means_.columns(), 0.0);
  std::fill(partials.begin() + k_power,
            partials.begin() + static_cast<std::ptrdiff_t>(first_level_), by_power);
  partials[k_load] = by_load;
  return means_.error_of_function(partials, value);
}

void StreamIndices::report_impacts(sdk::FigureSink& sink) const {
  // `of_ratio`: that of the power over the load.
  const auto figures = [&](const std::string& name, double power, double error, double of_ratio) {
    sink.figure("impact/" + name + "/power", power, "W", error, sdk::detail(sdk::Quantity::power));
    if (!(load() > 0.0)) return;
    const bool is_even = means_.is_even(k_load);
    sink.figure("impact/" + name + "/per_load", is_even ? power / load() : k_unknown, "J/kg",
                is_even ? of_ratio : sdk::k_feed_not_even, sdk::FigureRole{});
  };
  if (first_level_ > k_power) {
    const double whole = power();
    const double error = error_of_power(1.0, 0.0, whole);
    double of_ratio = error;
    // As of any ratio: where the power has no error, that over the load has none either.
    if (error >= 0.0 && load() > 0.0) {
      const double per_load = whole / load();
      of_ratio = error_of_power(1.0 / load(), -per_load / load(), per_load);
    }
    figures("all", whole, error, of_ratio);
  }
  for (std::size_t n = k_power; n < first_level_; ++n) {
    if (means_.mean(n) > 0.0) {
      figures(liberation_->causes()[n - k_power], means_.mean(n), means_.error(n),
              means_.ratio_error(n, k_load));
    }
  }
}

void StreamIndices::report_levels(sdk::FigureSink& sink) const {
  std::vector<std::size_t> passed;
  for (std::size_t n = 0; n < levels_; ++n) {
    if (load() > 0.0 && means_.mean(column(n, mass_flow)) >= k_feed_share * load()) {
      passed.push_back(n);
    }
  }
  if (passed.empty()) return;
  const auto air = [&](std::size_t n) { return means_.mean(column(n, air_flow)); };
  const std::size_t most = *std::max_element(
      passed.begin(), passed.end(), [&](std::size_t a, std::size_t b) { return air(a) < air(b); });
  const double error = means_.error(column(most, air_flow));
  const bool is_even = means_.is_even(k_load);
  sink.figure("entrained_air/flow", air(most), "m3/s", error,
              sdk::detail(sdk::Quantity::volume_rate));
  sink.figure("entrained_air/per_load", is_even ? k_tonne / load() * air(most) : k_unknown, "m3/t",
              is_even
                  ? sdk::scaled_error(means_.ratio_error(column(most, air_flow), k_load), k_tonne)
                  : sdk::k_feed_not_even,
              sdk::FigureRole{});
  sink.figure("entrained_air/height", height(most), "m", sdk::k_no_estimate,
              sdk::detail(sdk::Quantity::length));
  const auto [dense, loose] = std::minmax_element(
      passed.begin(), passed.end(),
      [&](std::size_t a, std::size_t b) { return void_fraction(a) < void_fraction(b); });
  // Ratios of two means: no error.
  const auto ratio = [&](const char* name, double value) {
    sink.figure(std::string("looseness/") + name, value, "1", sdk::k_no_estimate,
                sdk::FigureRole{});
  };
  ratio("void_fraction", void_fraction(*loose));
  ratio("densest_void_fraction", void_fraction(*dense));
  if (void_fraction(*loose) < 1.0) {
    ratio("expansion", (1.0 - void_fraction(*dense)) / (1.0 - void_fraction(*loose)));
  }
  sink.figure("looseness/height", height(*loose), "m", sdk::k_no_estimate,
              sdk::detail(sdk::Quantity::length));
}

void StreamIndices::report(sdk::FigureSink& sink) const {
  sink.figure("observed", means_.duration(), "s", sdk::k_no_estimate,
              {.role = sdk::Role::observed_time, .quantity = sdk::Quantity::time});
  if (!(means_.duration() > 0.0)) return;
  report_impacts(sink);
  report_levels(sink);
}

void StreamIndices::add_parts(SaveParts& parts) const {
  parts.emplace_back("stream_indices", [this](sdk::ArchiveWriter& a) {
    // As in DustRates.
    const double numbers[] = {fed_.value_or(-1.0), steady_.begin()};
    a.numbers("fed", numbers);
    means_.save(a, "means");
  });
}

void StreamIndices::add_parts(LoadParts& parts) {
  parts.emplace_back("stream_indices", [this](sdk::ArchiveReader& a) {
    const std::vector<double> numbers = a.numbers("fed");
    const double fed = numbers.at(0);
    if (numbers.size() > 1) steady_ = SteadyWindow(numbers[1]);
    fed_ = fed < 0.0 ? std::nullopt : std::optional<double>(fed);
    means_.load(a, "means");
    if (means_.columns() != now_.size()) {
      throw sdk::ModelError("the saved indices of the stream do not fit together");
    }
  });
}

}  // namespace dust::run
