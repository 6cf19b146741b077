// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/overview.hpp"
#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// What most sensors need: size classes, paths of grains between two samples, and means over time
/// with an honest error.
namespace dust::sdk {

/// When the means of a sensor begin: its `Parameters` derive from this, its schema calls
/// declare_steady.
struct SteadyParameters {
  double steady_after = 0.0;  ///< [s]
};
template <class P>
void declare_steady(SchemaOf<P>& s) {
  s.number(&P::steady_after, "steady_after", dimension::time,
           "Time from which the means are taken.")
      .at_least(0)
      .optional();
}

/// As above, for sensors that may look at some sizes of grains only.
struct SelectionParameters : SteadyParameters {
  double coarser_than = 0.0;  ///< [m]
  double finer_than = 0.0;    ///< [m] 0 = no limit

  [[nodiscard]] bool takes(double diameter) const {
    return diameter > coarser_than && (finer_than <= 0.0 || diameter < finer_than);
  }
  /// `role` of a figure of all sizes taken.
  [[nodiscard]] FigureRole sized(const FigureRole& role) const {
    return role.sizes(coarser_than, finer_than);
  }
};
template <class P>
void declare_selection(SchemaOf<P>& s) {
  declare_steady(s);
  s.number(&P::coarser_than, "coarser_than", dimension::length,
           "Only grains of a larger diameter count; 0 = all.")
      .at_least(0)
      .optional();
  s.number(&P::finer_than, "finer_than", dimension::length,
           "Only grains of a smaller diameter count; 0 = all.")
      .at_least(0)
      .optional();
}

/// Whether a point lies in a box; lower faces included, upper ones not.
inline bool is_in_box(Vec3 x, Vec3 min, Vec3 max) {
  return x.x >= min.x && x.x < max.x && x.y >= min.y && x.y < max.y && x.z >= min.z && x.z < max.z;
}

/// Index of the class nearest to `diameter` [m]; `classes` ascending [m]; 0 for an empty list.
inline std::size_t nearest_class(double diameter, std::span<const double> classes) {
  const auto above = std::lower_bound(classes.begin(), classes.end(), diameter);
  if (above == classes.begin()) return 0;
  const auto index = static_cast<std::size_t>(above - classes.begin());
  if (above == classes.end()) return index - 1;
  return diameter - classes[index - 1] <= *above - diameter ? index - 1 : index;
}

/// A number as part of a figure's name: 12.5 becomes "12_5".
inline std::string name_of(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  for (char& c : text) {
    if (c == '.' || c == '+' || c == '-') c = '_';
  }
  return text;
}

/// "class_300_um" for a diameter in m.
inline std::string class_name(double diameter) {
  return "class_" + name_of(diameter * 1e6) + "_um";
}

/// Whether the interval that a view covers lies after `start` [s], judged by its middle.
inline bool is_after(const WorldView& world, double start) {
  return world.interval > 0.0 && world.time - 0.5 * world.interval >= start;
}

/// The straight path of grain `i` between two samples.
struct Path {
  Vec3 before;  ///< [m]
  Vec3 now;     ///< [m]
  [[nodiscard]] Vec3 at(double fraction) const { return before + fraction * (now - before); }
};

/// The path of grain `i`. It ends where the grain is; through a periodic side it begins beyond the
/// other one.
inline Path path_of(const WorldView& world, std::size_t i) {
  const GrainColumns& g = world.grains;
  return {{g.x_before[i], g.y_before[i], g.z_before[i]}, {g.x[i], g.y[i], g.z[i]}};
}

/// Where grain `i` was in the domain at the last sample.
inline Vec3 place_before(const WorldView& world, std::size_t i) {
  Vec3 place = path_of(world, i).before;
  for (int d = 0; d < 3; ++d) {
    const double extent = world.domain_max[d] - world.domain_min[d];
    if (place[d] < world.domain_min[d]) place[d] += extent;
    if (place[d] > world.domain_max[d]) place[d] -= extent;
  }
  return place;
}

/// Calls `visit(path)` with the path of grain `i` and, where it has gone through periodic sides,
/// with its images: the grain has passed what is before such a side on the way as it began, what is
/// behind it on the way as it ended. Stops at the first call that returns true, so that a passage
/// counts once; false without one.
template <class Visit>
bool any_way(const WorldView& world, std::size_t i, const Visit& visit) {
  const Path path = path_of(world, i);
  if (visit(path)) return true;
  const Vec3 back = place_before(world, i) - path.before;
  if (back == Vec3{}) return false;
  // Through two or three sides at once, in any order.
  for (int sides = 1; sides < 8; ++sides) {
    Vec3 shift;
    bool is_way = true;
    for (int d = 0; d < 3; ++d) {
      if ((sides >> d & 1) == 0) continue;
      shift[d] = back[d];
      is_way = is_way && back[d] != 0.0;
    }
    if (is_way && visit(Path{path.before + shift, path.now + shift})) return true;
  }
  return false;
}

/// Passage through a level between two samples of a signed height: +1 upward, -1 downward, 0 none.
/// A height on the level counts as above it, so that no passage is counted twice.
struct Passage {
  int direction = 0;
  double fraction = 0.0;  ///< of the path, where the level is met
};
inline Passage passage(double height_before, double height_now) {
  const bool was_above = height_before >= 0.0;
  const bool is_above = height_now >= 0.0;
  if (was_above == is_above) return {};
  return {is_above ? 1 : -1, height_before / (height_before - height_now)};
}

/// Time means of several columns with standard errors from batch means: the series is cut into 16
/// to 31 batches of equal length, whose means are nearly independent when a batch is longer than
/// the memory of the flow; the error is their standard deviation over the root of their number
/// (Alexopoulos and Seila, in Banks, Handbook of Simulation, 1998, ch. 7,
/// doi:10.1002/9780470172445.ch7). Memory does not grow: full storage merges neighbouring batches.
///
/// Where neighbouring batches still remember each other (lag-1 correlation \f$ r > 0 \f$ of the
/// batch means), the \f$ n \f$ batches count as \f$ n_e = n (1-r)/(1+r) \f$ independent ones, as
/// in a first-order autoregression (Bayley and Hammersley 1946, doi:10.2307/2983560), with
/// \f$ r \f$ freed of the bias \f$ -(1+3r)/n \f$ of short series (Marriott and Pope 1954,
/// doi:10.2307/2332719). The error is then wide enough that 1.96 of it hold 95 % by Student's t.
/// There is no level below which \f$ r \f$ would be taken for chance: a trace of memory that
/// the batches cannot tell from none makes the error up to a fifth too small; asking always makes
/// it a tenth too large in the mean where there is none. With fewer than 3 independent batches the
/// mean has not settled: there is no error but `k_not_steady`, unless the batches scatter by less
/// than 1 % of the mean, which then is the error. Limits: a run shorter than the memory of the flow
/// may look steady and even; below 8 samples there is no error.
class BatchMeans {
 public:
  explicit BatchMeans(std::size_t columns = 0) : columns_(columns), open_(columns, 0.0) {}
  [[nodiscard]] std::size_t columns() const { return columns_; }
  /// More columns, which were 0 until now.
  void widen(std::size_t columns) {
    std::vector<double> wider(columns * durations_.size(), 0.0);
    for (std::size_t b = 0; b < durations_.size(); ++b) {
      std::copy_n(closed_.begin() + static_cast<std::ptrdiff_t>(b * columns_), columns_,
                  wider.begin() + static_cast<std::ptrdiff_t>(b * columns));
    }
    closed_ = std::move(wider);
    open_.resize(columns, 0.0);
    columns_ = columns;
  }

  /// One sample: `values` held for `duration` [s].
  void add(std::span<const double> values, double duration) {
    for (std::size_t c = 0; c < columns_; ++c) open_[c] += values[c] * duration;
    open_duration_ += duration;
    if (++open_samples_ < samples_per_batch_) return;
    closed_.insert(closed_.end(), open_.begin(), open_.end());
    durations_.push_back(open_duration_);
    clear_open();
    if (durations_.size() == k_max_batches) merge();
  }

  /// [s] observed.
  [[nodiscard]] double duration() const {
    double sum = open_duration_;
    for (const double d : durations_) sum += d;
    return sum;
  }
  /// Time mean of a column; 0 without samples.
  [[nodiscard]] double mean(std::size_t column) const {
    double sum = open_[column];
    for (std::size_t b = 0; b < durations_.size(); ++b) sum += closed_[b * columns_ + column];
    const double time = duration();
    return time > 0.0 ? sum / time : 0.0;
  }
  /// The same; no number (NaN, null in summary.json) without samples. For figures of which there is
  /// a sample in every step: what has not been observed is not known to be 0.
  [[nodiscard]] double known_mean(std::size_t column) const {
    return duration() > 0.0 ? mean(column) : std::numeric_limits<double>::quiet_NaN();
  }
  /// Standard error of the mean; k_no_estimate below 8 batches, k_not_steady where the batches
  /// remember each other too long. `most_independent`: how many independent stretches the time can
  /// hold at most, where more is known of the memory than the batches tell.
  [[nodiscard]] double error(
      std::size_t column, double most_independent = std::numeric_limits<double>::infinity()) const {
    return error_of([&](std::size_t b) { return batch_mean(b, column); }, mean(column),
                    mean(column), most_independent);
  }
  /// Standard error of mean(top) / mean(base), in the unit of that ratio \f$ R \f$: that of the
  /// mean of the residuals \f$ x_{top} - R\, x_{base} \f$ over mean(base) (Cochran 1977, Sampling
  /// Techniques, eq. 6.13). What both have in common is no error of their ratio. The reasons why
  /// there is none are those of error(); k_no_estimate where mean(base) is 0.
  ///
  /// Where mean(top) has no error, its ratio has none either, and for the same reason. The
  /// residuals of a feed that comes in lumps scatter so much that the memory of the top is lost in
  /// them: a mean that has not settled would look settled once it is divided.
  [[nodiscard]] double ratio_error(std::size_t top, std::size_t base) const {
    const double of_top = error(top);
    if (of_top < 0.0) return of_top;
    const double below = mean(base);
    if (below == 0.0) return k_no_estimate;
    const double ratio = mean(top) / below;
    const double of_residuals =
        error_of([&](std::size_t b) { return batch_mean(b, top) - ratio * batch_mean(b, base); },
                 0.0, mean(top), std::numeric_limits<double>::infinity());
    return of_residuals < 0.0 ? of_residuals : of_residuals / std::abs(below);
  }
  /// Standard error of a function of several means, in its unit, to first order: that of the mean
  /// of \f$ \sum_c g_c x_c \f$ with `partials` its derivatives \f$ g_c \f$ by the means, as many
  /// as there are columns; `value` is the function's. What columns have in common cancels as far as
  /// the function lets it. The reasons why there is none are those of error().
  [[nodiscard]] double error_of_function(std::span<const double> partials, double value) const {
    const auto sum_of = [&](const auto& column_value) {
      double sum = 0.0;
      for (std::size_t c = 0; c < columns_; ++c) sum += partials[c] * column_value(c);
      return sum;
    };
    return error_of(
        [&](std::size_t b) { return sum_of([&](std::size_t c) { return batch_mean(b, c); }); },
        sum_of([&](std::size_t c) { return mean(c); }), value,
        std::numeric_limits<double>::infinity());
  }
  /// Whether a column that counts something grows evenly: its sum, batch by batch, is nowhere
  /// farther from the straight line than a tenth of the whole, and it has not stopped or not begun
  /// for more batches at an end than anywhere between. False without samples.
  [[nodiscard]] bool is_even(std::size_t column) const {
    double whole = open_[column];
    for (std::size_t b = 0; b < durations_.size(); ++b) whole += closed_[b * columns_ + column];
    const double time = duration();
    if (whole == 0.0 || !(time > 0.0)) return false;
    double sum = 0.0, begin = 0.0;
    std::size_t gap = 0, longest = 0, first = 0;
    bool has_begun = false;
    for (std::size_t b = 0; b < durations_.size(); ++b) {
      const double amount = closed_[b * columns_ + column];
      sum += amount;
      begin += durations_[b];
      if (std::abs(sum / whole - begin / time) > k_uneven) return false;
      if (amount == 0.0) {
        ++gap;
        continue;
      }
      (has_begun ? longest : first) = std::max(has_begun ? longest : first, gap);
      has_begun = true;
      gap = 0;
    }
    // What the open batch counts ends the last gap as well.
    const std::size_t last = open_[column] == 0.0 ? gap : 0;
    return std::max(first, last) <= longest + 1;
  }
  /// Whether a column that counts something counted nothing of late: in the last batch and since.
  [[nodiscard]] bool has_ended(std::size_t column) const {
    return !durations_.empty() && closed_[(durations_.size() - 1) * columns_ + column] == 0.0 &&
           open_[column] == 0.0;
  }
  /// Whether means cannot be told per amount of a column that counts what is fed: the feed begins,
  /// ends or changes while they are taken. A batch is no feed: all of it has come since the means
  /// began, and no more of it comes. What was fed before the means began, and none while they are
  /// taken, is a feed that has ended. `before`: what had been fed by then, in the column's unit.
  [[nodiscard]] bool is_uneven(std::size_t column, double before) const {
    if (mean(column) == 0.0) return before > 0.0 && duration() > 0.0;
    if (is_even(column)) return false;
    return before > 0.0 || !has_ended(column);
  }
  /// How far a single batch lies from the mean of all, one standard deviation; k_no_estimate below
  /// 8 batches.
  [[nodiscard]] double deviation(std::size_t column) const {
    const std::size_t batches = durations_.size();
    if (batches < k_min_batches) return k_no_estimate;
    return deviation_of(spread_of([&](std::size_t b) { return batch_mean(b, column); }));
  }

  void save(ArchiveWriter& archive, const std::string& name) const {
    const double numbers[] = {open_duration_};
    const std::int64_t integers[] = {static_cast<std::int64_t>(columns_), samples_per_batch_,
                                     open_samples_};
    archive.numbers(name + "_closed", closed_);
    archive.numbers(name + "_durations", durations_);
    archive.numbers(name + "_open", open_);
    archive.numbers(name + "_open_duration", numbers);
    archive.integers(name + "_counts", integers);
  }
  void load(ArchiveReader& archive, const std::string& name) {
    closed_ = archive.numbers(name + "_closed");
    durations_ = archive.numbers(name + "_durations");
    open_ = archive.numbers(name + "_open");
    open_duration_ = archive.number(name + "_open_duration");
    const std::vector<std::int64_t> counts = archive.integers(name + "_counts");
    columns_ = static_cast<std::size_t>(counts.at(0));
    samples_per_batch_ = counts.at(1);
    open_samples_ = counts.at(2);
    if (open_.size() != columns_ || closed_.size() != columns_ * durations_.size()) {
      throw ModelError("the saved means '" + name + "' do not fit together");
    }
  }

 private:
  static constexpr std::size_t k_max_batches = 32;
  static constexpr std::size_t k_min_batches = 8;
  static constexpr double k_max_memory = 0.97;      ///< 32 batches cannot tell more
  static constexpr double k_min_independent = 3.0;  ///< batches
  static constexpr double k_small_drift = 0.01;     ///< of the mean: what batches scatter by then
  static constexpr double k_uneven = 0.1;           ///< of the whole, off an even growth

  /// Sum of the squares of the batches' deviations, and the lag-1 correlation of them.
  struct Spread {
    double squares = 0.0;
    double correlation = 0.0;
  };
  /// `value`: of a batch, by its number.
  template <class Value>
  [[nodiscard]] Spread spread_of(const Value& value) const {
    const std::size_t n = durations_.size();
    double mean_of_batches = 0.0;
    for (std::size_t b = 0; b < n; ++b) mean_of_batches += value(b) / static_cast<double>(n);
    Spread spread;
    double products = 0.0;
    double last = 0.0;
    for (std::size_t b = 0; b < n; ++b) {
      const double deviation = value(b) - mean_of_batches;
      spread.squares += deviation * deviation;
      products += deviation * last;
      last = deviation;
    }
    if (spread.squares > 0.0) spread.correlation = products / spread.squares;
    return spread;
  }
  [[nodiscard]] double deviation_of(const Spread& spread) const {
    return std::sqrt(spread.squares / (static_cast<double>(durations_.size()) - 1.0));
  }
  /// See error(); `expected` is the mean of the value over all, a drift is small against `size`.
  template <class Value>
  [[nodiscard]] double error_of(const Value& value, double expected, double size,
                                double most_independent) const {
    const std::size_t batches = durations_.size();
    if (batches < k_min_batches) return k_no_estimate;
    const auto n = static_cast<double>(batches);
    const Spread spread = spread_of(value);
    // Batches that all say the same, and then something came: nobody knows how often it does.
    constexpr double k_rounding = 1e-9;
    if (spread.squares == 0.0 && std::abs(value(0) - expected) > k_rounding * std::abs(size)) {
      return k_not_steady;
    }
    const double variance = spread.squares / (n * (n - 1.0));
    double independent = n;
    const double memory =
        std::min(spread.correlation + (1.0 + 3.0 * spread.correlation) / n, k_max_memory);
    if (memory > 0.0) independent *= (1.0 - memory) / (1.0 + memory);
    independent = std::min(independent, most_independent);
    if (independent >= n) return std::sqrt(variance);
    if (independent < k_min_independent) {
      const double drift = deviation_of(spread);
      return drift <= k_small_drift * std::abs(size) ? drift : k_not_steady;
    }
    return std::sqrt(variance * n / independent) * widening(independent - 1.0);
  }
  /// The 97.5 % quantile of Student's t over that of the normal law, by the expansion in 1/degrees
  /// (Abramowitz and Stegun 1964, 26.7.5); within 3 % from 2 degrees of freedom on.
  static double widening(double degrees) {
    constexpr double z = 1.959964;
    constexpr double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    const double first = (z3 + z) / 4.0;
    const double second = (5.0 * z5 + 16.0 * z3 + 3.0 * z) / 96.0;
    const double third = (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / 384.0;
    const double f = 1.0 / degrees;
    return (z + f * (first + f * (second + f * third))) / z;
  }

  [[nodiscard]] double batch_mean(std::size_t batch, std::size_t column) const {
    return closed_[batch * columns_ + column] / durations_[batch];
  }
  void clear_open() {
    std::fill(open_.begin(), open_.end(), 0.0);
    open_duration_ = 0.0;
    open_samples_ = 0;
  }
  void merge() {
    for (std::size_t b = 0; b < k_max_batches / 2; ++b) {
      for (std::size_t c = 0; c < columns_; ++c) {
        closed_[b * columns_ + c] =
            closed_[2 * b * columns_ + c] + closed_[(2 * b + 1) * columns_ + c];
      }
      durations_[b] = durations_[2 * b] + durations_[2 * b + 1];
    }
    closed_.resize(k_max_batches / 2 * columns_);
    durations_.resize(k_max_batches / 2);
    samples_per_batch_ *= 2;
  }

  std::size_t columns_;
  std::vector<double> closed_;     ///< batch-major integrals over time
  std::vector<double> durations_;  ///< [s]
  std::vector<double> open_;
  double open_duration_ = 0.0;
  std::int64_t samples_per_batch_ = 1;
  std::int64_t open_samples_ = 0;
};

/// Time means of columns between two rows of series.csv: however seldom rows are written, each
/// times the time since the one before is the integral over all samples between them.
class RowMeans {
 public:
  explicit RowMeans(std::size_t columns) : sums_(columns, 0.0) {}

  /// One sample: `values` (as many as there are columns) held for `duration` [s].
  void add(std::span<const double> values, double duration) {
    for (std::size_t c = 0; c < sums_.size(); ++c) sums_[c] += values[c] * duration;
    duration_ += duration;
  }
  /// Since the last row; 0 without samples.
  [[nodiscard]] double mean(std::size_t column) const {
    return duration_ > 0.0 ? sums_[column] / duration_ : 0.0;
  }
  void end_row() {
    std::fill(sums_.begin(), sums_.end(), 0.0);
    duration_ = 0.0;
  }

  void save(ArchiveWriter& archive, const std::string& name) const {
    archive.numbers(name + "_sums", sums_);
    archive.number(name + "_duration", duration_);
  }
  void load(ArchiveReader& archive, const std::string& name) {
    const std::vector<double> sums = archive.numbers(name + "_sums");
    if (sums.size() != sums_.size()) {
      throw ModelError("the saved means '" + name + "' do not fit together");
    }
    sums_ = sums;
    duration_ = archive.number(name + "_duration");
  }

 private:
  std::vector<double> sums_;  ///< integrals over time
  double duration_ = 0.0;     ///< [s]
};

/// A curve over time for the report with at most 2048 points: when it is full, neighbours are
/// averaged in pairs and every later point is the mean of twice as many samples.
class ThinnedCurve {
 public:
  void add(double x, double y) {
    sum_x_ += x;
    sum_y_ += y;
    if (++samples_ < samples_per_point_) return;
    x_.push_back(sum_x_ / static_cast<double>(samples_));
    y_.push_back(sum_y_ / static_cast<double>(samples_));
    sum_x_ = sum_y_ = 0.0;
    samples_ = 0;
    if (x_.size() < k_max_points) return;
    for (std::size_t i = 0; i < k_max_points / 2; ++i) {
      x_[i] = 0.5 * (x_[2 * i] + x_[2 * i + 1]);
      y_[i] = 0.5 * (y_[2 * i] + y_[2 * i + 1]);
    }
    x_.resize(k_max_points / 2);
    y_.resize(k_max_points / 2);
    samples_per_point_ *= 2;
  }
  [[nodiscard]] std::span<const double> x() const { return x_; }
  [[nodiscard]] std::span<const double> y() const { return y_; }

  void save(ArchiveWriter& archive, const std::string& name) const {
    const double sums[] = {sum_x_, sum_y_};
    const std::int64_t counts[] = {samples_per_point_, samples_};
    archive.numbers(name + "_x", x_);
    archive.numbers(name + "_y", y_);
    archive.numbers(name + "_sums", sums);
    archive.integers(name + "_counts", counts);
  }
  void load(ArchiveReader& archive, const std::string& name) {
    x_ = archive.numbers(name + "_x");
    y_ = archive.numbers(name + "_y");
    const std::vector<double> sums = archive.numbers(name + "_sums");
    const std::vector<std::int64_t> counts = archive.integers(name + "_counts");
    sum_x_ = sums.at(0);
    sum_y_ = sums.at(1);
    samples_per_point_ = counts.at(0);
    samples_ = counts.at(1);
  }

 private:
  static constexpr std::size_t k_max_points = 2048;
  std::vector<double> x_;
  std::vector<double> y_;
  double sum_x_ = 0.0;
  double sum_y_ = 0.0;
  std::int64_t samples_per_point_ = 1;
  std::int64_t samples_ = 0;
};

/// Time means of columns of which a sample may have no value (NaN): a mean size of no grains. Such
/// samples do not count for their column; else each is as in BatchMeans.
class KnownMeans {
 public:
  explicit KnownMeans(std::size_t columns) : means_(columns, BatchMeans(1)) {}

  /// One sample: `values` held for `duration` [s].
  void add(std::span<const double> values, double duration) {
    for (std::size_t c = 0; c < means_.size(); ++c) {
      if (!std::isnan(values[c])) means_[c].add(values.subspan(c, 1), duration);
    }
  }
  /// k_no_value without a sample.
  [[nodiscard]] double mean(std::size_t column) const { return means_[column].known_mean(0); }
  /// k_nothing_passed without a sample, k_no_estimate of a mean that is 0.
  [[nodiscard]] double error(std::size_t column) const {
    const double value = mean(column);
    return error_beside(value, value != 0.0 ? means_[column].error(0) : k_no_estimate);
  }

  void save(ArchiveWriter& archive, const std::string& name) const {
    for (std::size_t c = 0; c < means_.size(); ++c) {
      means_[c].save(archive, name + "_" + std::to_string(c));
    }
  }
  void load(ArchiveReader& archive, const std::string& name) {
    for (std::size_t c = 0; c < means_.size(); ++c) {
      means_[c].load(archive, name + "_" + std::to_string(c));
    }
  }

 private:
  std::vector<BatchMeans> means_;
};

/// The state of a sensor whose figures are those of a moment: the last ones for series.csv, their
/// means with errors for the summary, the first one against time for the report. The mean of the
/// first is what a reader asks of the sensor before anything else (overview).
class SampledFigures {
 public:
  struct Column {
    const char* name;
    const char* unit;
    Quantity quantity = Quantity::unspecified;
  };
  explicit SampledFigures(std::vector<Column> columns)
      : columns_(std::move(columns)),
        values_(columns_.size(), k_no_value),
        means_(columns_.size()) {}

  /// One look: a value per column, k_no_value where there is none; the means begin after
  /// `steady_after` [s].
  void add(const WorldView& world, std::vector<double> values, double steady_after) {
    values_ = std::move(values);
    if (is_after(world, steady_after)) means_.add(values_, world.interval);
    if (!std::isnan(values_[0])) curve_.add(world.time, values_[0]);
  }
  void series(FigureSink& sink) const {
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      const auto& [name, unit, quantity] = columns_[n];
      sink.figure(name, values_[n], unit, error_beside(values_[n], k_no_estimate),
                  detail(quantity));
    }
  }
  void summary(FigureSink& sink) const {
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      const auto& [name, unit, quantity] = columns_[n];
      sink.figure(name, means_.mean(n), unit, means_.error(n),
                  n == 0 ? overview(quantity, 1) : detail(quantity));
      sink.figure(std::string(name) + "_at_end", values_[n], unit,
                  error_beside(values_[n], k_no_estimate), detail(quantity));
    }
  }
  [[nodiscard]] const ThinnedCurve& curve() const { return curve_; }

  void save(ArchiveWriter& archive) const {
    archive.numbers("values", values_);
    means_.save(archive, "means");
    curve_.save(archive, "curve");
  }
  void load(ArchiveReader& archive) {
    values_ = archive.numbers("values");
    means_.load(archive, "means");
    curve_.load(archive, "curve");
  }

 private:
  std::vector<Column> columns_;
  std::vector<double> values_;  ///< at the last look
  KnownMeans means_;
  ThinnedCurve curve_;
};

}  // namespace dust::sdk
