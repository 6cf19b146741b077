// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/figure_role.hpp"
#include "dust/sdk/grid_shape.hpp"
#include "dust/sdk/model.hpp"
#include "dust/sdk/vec3.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::sdk {

/// The grains at the end of a fluid step: columns of equal length, in the order of their ids.
struct GrainColumns {
  std::span<const std::int64_t> id;
  std::span<const std::int32_t> material;
  std::span<const double> x, y, z;  ///< [m] now, in the domain
  /// [m] At the last sample (birth place if new); of a grain that has passed through a periodic
  /// side since then beyond the other one, so that the way from there is the grain's own.
  std::span<const double> x_before, y_before, z_before;
  std::span<const double> velocity_x, velocity_y, velocity_z;                          ///< [m/s]
  std::span<const double> angular_velocity_x, angular_velocity_y, angular_velocity_z;  ///< [rad/s]
  std::span<const double> force_x, force_y, force_z;  ///< [N] contact + fluid + weight
  std::span<const double> diameter;                   ///< [m]
  std::span<const double> mass;                       ///< [kg] of one real grain
  std::span<const double> weight;  ///< [-] real grains per computed one; mass counts weight * mass
};

/// The contacts at the end of a fluid step, as columns of equal length; only for sensors that want
/// them. Forces are those of the contact stage (normal and tangential).
struct ContactColumns {
  std::span<const std::int32_t> grain_i;                 ///< index into GrainColumns
  std::span<const std::int32_t> grain_j;                 ///< the same; -1 = a body or wall
  std::span<const double> force_x, force_y, force_z;     ///< [N] on i; j receives the opposite
  std::span<const double> branch_x, branch_y, branch_z;  ///< [m] from the centre of i to that of j,
                                                         ///< or to the contact point at a wall
  std::span<const double> overlap;  ///< [m] < 0: apart, but within the reach of a law
  /// [m/s] of a wall's surface at the contact point, 0 between grains
  std::span<const double> wall_velocity_x, wall_velocity_y, wall_velocity_z;
};

/// What passes the faces of the fluid's cells, as continuity has it: what goes into a cell comes
/// out of it. Of the faces across d there is one more along d than there are cells, the lower side
/// of the first cell first; x fastest. Only for sensors that want them (Sensor::wants_face_fluxes).
/// The velocity between the grains is the flux over the open share and the void fraction.
struct FaceColumns {
  std::span<const float> flux_x, flux_y, flux_z;  ///< [m/s] volume over the area of the whole face
  std::span<const float> open_x, open_y, open_z;  ///< [-] share that fluid passes, outside bodies
  std::span<const float> void_fraction_x, void_fraction_y, void_fraction_z;  ///< [-] in that share
};

/// Fluid cells, x fastest, count_x * count_y * count_z numbers each; empty for runs without fluid.
struct FluidColumns {
  Vec3 origin;   ///< [m]
  Vec3 spacing;  ///< [m]
  int count[3] = {0, 0, 0};
  double density = 0.0;                                       ///< [kg/m3]
  double viscosity = 0.0;                                     ///< [Pa s]
  std::span<const float> velocity_x, velocity_y, velocity_z;  ///< [m/s] interstitial, at centres
  std::span<const float> pressure;                            ///< [Pa] without the hydrostatic part
  std::span<const float> void_fraction;                       ///< [-] 1 - solids over open volume
  std::span<const float> open_fraction;  ///< [-] share of the cell not inside a body
  FaceColumns faces;                     ///< empty unless a sensor of the run wants them
};

/// A grain that has begun to touch a wall.
struct WallImpact {
  std::int32_t wall = 0;           ///< index into the columns
  double normal_energy = 0.0;      ///< [J] m v_n^2 / 2 of one real grain, towards the wall
  double tangential_energy = 0.0;  ///< [J] m v_t^2 / 2, v_t of the grain's surface along the wall
  double weight = 1.0;             ///< [-] real grains
};

/// What a grain has done to a wall while the two touched: sums over every step of the DEM since the
/// last sample, with the grain's weight. Steps in which it was only held count nothing.
struct WallSliding {
  std::int32_t wall = 0;  ///< index into the columns
  Vec3 place;             ///< [m] of the contact: its mean, by normal impulse
  double impulse = 0.0;   ///< [N s] of the normal force
  double sliding = 0.0;   ///< [J] normal force times the way that the grain's surface slid
  double friction = 0.0;  ///< [J] work of the force along the wall on that way
};

/// Walls: sides of the domain, then bodies. Means are over the interval since the last sample.
/// Empty unless a sensor of the run asks for them (Sensor::wants_walls).
struct WallColumns {
  std::span<const std::string> name;
  std::span<const std::string> group;      ///< "" = none
  std::span<const Vec3> force;             ///< [N] mean of the contacts on the wall
  std::span<const Vec3> torque;            ///< [N m] mean about the domain's origin
  std::span<const double> power;           ///< [W] mean of what the wall's motion gives to grains
  std::span<const double> mass;            ///< [kg] of the grains in touch now, weighted
  std::span<const std::int64_t> contacts;  ///< computed grains in touch now
  std::span<const WallImpact> impacts;     ///< since the last sample
  /// The same; empty unless a sensor of the run asks for them (Sensor::wants_sliding).
  std::span<const WallSliding> slidings;
};

/// What a sensor may look at; valid during the call only.
struct WorldView {
  double time = 0.0;            ///< [s] now
  double interval = 0.0;        ///< [s] since the last sample
  Vec3 domain_min, domain_max;  ///< [m]
  Vec3 gravity;                 ///< [m/s2]
  GrainColumns grains;
  ContactColumns contacts;  ///< empty unless a sensor of the run wants contacts
  FluidColumns fluid;
  WallColumns walls;
  std::span<const double> class_diameters;  ///< [m] ascending size classes of the run
  double emitted_mass = 0.0;                ///< [kg] so far, weighted
};

/// What stands in place of a figure's standard error where there is none.
inline constexpr double k_no_estimate = -1.0;  ///< the sensor's README says why
inline constexpr double k_few_grains = -2.0;   ///< it rests on fewer than k_min_grains
inline constexpr double k_not_steady = -3.0;   ///< it has not settled in the time observed
/// An amount per load: the feed begins, ends or changes in the time observed, and no value is
/// given.
inline constexpr double k_feed_not_even = -4.0;
/// A mean, a quantile, a place or a ratio of nothing: no grain has passed or lies there, and no
/// value is given. Amounts, rates and counts of nothing are 0.
inline constexpr double k_nothing_passed = -5.0;

/// The value of such a figure.
inline constexpr double k_no_value = std::numeric_limits<double>::quiet_NaN();

/// What stands beside `value` for its error: k_nothing_passed where it has no value.
inline double error_beside(double value, double error) {
  return std::isnan(value) ? k_nothing_passed : error;
}

/// An error times a factor >= 0, as of another unit; a reason why there is none stays that.
inline double scaled_error(double error, double factor) {
  return error < 0.0 ? error : error * factor;
}

/// Fewer independent grains tell no error.
inline constexpr double k_min_grains = 20.0;

/// The reason as files give it: "few grains", "not steady", "feed not even", "nothing passed", ""
/// for none in particular.
constexpr std::string_view reason_without_error(double uncertainty) {
  if (uncertainty == k_few_grains) return "few grains";
  if (uncertainty == k_feed_not_even) return "feed not even";
  if (uncertainty == k_nothing_passed) return "nothing passed";
  return uncertainty == k_not_steady ? "not steady" : "";
}

/// Takes the figures of a sensor. `uncertainty` is one standard error in the same unit; a negative
/// number means that there is none (k_no_estimate, k_few_grains, k_not_steady,
/// k_feed_not_even, k_nothing_passed).
class FigureSink {
 public:
  virtual ~FigureSink() = default;
  /// One figure of summary.json. `name` is a path of snake_case words, e.g. "drop_140_mm/median";
  /// `role` says what the figure is: the report reads it and never the name.
  virtual void figure(std::string_view name, double value, std::string_view unit,
                      double uncertainty, const FigureRole& role) = 0;
  /// A detail of no quantity that the report knows.
  void figure(std::string_view name, double value, std::string_view unit,
              double uncertainty = -1.0) {
    figure(name, value, unit, uncertainty, FigureRole{});
  }
  /// A detail of a quantity, without an error.
  void figure(std::string_view name, double value, std::string_view unit, Quantity quantity) {
    figure(name, value, unit, -1.0, detail(quantity));
  }
};

/// Takes raw material of the report: a section of the sensor's own, curves, histograms and tables.
class ReportSink {
 public:
  virtual ~ReportSink() = default;
  /// Heads a section of the sensor's own, which then holds its curves and tables, and says in
  /// `text` what they show. Without it they stand among those of all sensors.
  virtual void section(std::string_view heading, std::string_view text) = 0;
  virtual void curve(std::string_view title, std::string_view x_label, std::string_view y_label,
                     std::string_view series, std::span<const double> x,
                     std::span<const double> y) = 0;
  /// A table row per call; the first call with a title fixes the columns.
  virtual void row(std::string_view title, std::span<const std::string> columns,
                   std::span<const double> values) = 0;

  /// A histogram: `heights[n]` between `edges[n]` and `edges[n + 1]`, as a curve of steps.
  void histogram(std::string_view title, std::string_view x_label, std::string_view y_label,
                 std::string_view series, std::span<const double> edges,
                 std::span<const double> heights) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t n = 0; n < heights.size() && n + 1 < edges.size(); ++n) {
      x.insert(x.end(), {edges[n], edges[n + 1]});
      y.insert(y.end(), {heights[n], heights[n]});
    }
    curve(title, x_label, y_label, series, x, y);
  }
};

/// Takes fields for results.h5.
class FieldSink {
 public:
  virtual ~FieldSink() = default;
  /// One number per cell of a grid of the sensor's own, x fastest. It stands in results.h5 as
  /// /sensors/<frame>/<sensor>/<name>, with `role` in its attributes. `name` is snake_case.
  virtual void field(std::string_view name, std::string_view unit, const GridShape& grid,
                     std::span<const double> values, const FigureRole& role) = 0;
  /// A detail of no quantity that the report knows.
  void field(std::string_view name, std::string_view unit, const GridShape& grid,
             std::span<const double> values) {
    field(name, unit, grid, values, FigureRole{});
  }
};

/// What a column of series.csv stands for where a row is written every so many fluid steps only.
enum class RowValue {
  instant,  ///< as it is at the time of the row
  mean,     ///< over the time since the row before
  total     ///< of all that has happened since the start
};

/// The surfaces that a sensor looks at, asked for once before a run: without them its figures are
/// zeros that look like answers.
struct SurfacesWanted {
  struct Box {
    Vec3 min, max;  ///< [m]
  };
  struct Stretch {
    Vec3 middle;         ///< [m] on the surface
    Vec3 along;          ///< [-] of length 1: the way that the surface runs, if it does
    double reach = 0.0;  ///< [m] how far off the surface may be
  };
  std::optional<Box> wall_in;          ///< some wall has a part in it
  std::span<const std::string> walls;  ///< of these names or groups alone; empty: any
  std::optional<Stretch> stretch;      ///< of a belt, or of what else a load lies on
  std::string_view rubbed_side;        ///< a side of the domain that the fluid goes along; "": none
};

/// Observes the world once per fluid step (grains-only runs: once per sampling interval), on const
/// data, possibly at the same time as other sensors. Everything between calls is state.
class Sensor : public Model {
 public:
  static constexpr const char* k_kind = "sensor";
  virtual void observe(const WorldView& world) = 0;
  /// The world as it is when a sensor begins later than the grains, as in a run that starts from
  /// another: called once, before the first look, with an interval of 0. What is there already has
  /// not come in, and what was emitted is not fed, while it looked.
  virtual void begin(const WorldView&) {}
  /// Whether the view needs contacts, which cost a pass over all of them.
  [[nodiscard]] virtual bool wants_contacts() const { return false; }
  /// Columns for series.csv: the same names in the same order at every call.
  virtual void series(FigureSink& sink) const = 0;
  /// What a column of `series` stands for. What happens between two rows must not be lost: a load
  /// or a rate is a mean.
  [[nodiscard]] virtual RowValue row_value(std::string_view) const { return RowValue::instant; }
  /// A row has been written: the time that means are taken over begins anew (RowMeans).
  virtual void end_row() {}
  /// Figures for summary.json, with uncertainties.
  virtual void summary(FigureSink& sink) const = 0;
  virtual void report(ReportSink&) const {}
  /// Fields as they are now; asked for with every frame, always for the same ones.
  virtual void fields(FieldSink&) const {}
  /// Whether it reads WorldView::walls; these are kept only when a sensor does.
  [[nodiscard]] virtual bool wants_walls() const { return false; }
  /// Whether it reads WallColumns::slidings, which are kept only when a sensor does; the other
  /// columns of walls then are, too.
  [[nodiscard]] virtual bool wants_sliding() const { return false; }
  /// Whether it reads FluidColumns::faces; these are copied only when a sensor does.
  [[nodiscard]] virtual bool wants_face_fluxes() const { return false; }
  /// Whether it has nothing to tell where there is no fluid.
  [[nodiscard]] virtual bool wants_fluid() const { return false; }
  [[nodiscard]] virtual SurfacesWanted wanted_surfaces() const { return {}; }
};

}  // namespace dust::sdk
