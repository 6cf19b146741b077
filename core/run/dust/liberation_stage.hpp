// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/exact_sum.hpp"
#include "dust/sdk/liberation_law.hpp"
#include "io/run_files.hpp"
#include "particles/dem.hpp"
#include "run/archive_parts.hpp"
#include "run/dust/dust_stage.hpp"
#include "run/dust/moisture_effect.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dust::run {

/// Dust that comes off grains and is airborne from then on: in each fluid step, for what contacts
/// have dissipated in it and for the wind at its end. Sums stand in the order of rows: the same on
/// any number of threads.
class LiberationStage {
 public:
  /// All but the law are kept by reference; the particles keep the wind for a law that needs it.
  LiberationStage(const scenario::Setup& setup, const scenario::DustSetup& dust_setup,
                  std::unique_ptr<sdk::LiberationLaw> law, DustStage& dust,
                  particles::Dem& particles);

  /// After the grains have moved through a fluid step of `step` [s].
  void advance(double step);

  /// What sets dust free: other grains, then the walls by name, then the wind if the law wants it.
  [[nodiscard]] const std::vector<std::string>& causes() const { return causes_; }
  /// Of `causes`, the first: those that are impacts.
  [[nodiscard]] std::size_t impact_causes() const { return impact_energy_.size(); }
  /// [J] dissipated in contacts in the last fluid step, weights counted, feed zones left out.
  [[nodiscard]] double impact_energy(std::size_t cause) const {
    return impact_energy_[cause].value();
  }
  /// [kg] of class `n` since the start.
  [[nodiscard]] double set_free(std::size_t cause, std::size_t n) const {
    return set_free_[cause * classes_ + n].value();
  }
  /// Where dust came off: [kg] of all classes in each cell since the start, one field for each kind
  /// of cause, for a frame.
  [[nodiscard]] std::vector<io::SensorField> fields() const;
  /// [kg] that would have come off where there was no gas to take it, and stayed on its grain.
  [[nodiscard]] double kept_back() const { return kept_back_.value(); }

  /// What the law makes of the moisture of the grains, a line for each material.
  [[nodiscard]] std::vector<std::string> moisture_lines(
      const std::vector<scenario::MaterialSpec>& materials) const {
    return run::moisture_lines(*law_, materials, loads_);
  }

  /// Goes on from what came off in another run with the same classes and these walls.
  void transfer_from(sdk::ArchiveReader& archive, const std::vector<std::string>& walls,
                     bool is_same_grid);

  void add_parts(SaveParts& parts) const;
  void add_parts(LoadParts& parts);

 private:
  using Column = std::vector<double>;
  /// Kinds of causes, as the map by place tells them apart.
  enum Kind : std::size_t { by_grains, by_walls, by_wind };
  static constexpr std::size_t k_kinds = 3;
  static constexpr std::array<const char*, k_kinds> k_kind_names = {"grains", "walls", "wind"};

  /// l of the grain in a row: the law is asked about one of the l^3 grains that it stands for.
  [[nodiscard]] double coarse_graining(std::size_t row) const;
  [[nodiscard]] bool is_in_feed_zone(sdk::Vec3 centre) const;
  void find_impacts();
  void add_impact_energy(std::size_t row, double weight);
  void find_wind();
  void load_columns();
  [[nodiscard]] std::size_t place(std::size_t q, std::size_t n) const;
  [[nodiscard]] sdk::DustyGrains grains(std::size_t first, std::size_t count, double step);
  /// `ask`(first, grains) for all calls, several at once.
  void ask_law(double step, const std::function<void(std::size_t, const sdk::DustyGrains&)>& ask);
  void give_to_air(bool is_by_wind);
  void share_by_cause(std::size_t row, std::size_t n, double mass, std::size_t cell);
  [[noreturn]] void fail(std::size_t row, double released, double load) const;

  particles::Dem& particles_;
  DustStage& dust_;
  std::unique_ptr<sdk::LiberationLaw> law_;
  std::string law_name_;
  std::size_t classes_;
  std::vector<scenario::DustLoadSpec> loads_;  ///< by material
  std::vector<double> coarse_graining_;        ///< [-] l by material
  std::vector<scenario::FeedZoneSpec> feed_zones_;
  std::vector<std::string> causes_;
  std::vector<std::int32_t> rows_;  ///< that the law is asked about
  struct {
    Column diameter, mass, moisture, load, fresh, released;
    Column normal, tangential, acceleration;  ///< of impacts
    Column slip, shear, void_fraction;        ///< of wind
  } columns_;
  std::vector<base::ExactSum> impact_energy_;     ///< [J] by cause, of this step
  std::vector<base::ExactSum> set_free_;          ///< by cause and class
  std::array<fluid::CellField, k_kinds> places_;  ///< [kg] by kind of cause; empty: not asked for
  base::ExactSum kept_back_;
};

}  // namespace dust::run
