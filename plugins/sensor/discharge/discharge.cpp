// SPDX-License-Identifier: Apache-2.0
#include "discharge.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <numbers>

namespace {

namespace formula = dust::model::discharge;
namespace sdk = dust::sdk;

/// Loose bulk over solid density, where no bulk density is given.
constexpr double k_solids_of_bulk = 0.6;

class Discharge final : public sdk::Sensor {
 public:
  struct Parameters {
    sdk::Vec3 centre;
    double hole = 0.0;
    sdk::Vec3 direction{0.0, 0.0, -1.0};
    double reach = 0.0;
    double opened_at = 0.0;
    double from_share = 0.2;
    double to_share = 0.8;
    double bulk_density = 0.0;
    double grain_diameter = 0.0;
    double beverloo_c = 0.58;
    double beverloo_k = 1.4;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::centre, "centre", sdk::dimension::length, "Middle of the hole.");
    s.number(&Parameters::hole, "hole", sdk::dimension::length, "Diameter of the hole.")
        .symbol("D_0")
        .above(0);
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Direction in which the grains leave.")
        .optional();
    s.number(&Parameters::reach, "reach", sdk::dimension::length,
             "Grains pass within this distance of the centre; 0 = half the hole's diameter.")
        .at_least(0)
        .optional();
    s.number(&Parameters::opened_at, "opened_at", sdk::dimension::time,
             "When the hole opens: the discharge time counts from then.")
        .at_least(0)
        .optional();
    s.number(&Parameters::from_share, "from_share", sdk::dimension::none,
             "Share of the mass after which the rate is taken.")
        .at_least(0)
        .below(1)
        .optional();
    s.number(&Parameters::to_share, "to_share", sdk::dimension::none,
             "Share of the mass up to which the rate is taken.")
        .above(0)
        .at_most(1)
        .optional();
    s.number(&Parameters::bulk_density, "bulk_density", sdk::dimension::density,
             "Bulk density in Beverloo's correlation; 0 = 0.6 of the grains' own.")
        .symbol("rho_b")
        .at_least(0)
        .optional();
    s.number(&Parameters::grain_diameter, "grain_diameter", sdk::dimension::length,
             "Diameter in Beverloo's correlation; 0 = the mean by mass of what passed.")
        .symbol("d")
        .at_least(0)
        .optional();
    s.number(&Parameters::beverloo_c, "beverloo_c", sdk::dimension::none, "Beverloo's factor.")
        .symbol("C")
        .above(0)
        .optional();
    s.number(&Parameters::beverloo_k, "beverloo_k", sdk::dimension::none,
             "Width of the empty ring at the hole's rim, in diameters.")
        .symbol("k")
        .at_least(0)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "discharge",
        .version = "1.0",
        .summary = "Time and rate of the discharge through a hole, beside Beverloo's correlation.",
        .equation = R"(W = C \rho_b \sqrt{g}\,(D_0 - k d)^{5/2})",
        .source =
            "Beverloo, Leniger, van de Velde, Chem. Eng. Sci. 15 (1961) 260, "
            "doi:10.1016/0009-2509(61)85030-6"};
  }

  explicit Discharge(const Parameters& p) : p_(p) {
    const double length = norm(p.direction);
    if (!(length > 0.0)) throw sdk::ParameterError("'direction' must not be zero");
    p_.direction = p.direction / length;
    if (!(p.to_share > p.from_share))
      throw sdk::ParameterError("to_share must lie above from_share");
    if (!(p.reach > 0.0)) p_.reach = 0.5 * p.hole;
  }

  void observe(const sdk::WorldView& world) override {
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const sdk::Passage way = passage_of(world, i);
      if (way.direction == 0) continue;
      const double mass = way.direction * g.weight[i] * g.mass[i];
      sums_[k_mass] += mass;
      sums_[k_number] += way.direction * g.weight[i];
      sums_[k_moment] += mass * g.diameter[i];
      sums_[k_volume] += way.direction * g.weight[i] * std::numbers::pi / 6.0 * g.diameter[i] *
                         g.diameter[i] * g.diameter[i];
      sums_[k_last] = world.time - (1.0 - way.fraction) * world.interval;
      if (sums_[k_first] < 0.0) sums_[k_first] = sums_[k_last];
    }
    gravity_ = norm(world.gravity);
    time_.push_back(world.time);
    mass_.push_back(sums_[k_mass]);
    number_.push_back(sums_[k_number]);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass", sums_[k_mass], "kg", -1.0, k_passage.of(sdk::Quantity::mass));
    sink.figure("number", sums_[k_number], "1", -1.0, k_passage.of(sdk::Quantity::number));
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view) const override {
    return sdk::RowValue::total;
  }
  void summary(sdk::FigureSink& sink) const override {
    const auto rate = formula::middle_rate(time_, mass_, p_.from_share, p_.to_share);
    const auto numbers = formula::middle_rate(time_, number_, p_.from_share, p_.to_share);
    const double expected = expected_rate();
    sink.figure("mass", sums_[k_mass], "kg", -1.0, k_passage.of(sdk::Quantity::mass));
    sink.figure("number", sums_[k_number], "1", -1.0, k_passage.of(sdk::Quantity::number));
    const double none = has_passed() ? sdk::k_no_estimate : sdk::k_nothing_passed;
    sink.figure("time", has_passed() ? sums_[k_last] - p_.opened_at : sdk::k_no_value, "s", none,
                sdk::detail(sdk::Quantity::time));
    sink.figure("duration", has_passed() ? sums_[k_last] - sums_[k_first] : sdk::k_no_value, "s",
                none, sdk::detail(sdk::Quantity::time));
    sink.figure("rate", rate.value, "kg/s", rate.error, sdk::overview(sdk::Quantity::mass_rate, 1));
    sink.figure("number_rate", numbers.value, "1/s", numbers.error,
                k_passage.of(sdk::Quantity::number_rate));
    sink.figure("beverloo_rate", expected, "kg/s", sdk::error_beside(expected, sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::mass_rate));
    const double ratio = expected > 0.0 ? rate.value / expected : sdk::k_no_value;
    sink.figure("rate_over_beverloo", ratio, "1",
                sdk::error_beside(ratio, rate.error >= 0.0 ? rate.error / expected : -1.0),
                sdk::detail(sdk::Quantity::ratio));
  }
  void report(sdk::ReportSink& sink) const override {
    sdk::ThinnedCurve curve;
    for (std::size_t n = 0; n < time_.size(); ++n) curve.add(time_[n], mass_[n]);
    sink.curve("Discharge", "time [s]", "mass passed [kg]", "all grains", curve.x(), curve.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("sums", sums_);
    a.number("gravity", gravity_);
    a.numbers("time", time_);
    a.numbers("mass", mass_);
    a.numbers("number", number_);
  }
  void load(sdk::ArchiveReader& a) override {
    sums_ = a.numbers("sums");
    gravity_ = a.number("gravity");
    time_ = a.numbers("time");
    mass_ = a.numbers("mass");
    number_ = a.numbers("number");
  }

 private:
  static constexpr sdk::FigureRole k_passage{
      .role = sdk::Role::passage, .direction = sdk::Direction::forward, .towards = "discharge"};

  /// Net of what came back: mass [kg], number, mass times diameter, solid volume, last and first
  /// passage [s], the first below 0 while there is none.
  enum Sum { k_mass, k_number, k_moment, k_volume, k_last, k_first, k_sums };

  /// Through the hole; none beside it.
  [[nodiscard]] sdk::Passage passage_of(const sdk::WorldView& world, std::size_t i) const {
    sdk::Passage way;
    const bool is_through = sdk::any_way(world, i, [&](const sdk::Path& path) {
      way = sdk::passage(dot(path.before - p_.centre, p_.direction),
                         dot(path.now - p_.centre, p_.direction));
      if (way.direction == 0) return false;
      const sdk::Vec3 off = path.at(way.fraction) - p_.centre;
      return dot(off, off) <= p_.reach * p_.reach;
    });
    return is_through ? way : sdk::Passage{};
  }
  [[nodiscard]] bool has_passed() const { return sums_[k_number] > 0.0; }
  /// [kg/s] sdk::k_no_value before anything has passed.
  [[nodiscard]] double expected_rate() const {
    if (!has_passed() || !(sums_[k_volume] > 0.0)) return sdk::k_no_value;
    const double bulk = p_.bulk_density > 0.0 ? p_.bulk_density
                                              : k_solids_of_bulk * sums_[k_mass] / sums_[k_volume];
    const double diameter =
        p_.grain_diameter > 0.0 ? p_.grain_diameter : sums_[k_moment] / sums_[k_mass];
    return formula::beverloo(p_.beverloo_c, p_.beverloo_k, bulk, gravity_, p_.hole, diameter);
  }

  Parameters p_;
  std::vector<double> sums_ = {0.0, 0.0, 0.0, 0.0, 0.0, -1.0};
  double gravity_ = 0.0;        ///< [m/s2]
  std::vector<double> time_;    ///< [s] of each sample
  std::vector<double> mass_;    ///< [kg] passed until then
  std::vector<double> number_;  ///< the same in real grains
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Discharge>(); }
