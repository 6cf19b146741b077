// SPDX-License-Identifier: Apache-2.0
#include "coordination.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::coordination;
namespace sdk = dust::sdk;

class Coordination final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    bool with_walls = true;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    sdk::declare_selection(s);
    s.boolean(&Parameters::with_walls, "with_walls",
              "Whether contacts with bodies and walls count.")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "coordination",
        .version = "1.0",
        .summary = "Number of contacts per grain, also without grains that carry no load.",
        .equation = R"(Z = \frac1N \sum_i n_i, \quad Z_m = \frac{\sum_i n_i - N_1}{N - N_0 - N_1})",
        .source = "Thornton, Geotechnique 50 (2000) 43, doi:10.1680/geot.2000.50.1.43"};
  }

  explicit Coordination(const Parameters& p) : p_(p) {}
  [[nodiscard]] bool wants_contacts() const override { return true; }

  void observe(const sdk::WorldView& world) override {
    const sdk::GrainColumns& g = world.grains;
    const sdk::ContactColumns& c = world.contacts;
    std::vector<std::int32_t> count(g.id.size(), 0);
    double walls = 0.0;
    for (std::size_t n = 0; n < c.grain_i.size(); ++n) {
      if (!(c.overlap[n] > 0.0)) continue;  // within the reach of a law, but apart
      const auto i = static_cast<std::size_t>(c.grain_i[n]);
      if (c.grain_j[n] < 0) {
        if (!p_.with_walls) continue;
        walls += p_.takes(g.diameter[i]) ? 1.0 : 0.0;
      } else {
        ++count[static_cast<std::size_t>(c.grain_j[n])];
      }
      ++count[i];
    }
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < count.size(); ++i) {
      if (p_.takes(g.diameter[i])) count[chosen++] = count[i];
    }
    count.resize(chosen);
    const formula::Numbers z = formula::numbers_of(count);
    values_ = {z.mean, z.mechanical, z.rattlers,
               chosen > 0 ? walls / static_cast<double>(chosen) : sdk::k_no_value};
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
    shares_.assign(k_max + 1, 0.0);
    for (const std::int32_t n : count) {
      shares_[static_cast<std::size_t>(std::min<std::int32_t>(n, k_max))] +=
          1.0 / static_cast<double>(chosen);
    }
    if (chosen > 0) curve_.add(world.time, z.mean);
  }

  void series(sdk::FigureSink& sink) const override {
    at_moment(sink, "mean", values_[0]);
    at_moment(sink, "mechanical", values_[1]);
  }
  void summary(sdk::FigureSink& sink) const override {
    static constexpr const char* k_names[k_columns] = {"mean", "mechanical", "rattler_share",
                                                       "wall_contacts_per_grain"};
    for (std::size_t n = 0; n < k_columns; ++n) {
      sink.figure(k_names[n], means_.mean(n), "1", means_.error(n),
                  n == 0 ? sdk::overview(sdk::Quantity::ratio, 1) : k_ratio);
      at_moment(sink, std::string(k_names[n]) + "_at_end", values_[n]);
    }
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Coordination number", "time [s]", "contacts per grain [1]", "mean", curve_.x(),
               curve_.y());
    std::vector<double> contacts;
    for (std::int32_t n = 0; n <= k_max; ++n) contacts.push_back(n);
    sink.curve("Numbers of contacts at the end", "contacts [1]", "share of grains [1]",
               "all grains", contacts, shares_);
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    a.numbers("shares", shares_);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    values_ = a.numbers("values");
    shares_ = a.numbers("shares");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr std::size_t k_columns = 4;
  static constexpr std::int32_t k_max = 16;  ///< more contacts are counted as so many

  static constexpr sdk::FigureRole k_ratio = sdk::detail(sdk::Quantity::ratio);

  static void at_moment(sdk::FigureSink& sink, const std::string& name, double value) {
    sink.figure(name, value, "1", sdk::error_beside(value, sdk::k_no_estimate), k_ratio);
  }

  Parameters p_;
  /// At the last sample.
  std::vector<double> values_ = std::vector<double>(k_columns, sdk::k_no_value);
  std::vector<double> shares_ = std::vector<double>(k_max + 1, 0.0);
  sdk::KnownMeans means_{k_columns};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Coordination>(); }
