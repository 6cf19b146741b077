// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

namespace sdk = dust::sdk;

class Oscillate final : public sdk::Motion {
 public:
  struct Parameters {
    std::vector<double> amplitude;
    std::vector<double> frequency;
    std::vector<double> phase;
    std::vector<sdk::Vec3> along;
    double start = 0.0;
    double stop = std::numeric_limits<double>::infinity();
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.numbers(&Parameters::amplitude, "amplitude", sdk::dimension::length,
              "Amplitude of each term: half of what it moves from end to end.")
        .symbol("A")
        .above(0);
    s.numbers(&Parameters::frequency, "frequency", sdk::dimension::frequency,
              "Frequency of each term.")
        .symbol("f")
        .above(0);
    s.vectors(&Parameters::along, "along", sdk::dimension::none,
              "Direction of each term; its length does not matter. One alone holds for all.")
        .symbol("e");
    s.numbers(&Parameters::phase, "phase", sdk::dimension::angle,
              "Phase of each term at the start; without it, 0.")
        .symbol("phi")
        .optional();
    s.number(&Parameters::start, "start", sdk::dimension::time, "Time at which it sets off.")
        .symbol("t_0")
        .at_least(0)
        .optional();
    s.number(&Parameters::stop, "stop", sdk::dimension::time,
             "Time at which it stops, where it is then.")
        .at_least(0)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "oscillate",
            .version = "1.0",
            .summary = "A body that swings to and fro, in one or several harmonic terms.",
            .equation =
                "x = x_0 + \\sum_k A_k e_k [\\sin(2 \\pi f_k (t - t_0) + \\varphi_k) "
                "- \\sin \\varphi_k]",
            .source = "kinematics; own derivation"};
  }

  explicit Oscillate(const Parameters& p) : start_(p.start), stop_(p.stop) {
    const std::size_t n = p.amplitude.size();
    if (p.frequency.size() != n) {
      throw sdk::ParameterError("amplitude and frequency differ in length");
    }
    if (!p.phase.empty() && p.phase.size() != n) {
      throw sdk::ParameterError("amplitude and phase differ in length");
    }
    if (p.along.size() != 1 && p.along.size() != n) {
      throw sdk::ParameterError("along has neither one direction nor one for each amplitude");
    }
    if (p.stop <= p.start) throw sdk::ParameterError("stop is not after start");
    for (std::size_t k = 0; k < n; ++k) {
      const sdk::Vec3 e = p.along.size() == 1 ? p.along[0] : p.along[k];
      if (!(norm(e) > 0.0)) throw sdk::ParameterError("along has no direction");
      terms_.push_back({(p.amplitude[k] / norm(e)) * e, 2.0 * std::numbers::pi * p.frequency[k],
                        p.phase.empty() ? 0.0 : p.phase[k]});
    }
  }
  [[nodiscard]] double largest_speed() const override {
    double sum = 0.0;
    for (const Term& t : terms_) sum += t.rate * norm(t.swing);
    return sum;
  }
  [[nodiscard]] bool moves_body() const override { return true; }
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    sdk::RigidPose pose;
    const double tau = std::min(time, stop_) - start_;
    if (tau < 0.0) return pose;
    for (const Term& t : terms_) {
      const double angle = t.rate * tau + t.phase;
      pose.shift += (std::sin(angle) - std::sin(t.phase)) * t.swing;
      if (time < stop_) pose.velocity += (t.rate * std::cos(angle)) * t.swing;
    }
    return pose;
  }

 private:
  struct Term {
    sdk::Vec3 swing;
    double rate = 0.0;  ///< [1/s]
    double phase = 0.0;
  };
  std::vector<Term> terms_;
  double start_;
  double stop_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Oscillate>(); }
