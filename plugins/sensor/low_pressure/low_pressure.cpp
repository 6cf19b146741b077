// SPDX-License-Identifier: Apache-2.0
#include "low_pressure.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <cfloat>
#include <limits>

namespace {

namespace formula = dust::model::low_pressure;
namespace sdk = dust::sdk;

constexpr double k_far = std::numeric_limits<double>::infinity();

/// Cells with less room than this are taken for solid.
constexpr float k_min_open = 0.5f;

/// What the means are taken of, per cell.
struct Air {
  const float* pressure;       ///< [Pa]
  const float* open_fraction;  ///< [-]
  const float* void_fraction;  ///< [-]
};

/// Adds pressure * duration to `sum` [Pa s] and the fraction of each cell that is not air, body or
/// solids, times duration to `not_air` [s]; returns the lowest pressure of the open cells.
DUST_KERNEL float accumulate(std::size_t n, const Air& air, double duration, double* __restrict sum,
                             double* __restrict not_air) {
  const float* __restrict pressure = air.pressure;
  const float* __restrict open_fraction = air.open_fraction;
  const float* __restrict void_fraction = air.void_fraction;
  float lowest = FLT_MAX;
#pragma omp simd reduction(min : lowest)
  for (std::size_t i = 0; i < n; ++i) {
    sum[i] += duration * static_cast<double>(pressure[i]);
    not_air[i] += duration * static_cast<double>(1.0f - open_fraction[i] * void_fraction[i]);
    const float p = open_fraction[i] >= k_min_open ? pressure[i] : FLT_MAX;
    lowest = p < lowest ? p : lowest;
  }
  return lowest;
}

/// Adds the mean of a finished block and its square to the totals and clears the block.
DUST_KERNEL void close_block(std::size_t n, double duration, double* __restrict block,
                             double* __restrict total, double* __restrict squares) {
  const double per_time = 1.0 / duration;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double mean = block[i] * per_time;
    total[i] += mean;
    squares[i] += mean * mean;
    block[i] = 0.0;
  }
}

class LowPressure final : public sdk::Sensor {
 public:
  struct Parameters {
    std::int64_t count = 5;
    double averaging_after = 0.0;
    sdk::Vec3 average_along;
    double separation = 0.01;
    double block = 0.02;
    double clearance = 0.01;
    double largest_solids_fraction = 1e-3;
    sdk::Vec3 min = {-k_far, -k_far, -k_far};
    sdk::Vec3 max = {k_far, k_far, k_far};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.integer(&Parameters::count, "count", "How many places are reported.")
        .at_least(1)
        .at_most(100)
        .optional();
    s.number(&Parameters::averaging_after, "averaging_after", sdk::dimension::time,
             "Time from which the pressure is averaged.")
        .at_least(0)
        .optional();
    s.vector(&Parameters::average_along, "average_along", sdk::dimension::none,
             "An axis along which the mean pressure is averaged as well, for flows that are level "
             "in it; [0, 0, 0] = none.")
        .optional();
    s.number(&Parameters::separation, "separation", sdk::dimension::length,
             "Least distance between two places.")
        .at_least(0)
        .optional();
    s.number(&Parameters::block, "block", sdk::dimension::time,
             "Length of the time blocks from whose means the error is taken.")
        .above(0)
        .optional();
    s.number(&Parameters::clearance, "clearance", sdk::dimension::length,
             "Least distance of a place from bodies and from the stream, along each axis; at least "
             "one cell where it is above 0.")
        .at_least(0)
        .optional();
    s.number(&Parameters::largest_solids_fraction, "largest_solids_fraction", sdk::dimension::none,
             "A cell with a larger mean solids fraction belongs to the stream and is no place.")
        .above(0)
        .at_most(1)
        .optional();
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the box in which places are looked for.")
        .optional();
    s.vector(&Parameters::max, "max", sdk::dimension::length,
             "Upper corner of the box in which places are looked for.")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "low_pressure",
        .version = "1.1",
        .summary = "The places of lowest mean pressure: where dust gathers and may be extracted.",
        .equation =
            R"(\bar p(\mathbf{x}) = \frac{1}{T}\int p\,dt,\quad \mathrm{local\ minima} < 0)",
        .source = "own definition"};
  }

  explicit LowPressure(const Parameters& p) : p_(p) {
    int axes = 0;
    for (int d = 0; d < 3; ++d) {
      if (p.average_along[d] == 0.0) continue;
      ++axes;
      direction_ = d;
    }
    if (axes > 1)
      throw sdk::ParameterError("'average_along' must lie along one axis, e.g. [0, 1, 0]");
    for (int d = 0; d < 3; ++d) {
      if (p.max[d] > p.min[d]) continue;
      throw sdk::ParameterError("'max' must lie above 'min' along each axis");
    }
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    const sdk::FluidColumns& f = world.fluid;
    if (f.pressure.empty()) return;
    if (block_.size() != f.pressure.size()) start(f);
    const bool is_averaging = sdk::is_after(world, p_.averaging_after);
    const double duration = is_averaging ? world.interval : 0.0;
    note_open(f);
    const float lowest = accumulate(
        f.pressure.size(), {f.pressure.data(), f.open_fraction.data(), f.void_fraction.data()},
        duration, block_.data(), not_air_.data());
    averaged_ += duration;
    lowest_ = lowest == FLT_MAX ? 0.0 : static_cast<double>(lowest);
    curve_.add(world.time, lowest_);
    if (!is_averaging) return;
    block_duration_ += world.interval;
    // Half a sample of slack: sums of intervals must not decide by their rounding.
    if (block_duration_ + 0.5 * world.interval < p_.block) return;
    close_block(block_.size(), block_duration_, block_.data(), total_.data(), squares_.data());
    ++blocks_;
    block_duration_ = 0.0;
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("lowest_pressure", lowest_, "Pa", sdk::Quantity::pressure);
  }

  void summary(sdk::FigureSink& sink) const override {
    const std::vector<Place> places = find_places();
    sink.figure("found", static_cast<double>(places.size()), "1", sdk::Quantity::number);
    for (std::size_t n = 0; n < static_cast<std::size_t>(p_.count); ++n) {
      // Where there is no such place, its depth is 0 and it lies nowhere.
      constexpr sdk::Vec3 k_nowhere{sdk::k_no_value, sdk::k_no_value, sdk::k_no_value};
      const bool is_found = n < places.size();
      const Place place = is_found ? places[n] : Place{.position = k_nowhere};
      const double none = is_found ? sdk::k_no_estimate : sdk::k_nothing_passed;
      const std::string name = "place_" + std::to_string(n + 1) + "/";
      const sdk::FigureRole role{.role = sdk::Role::low_pressure, .index = static_cast<int>(n) + 1};
      sink.figure(name + "x", place.position.x, "m", none, role.of(sdk::Quantity::x));
      sink.figure(name + "y", place.position.y, "m", none, role.of(sdk::Quantity::y));
      sink.figure(name + "z", place.position.z, "m", none, role.of(sdk::Quantity::z));
      sink.figure(name + "depth", -place.pressure, "Pa", place.error,
                  role.of(sdk::Quantity::depth_of_pressure));
      sink.figure(name + "pressure_over_density", density_ > 0.0 ? place.pressure / density_ : 0.0,
                  "m2/s2", place.error < 0.0 || density_ <= 0.0 ? -1.0 : place.error / density_,
                  role.of(sdk::Quantity::kinematic_pressure));
    }
  }

  void report(sdk::ReportSink& sink) const override {
    sink.curve("Lowest pressure", "time [s]", "pressure [Pa]", "open cells", curve_.x(),
               curve_.y());
    const std::vector<std::string> columns = {"x [m]", "y [m]", "z [m]", "depth [Pa]",
                                              "standard error [Pa]"};
    for (const Place& place : find_places()) {
      const double values[] = {place.position.x, place.position.y, place.position.z,
                               -place.pressure, place.error < 0.0 ? sdk::k_no_value : place.error};
      sink.row("Places of low pressure", columns, values);
    }
  }

  void save(sdk::ArchiveWriter& a) const override {
    const sdk::Vec3 o = grid_.origin;
    const sdk::Vec3 h = grid_.spacing;
    const double numbers[] = {o.x,     o.y,      o.z, h.x, h.y, h.z, density_, block_duration_,
                              lowest_, averaged_};
    const std::int64_t integers[] = {grid_.cells.count[0], grid_.cells.count[1],
                                     grid_.cells.count[2], blocks_};
    a.numbers("numbers", numbers);
    a.integers("integers", integers);
    a.numbers("block", block_);
    a.numbers("total", total_);
    a.numbers("squares", squares_);
    a.numbers("not_air", not_air_);
    const std::vector<std::int64_t> open(is_open_.begin(), is_open_.end());
    a.integers("is_open", open);
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    const std::vector<double> numbers = a.numbers("numbers");
    const std::vector<std::int64_t> integers = a.integers("integers");
    grid_.origin = {numbers.at(0), numbers.at(1), numbers.at(2)};
    grid_.spacing = {numbers.at(3), numbers.at(4), numbers.at(5)};
    density_ = numbers.at(6);
    block_duration_ = numbers.at(7);
    lowest_ = numbers.at(8);
    averaged_ = numbers.at(9);
    for (int d = 0; d < 3; ++d) grid_.cells.count[d] = static_cast<int>(integers.at(d));
    blocks_ = integers.at(3);
    block_ = a.numbers("block");
    total_ = a.numbers("total");
    squares_ = a.numbers("squares");
    not_air_ = a.numbers("not_air");
    const std::vector<std::int64_t> open = a.integers("is_open");
    is_open_.assign(open.begin(), open.end());
    curve_.load(a, "curve");
  }

 private:
  struct Place {
    sdk::Vec3 position;     ///< [m]
    double pressure = 0.0;  ///< [Pa]
    double error = -1.0;    ///< [Pa]
  };

  struct Grid {
    formula::Cells cells;
    sdk::Vec3 origin;   ///< [m]
    sdk::Vec3 spacing;  ///< [m]
  };

  static constexpr std::int64_t k_min_blocks = 4;

  void start(const sdk::FluidColumns& f) {
    for (int d = 0; d < 3; ++d) grid_.cells.count[d] = f.count[d];
    grid_.origin = f.origin;
    grid_.spacing = f.spacing;
    density_ = f.density;
    block_.assign(f.pressure.size(), 0.0);
    total_ = block_;
    squares_ = block_;
    not_air_ = block_;
    is_open_.assign(block_.size(), 1);
    blocks_ = 0;
    block_duration_ = 0.0;
    averaged_ = 0.0;
  }

  /// Open is what no body takes while pressures are averaged; before, what none takes now.
  void note_open(const sdk::FluidColumns& f) {
    const bool is_first = !(averaged_ > 0.0);
    for (std::size_t i = 0; i < is_open_.size(); ++i) {
      is_open_[i] = (is_first || is_open_[i] != 0) && f.open_fraction[i] >= k_min_open ? 1 : 0;
    }
  }

  /// Cells in or near a body or the stream.
  [[nodiscard]] std::vector<char> obstructed() const {
    std::vector<char> marked(block_.size(), 0);
    const double limit = p_.largest_solids_fraction * averaged_;
    for (std::size_t i = 0; i < marked.size(); ++i) {
      marked[i] = is_open_[i] == 0 || not_air_[i] > limit;
    }
    const sdk::Vec3 h = grid_.spacing;
    return formula::grown(grid_.cells, std::move(marked),
                          formula::cells_within(p_.clearance, {h.x, h.y, h.z}));
  }

  /// Mean pressure per cell over the finished blocks; before the first one ends, over what there
  /// is.
  [[nodiscard]] std::vector<double> mean_pressure() const {
    std::vector<double> mean(block_.size(), 0.0);
    const double per_block = blocks_ > 0 ? 1.0 / static_cast<double>(blocks_) : 0.0;
    const double per_time = blocks_ == 0 && block_duration_ > 0.0 ? 1.0 / block_duration_ : 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] = per_block * total_[i] + per_time * block_[i];
    }
    return mean;
  }

  [[nodiscard]] double cell_error(std::size_t i) const {
    const auto n = static_cast<double>(blocks_);
    const double mean = total_[i] / n;
    return std::sqrt(std::max(squares_[i] / n - mean * mean, 0.0) / (n - 1.0));
  }

  /// What the minima are looked for in: the mean pressure and its error, by cell or by row.
  struct Field {
    formula::Cells cells;
    sdk::Vec3 spacing;
    std::vector<double> pressure;
    std::vector<double> error;  ///< empty below `k_min_blocks`
    std::vector<char> is_open;
    std::vector<char> is_eligible;  ///< not obstructed, and in the box
    [[nodiscard]] sdk::Vec3 centre(std::array<int, 3> cell, sdk::Vec3 origin) const {
      return {origin.x + (cell[0] + 0.5) * spacing.x, origin.y + (cell[1] + 0.5) * spacing.y,
              origin.z + (cell[2] + 0.5) * spacing.z};
    }
  };
  void choose_eligible(Field& field, const std::vector<char>& obstructed) const {
    field.is_eligible.assign(obstructed.size(), 0);
    std::size_t c = 0;
    for (int k = 0; k < field.cells.count[2]; ++k) {
      for (int j = 0; j < field.cells.count[1]; ++j) {
        for (int i = 0; i < field.cells.count[0]; ++i, ++c) {
          field.is_eligible[c] =
              obstructed[c] == 0 &&
              sdk::is_in_box(field.centre({i, j, k}, grid_.origin), p_.min, p_.max);
        }
      }
    }
  }
  [[nodiscard]] Field mean_field() const {
    Field field{grid_.cells, grid_.spacing, mean_pressure(), {}, is_open_, {}};
    if (blocks_ >= k_min_blocks) {
      field.error.resize(block_.size());
      for (std::size_t i = 0; i < block_.size(); ++i) field.error[i] = cell_error(i);
    }
    if (direction_ < 0) {
      choose_eligible(field, obstructed());
      return field;
    }
    // Cells of a row fluctuate together: the error of their mean is the mean of their errors.
    if (!field.error.empty()) {
      field.error = formula::averaged_along(grid_.cells, direction_, field.error, is_open_).mean;
    }
    auto rows = formula::averaged_along(grid_.cells, direction_, field.pressure, is_open_);
    field.pressure = std::move(rows.mean);
    field.is_open = std::move(rows.is_open);
    field.cells = formula::collapsed(grid_.cells, direction_);
    field.spacing[direction_] *= grid_.cells.count[direction_];
    choose_eligible(field, formula::any_along(grid_.cells, direction_, obstructed()));
    return field;
  }

  [[nodiscard]] std::vector<Place> find_places() const {
    if (block_.empty()) return {};
    const Field field = mean_field();
    const auto smooth = formula::smoothed(field.cells, field.pressure, field.is_open);
    std::vector<Place> places;
    for (const formula::Minimum& m :
         formula::deepest_minima(field.cells, smooth, field.is_eligible,
                                 {field.spacing.x, field.spacing.y, field.spacing.z}, p_.separation,
                                 static_cast<std::size_t>(p_.count))) {
      Place place;
      place.position = field.centre(m.cell, grid_.origin);
      place.pressure = m.value;
      if (!field.error.empty()) {
        // Neighbours fluctuate together as well.
        double sum = 0.0;
        int open = 0;
        field.cells.for_neighbourhood(m.cell[0], m.cell[1], m.cell[2], [&](std::size_t n) {
          if (field.is_open[n] == 0) return;
          sum += field.error[n];
          ++open;
        });
        place.error = sum / open;
      }
      places.push_back(place);
    }
    return places;
  }

  Parameters p_;
  int direction_ = -1;  ///< averaged along, 0 to 2; -1: none
  Grid grid_;
  double density_ = 0.0;
  std::vector<double> block_;    ///< [Pa s] integral over the open block
  std::vector<double> total_;    ///< [Pa] sum of the block means
  std::vector<double> squares_;  ///< [Pa2] sum of their squares
  std::vector<double> not_air_;  ///< [s] integral of the fraction that is not air
  std::vector<char> is_open_;
  std::int64_t blocks_ = 0;
  double block_duration_ = 0.0;  ///< [s]
  double averaged_ = 0.0;        ///< [s] that the means cover
  double lowest_ = 0.0;          ///< [Pa] at the last sample
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<LowPressure>(); }
