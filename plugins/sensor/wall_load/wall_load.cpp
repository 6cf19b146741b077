// SPDX-License-Identifier: Apache-2.0
#include "wall_load.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>
#include <dust/sdk/wall_selection.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace {

namespace formula = dust::model::wall_load;
namespace sdk = dust::sdk;

class WallLoad final : public sdk::Sensor {
 public:
  struct Parameters {
    std::vector<std::string> walls;
    sdk::Vec3 about;
    double averaging_after = 0.0;
    double least_energy = 1e-12;
    double largest_energy = 1e-3;
    std::int64_t bins = 36;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    sdk::declare_walls(s, "whose loads are added up");
    s.vector(&Parameters::about, "about", sdk::dimension::length,
             "Point the torque is taken about.")
        .symbol("p")
        .optional();
    s.number(&Parameters::averaging_after, "averaging_after", sdk::dimension::time,
             "Time from which means are taken and impacts are counted.")
        .at_least(0)
        .optional();
    s.number(&Parameters::least_energy, "least_energy", sdk::dimension::energy,
             "Lower end of the spectrum of impact energies; softer touches do not count.")
        .above(0)
        .optional();
    s.number(&Parameters::largest_energy, "largest_energy", sdk::dimension::energy,
             "Upper end of the spectrum; harder impacts count in its last bin.")
        .above(0)
        .optional();
    s.integer(&Parameters::bins, "bins", "Bins of the spectrum, even in the logarithm.")
        .at_least(1)
        .at_most(10000)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "wall_load",
        .version = "1.0",
        .summary = "Force, torque, power, mass in contact and impact energies of walls.",
        .equation =
            R"(F = -\sum_c w_c f_c,\quad T_p = -\sum_c w_c [(x_c - p) \times f_c + M_c],\quad )"
            R"(P = \sum_c w_c (f_c \cdot v_w + M_c \cdot \omega_w),\quad E = \tfrac{1}{2} m v_n^2)",
        .source = "own definition"};
  }

  explicit WallLoad(const Parameters& p)
      : p_(p),
        walls_(p.walls),
        bins_{p.least_energy, p.largest_energy, static_cast<std::size_t>(p.bins)} {
    if (!(p.largest_energy > p.least_energy)) {
      throw sdk::ParameterError("largest_energy is not above least_energy");
    }
    normal_.assign(bins_.count, 0.0);
    tangential_.assign(bins_.count, 0.0);
  }

  [[nodiscard]] bool wants_walls() const override { return true; }

  void observe(const sdk::WorldView& world) override {
    const sdk::WallColumns& w = world.walls;
    values_.fill(0.0);
    sdk::Vec3 force;
    sdk::Vec3 torque;
    walls_.look(w);
    for (std::size_t n = 0; n < w.name.size(); ++n) {
      if (!walls_.holds(n)) continue;
      force += w.force[n];
      torque += w.torque[n];
      values_[k_power] += w.power[n];
      values_[k_mass] += w.mass[n];
      values_[k_contacts] += static_cast<double>(w.contacts[n]);
    }
    torque = formula::torque_about(p_.about, torque, force);
    for (int d = 0; d < 3; ++d) {
      values_[static_cast<std::size_t>(d)] = force[d];
      values_[3 + static_cast<std::size_t>(d)] = torque[d];
    }
    row_.add({values_.data(), k_mass}, world.interval);
    curve_.add(world.time, norm(force));
    if (!sdk::is_after(world, p_.averaging_after)) return;
    means_.add(values_, world.interval);
    for (const sdk::WallImpact& i : w.impacts) {
      const double energy = i.normal_energy + i.tangential_energy;
      if (!walls_.holds(i.wall) || energy < p_.least_energy) continue;
      impacts_ += i.weight;
      impact_squares_ += i.weight * i.weight;
      impact_energy_[0] += i.weight * i.normal_energy;
      impact_energy_[1] += i.weight * i.tangential_energy;
      largest_ = std::max(largest_, energy);
      normal_[bins_.index(i.normal_energy)] += i.weight;
      tangential_[bins_.index(i.tangential_energy)] += i.weight;
    }
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t c = 0; c < k_columns; ++c) {
      sink.figure(k_names[c], c < k_mass ? row_.mean(c) : values_[c], k_units[c], k_quantities[c]);
    }
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view column) const override {
    const auto* const end = k_names + k_mass;
    return std::find(k_names, end, column) != end ? sdk::RowValue::mean : sdk::RowValue::instant;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    summary_of_force(sink);
    for (std::size_t c = 0; c < k_columns; ++c) {
      sink.figure(k_names[c], means_.known_mean(c), k_units[c], means_.error(c),
                  sdk::detail(k_quantities[c]));
    }
    // Impacts come one by one: their number scatters like a Poisson count, in which a grain that
    // stands for w of them comes w at a time.
    const double scatter = impacts_ > 0.0 ? std::sqrt(impact_squares_) : sdk::k_no_estimate;
    sink.figure("impacts", impacts_, "1", scatter, sdk::detail(sdk::Quantity::number));
    sink.figure("impact_energy_normal", impact_energy_[0], "J", sdk::Quantity::energy);
    sink.figure("impact_energy_tangential", impact_energy_[1], "J", sdk::Quantity::energy);
    sink.figure("impact_energy_largest", largest_, "J", sdk::Quantity::energy);
    const double median = bins_.median(normal_);
    sink.figure("impact_energy_normal_median", median, "J",
                sdk::error_beside(median, sdk::k_no_estimate), sdk::detail(sdk::Quantity::energy));
    const double time = means_.duration();
    const double rate = time > 0.0 ? impacts_ / time : sdk::k_no_value;
    sink.figure("impact_rate", rate, "1/s",
                sdk::error_beside(rate, sdk::scaled_error(scatter, 1.0 / time)),
                sdk::detail(sdk::Quantity::rate));
  }

  void report(sdk::ReportSink& sink) const override {
    sink.curve("Force on the wall", "time [s]", "force [N]", "all", curve_.x(), curve_.y());
    std::vector<double> energy;
    for (std::size_t b = 0; b < bins_.count; ++b) energy.push_back(bins_.middle(b));
    sink.curve("Impact energies", "energy of an impact [J]", "impacts", "normal", energy, normal_);
    sink.curve("Impact energies", "energy of an impact [J]", "impacts", "tangential", energy,
               tangential_);
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    const double sums[] = {impacts_, impact_energy_[0], impact_energy_[1], largest_,
                           impact_squares_};
    a.numbers("sums", sums);
    a.numbers("normal", normal_);
    a.numbers("tangential", tangential_);
    means_.save(a, "means");
    row_.save(a, "row");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    const auto values = a.numbers("values");
    std::copy_n(values.begin(), std::min(values.size(), values_.size()), values_.begin());
    const auto sums = a.numbers("sums");
    impacts_ = sums.at(0);
    impact_energy_ = {sums.at(1), sums.at(2)};
    largest_ = sums.at(3);
    // Older checkpoints hold none: as of grains that stand for one each.
    impact_squares_ = sums.size() > 4 ? sums[4] : impacts_;
    normal_ = a.numbers("normal");
    tangential_ = a.numbers("tangential");
    means_.load(a, "means");
    row_.load(a, "row");
    curve_.load(a, "curve");
  }

 private:
  /// The magnitude of the mean force: what a reader asks for first, whatever the axes are.
  void summary_of_force(sdk::FigureSink& sink) const {
    const sdk::Vec3 mean{means_.known_mean(0), means_.known_mean(1), means_.known_mean(2)};
    const double force = norm(mean);
    double error = sdk::k_no_estimate;
    if (force > 0.0) {
      const std::array<double, k_columns> partials{mean.x / force, mean.y / force, mean.z / force};
      error = means_.error_of_function(partials, force);
    }
    sink.figure("force", force, "N", sdk::error_beside(force, error),
                sdk::overview(sdk::Quantity::force, 1));
  }

  static constexpr std::size_t k_power = 6;
  static constexpr std::size_t k_mass = 7;  ///< the first of those that a moment has
  static constexpr std::size_t k_contacts = 8;
  static constexpr std::size_t k_columns = 9;
  static constexpr const char* k_names[k_columns] = {"force_x",  "force_y",         "force_z",
                                                     "torque_x", "torque_y",        "torque_z",
                                                     "power",    "mass_in_contact", "contacts"};
  static constexpr const char* k_units[k_columns] = {"N",   "N", "N",  "N m", "N m",
                                                     "N m", "W", "kg", "1"};
  static constexpr sdk::Quantity k_quantities[k_columns] = {
      sdk::Quantity::force,  sdk::Quantity::force,  sdk::Quantity::force,
      sdk::Quantity::torque, sdk::Quantity::torque, sdk::Quantity::torque,
      sdk::Quantity::power,  sdk::Quantity::mass,   sdk::Quantity::number};

  Parameters p_;
  sdk::WallSelection walls_;
  formula::Bins bins_;
  std::array<double, k_columns> values_{};   ///< at the last sample
  double impacts_ = 0.0;                     ///< [-] real grains
  double impact_squares_ = 0.0;              ///< [-] of the weights of impacts
  std::array<double, 2> impact_energy_{};    ///< [J] normal, tangential
  double largest_ = 0.0;                     ///< [J]
  std::vector<double> normal_, tangential_;  ///< spectra
  sdk::BatchMeans means_{k_columns};
  sdk::RowMeans row_{k_mass};  ///< of force, torque and power
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<WallLoad>(); }
