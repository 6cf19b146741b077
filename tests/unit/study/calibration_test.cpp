// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/calibration.hpp"
#include "study/calibration/calibrate_runs.hpp"
#include "study/calibration/landscape.hpp"

#include "dust/sdk/random.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

using dust::test::approx;
using namespace dust::study;

namespace {

/// Closed forms with a scatter of single runs, counted.
class Formula final : public Evaluator {
 public:
  using Answer = std::function<std::vector<double>(const std::vector<double>&)>;
  Formula(Answer answer, std::vector<double> scatter, std::uint64_t seed)
      : answer_(std::move(answer)), scatter_(std::move(scatter)), random_(seed, 7) {}
  std::optional<std::vector<Evaluation>> evaluate(
      const std::vector<std::vector<double>>& places) override {
    std::vector<Evaluation> all;
    for (const auto& place : places) {
      Evaluation one;
      const auto values = answer_(place);
      for (std::size_t g = 0; g < values.size(); ++g) {
        one.push_back({values[g] + scatter_[g] * normal(static_cast<std::uint32_t>(g)), error});
      }
      ++runs;
      all.push_back(std::move(one));
    }
    return all;
  }
  std::size_t runs = 0;
  double error = -1.0;  ///< that every run tells of itself

 private:
  double normal(std::uint32_t goal) const {
    const double a = random_.uniform(runs, goal, 0);
    const double b = random_.uniform(runs, goal, 1);
    return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
  }
  Answer answer_;
  std::vector<double> scatter_;
  dust::sdk::Random random_;
};

/// Shaped like the hourglass: both frictions raise the angle, rolling friction shortens the time
/// because more sand stays behind, sliding friction makes it longer.
std::vector<double> hourglass(const std::vector<double>& x) {
  const double angle =
      22.0 + 26.0 * (1.0 - std::exp(-2.5 * x[0])) + 22.0 * x[1] - 9.0 * x[1] * x[1];
  const double time = 5.6 + 2.4 * x[0] - 2.0 * x[1] + 0.8 * x[0] * x[1];
  return {angle, time};
}

CalibrationSettings settings_at(const std::vector<double>& truth) {
  const auto values = hourglass(truth);
  CalibrationSettings s;
  s.goals = {{"angle", "deg", values[0], 1.1}, {"time", "s", values[1], 0.1}};
  s.parameters = {{"mu_s", "", 0.2, 0.7}, {"mu_r", "", 0.0, 0.5}};
  return s;
}

}  // namespace

TEST_CASE("a calibration shall recover a synthetic truth within its region in at most 30 runs") {
  for (const std::string surrogate : {"gaussian_process", "quadratic"}) {
    for (const auto& truth : {std::vector{0.49, 0.30}, std::vector{0.35, 0.15}}) {
      CAPTURE(surrogate);
      CAPTURE(truth[0]);
      CalibrationSettings settings = settings_at(truth);
      settings.surrogate = surrogate;
      Formula formula(hourglass, {0.4, 0.03}, 11);
      const Calibration c = calibrate(settings, formula);
      CHECK(formula.runs <= 30);
      CHECK(formula.runs == c.places.size());
      CHECK(c.is_met);
      CHECK(is_in_region(c, settings, truth));
      CHECK(c.estimates[0].low <= truth[0]);
      CHECK(c.estimates[0].high >= truth[0]);
      // The targets' own errors allow about +-0.05 in either friction here.
      CHECK(std::abs(c.estimates[0].best - truth[0]) < 0.1);
      CHECK(std::abs(c.estimates[1].best - truth[1]) < 0.1);
    }
  }
}

TEST_CASE("the region shall hold the truth about as often as it says") {
  // Targets with errors of their own, drawn anew: 40 calibrations at 80 %.
  const std::vector<double> truth = {0.45, 0.25};
  const dust::sdk::Random random(5, 1);
  std::size_t held = 0;
  constexpr std::uint64_t k_trials = 40;
  for (std::uint64_t trial = 0; trial < k_trials; ++trial) {
    CalibrationSettings settings = settings_at(truth);
    settings.first_runs = 10;
    settings.runs = 13;
    settings.confidence = 0.8;
    for (std::size_t g = 0; g < 2; ++g) {
      const double a = random.uniform(trial, static_cast<std::uint32_t>(g), 0);
      const double b = random.uniform(trial, static_cast<std::uint32_t>(g), 1);
      settings.goals[g].value += settings.goals[g].error * std::sqrt(-2.0 * std::log(a)) *
                                 std::cos(2.0 * std::numbers::pi * b);
    }
    Formula formula(hourglass, {0.2, 0.02}, trial);
    const Calibration c = calibrate(settings, formula);
    if (is_in_region(c, settings, truth)) ++held;
  }
  // Binomial(40, 0.8): 26 to 38 within three standard deviations of 32.
  CHECK(held >= 25);
  CHECK(held <= 39);
}

TEST_CASE("targets that do not pin the parameters down shall be told plainly") {
  CalibrationSettings settings = settings_at({0.49, 0.30});
  settings.goals.pop_back();  // the angle alone: a line of pairs fits
  Formula formula([](const std::vector<double>& x) { return std::vector{hourglass(x)[0]}; }, {0.3},
                  3);
  const Calibration c = calibrate(settings, formula);
  CHECK(c.is_met);
  CHECK_FALSE(c.is_pinned);
  CHECK(c.statements.front().find("do not pin down mu_s") != std::string::npos);
}

TEST_CASE("errors that the runs tell shall widen the region where they exceed their scatter") {
  // A value in proportion to the parameter: what is known of it is what is known of the target.
  for (const std::string surrogate : {"gaussian_process", "quadratic"}) {
    CAPTURE(surrogate);
    const auto calibration_with = [&](double error, double scatter) {
      CalibrationSettings settings;
      settings.goals = {{"height", "m", 0.5, 0.01}};
      settings.parameters = {{"x", "", 0.0, 1.0}};
      settings.surrogate = surrogate;
      settings.runs = 12;
      Formula formula([](const std::vector<double>& x) { return std::vector{x[0]}; }, {scatter}, 1);
      formula.error = error;
      return calibrate(settings, formula);
    };
    const Calibration silent = calibration_with(-1.0, 0.0);
    CHECK(silent.estimates[0].deviation == approx(0.01).epsilon(0.1));
    CHECK(silent.run_errors.at(0).without == silent.run_errors[0].points);
    CHECK(silent.run_errors[0].error < 0.0);
    // Runs that agree by chance, each with an error of 0.1: twelve of them cannot know a mean
    // better than 0.1 over the root of twelve, nor need they be worse than one of them.
    const Calibration wide = calibration_with(0.1, 0.0);
    CHECK(wide.run_errors.at(0).error == approx(0.1));
    CHECK(wide.run_errors[0].without == 0);
    CHECK(wide.estimates[0].deviation > std::hypot(0.01, 0.1 / std::sqrt(12.0)));
    CHECK(wide.estimates[0].deviation < 0.11);
    CHECK(wide.misfit < 0.1);
    CHECK(std::abs(chi_of({"height", "m", 0.5, 0.01}, wide.at_best.at(0))) < 0.3);
    // What scatters as much already is not counted twice.
    const Calibration scattered = calibration_with(-1.0, 0.05);
    const Calibration same = calibration_with(0.01, 0.05);
    CHECK(same.estimates[0].deviation == scattered.estimates[0].deviation);
    CHECK(same.estimates[0].best == scattered.estimates[0].best);
  }
}

TEST_CASE("replicates shall have an error together if all of them tell one, else why not") {
  const OutputValue mean = mean_of_replicates({{2.0, 0.3}, {4.0, 0.4}, {}});
  CHECK(mean.value == 3.0);
  CHECK(mean.error == approx(0.25));
  CHECK(mean.no_error.empty());
  const OutputValue poor =
      mean_of_replicates({{2.0, 0.3}, {4.0, -1.0, "few grains"}, {6.0, -1.0, k_not_steady}});
  CHECK(poor.value == 4.0);
  CHECK(poor.error < 0.0);
  CHECK(poor.no_error == k_not_steady);
  CHECK_FALSE(mean_of_replicates({{}, {}}).value);
}

TEST_CASE("parameters that only count together shall be told as tied") {
  CalibrationSettings settings;
  settings.goals = {{"sum", "", 1.0, 0.01}};
  settings.parameters = {{"a", "", 0.0, 1.0}, {"b", "", 0.0, 1.0}};
  Formula formula([](const std::vector<double>& x) { return std::vector{x[0] + x[1]}; }, {0.0}, 1);
  const Calibration c = calibrate(settings, formula);
  CHECK(c.correlation[0][1] < -0.95);
  bool is_reported = false;
  for (const auto& s : c.statements)
    is_reported = is_reported || s.find("tied") != std::string::npos;
  CHECK(is_reported);
}

TEST_CASE("targets that no values meet shall be told with what comes nearest") {
  CalibrationSettings settings = settings_at({0.49, 0.30});
  settings.goals[0].value = 70.0;
  Formula formula(hourglass, {0.3, 0.02}, 3);
  const Calibration c = calibrate(settings, formula);
  CHECK_FALSE(c.is_met);
  CHECK(c.statements.front().find("No values in the given ranges") == 0);
}

TEST_CASE("values between the places of the grid shall be found, and their region told") {
  // A bounce: energy by the square of the restitution, which lies between two places of the grid;
  // nothing else matters.
  const auto bounce = [](const std::vector<double>& x) { return std::vector{x[0] * x[0]}; };
  for (const std::size_t parameters : {1, 2, 3, 4}) {
    for (const double share : {0.01, 1e-4}) {
      CAPTURE(parameters);
      CAPTURE(share);
      CalibrationSettings settings;
      settings.goals = {{"energy", "", 0.36, 0.36 * share}};
      settings.parameters = {{"e", "", 0.3, 0.95}};
      for (std::size_t n = 1; n < parameters; ++n) {
        settings.parameters.push_back({"other_" + std::to_string(n), "", 0.0, 1.0});
      }
      settings.runs = 5 * parameters + 4;
      Formula formula(bounce, {0.0}, 1);
      const Calibration c = calibrate(settings, formula);
      CHECK(c.is_met);
      CHECK(c.estimates[0].best == approx(0.6).epsilon(std::max(share, 1e-3)));
      CHECK(c.estimates[0].low <= 0.6);
      CHECK(c.estimates[0].high >= 0.6);
      CHECK(c.estimates[0].is_pinned);
      // The deviation that the target's error makes: half its share.
      CHECK(c.estimates[0].deviation < std::max(0.6 * share, 2e-3));
      for (std::size_t n = 1; n < parameters; ++n) {
        CHECK_FALSE(c.estimates[n].is_pinned);
        CHECK(c.estimates[n].high - c.estimates[n].low > 0.9);
      }
      CHECK(c.statements.front().find("No values") == std::string::npos);
    }
  }
}

TEST_CASE("a narrow region of tied parameters shall be told by places drawn from it") {
  CalibrationSettings settings;
  settings.goals = {{"sum", "", 1.0, 1e-3}, {"product", "", 0.21, 1e-3}};
  settings.parameters = {{"a", "", 0.0, 0.5}, {"b", "", 0.5, 1.0}, {"c", "", 0.0, 1.0}};
  Formula formula(
      [](const std::vector<double>& x) {
        return std::vector{x[0] + x[1], x[0] * x[1]};
      },
      {0.0, 0.0}, 1);
  const Calibration c = calibrate(settings, formula);
  CHECK(c.is_met);
  CHECK(c.estimates[0].best == approx(0.3).epsilon(0.01));
  CHECK(c.estimates[1].best == approx(0.7).epsilon(0.01));
  // Analytic: d(sum) = da + db, d(product) = 0.7 da + 0.3 db, each with an error of 1e-3.
  CHECK(c.estimates[0].deviation == approx(1e-3 * std::sqrt(1.09) / 0.4).epsilon(0.2));
  CHECK(c.estimates[1].deviation == approx(1e-3 * std::sqrt(1.49) / 0.4).epsilon(0.2));
  CHECK(c.statements[c.statements.size() - 2].find("narrower than a grid of 31 places") !=
        std::string::npos);
}

TEST_CASE("two separate answers shall be told") {
  CalibrationSettings settings;
  settings.goals = {{"height", "m", 0.5, 0.02}};
  settings.parameters = {{"x", "", 0.0, 1.0}};
  settings.runs = 20;
  Formula formula(
      [](const std::vector<double>& x) { return std::vector{4.0 * x[0] * (1.0 - x[0])}; }, {0.0},
      1);
  const Calibration c = calibrate(settings, formula);
  CHECK(pieces_of_region(c.landscape, 1) == 2);
  CHECK(is_in_region(c, settings, {0.5 - std::sqrt(0.125)}));
  CHECK(is_in_region(c, settings, {0.5 + std::sqrt(0.125)}));
  CHECK_FALSE(is_in_region(c, settings, {0.5}));
}

TEST_CASE("chi-square quantiles shall be those of the tables") {
  CHECK(chi_square_quantile(0.95, 1.0) == approx(3.841).epsilon(0.03));
  CHECK(chi_square_quantile(0.95, 2.0) == approx(5.991).epsilon(0.01));
  CHECK(chi_square_quantile(0.99, 4.0) == approx(13.277).epsilon(0.01));
}

TEST_CASE("runs that fail shall be left out, and an interruption end the search") {
  class Moody final : public Evaluator {
   public:
    std::optional<std::vector<Evaluation>> evaluate(
        const std::vector<std::vector<double>>& places) override {
      if (runs >= 8) return std::nullopt;
      std::vector<Evaluation> all;
      for (const auto& place : places) {
        Evaluation one(1);
        if (++runs % 4 != 0) one[0].value = place[0] * place[0];
        all.push_back(one);
      }
      return all;
    }
    std::size_t runs = 0;
  } moody;
  CalibrationSettings settings;
  settings.goals = {{"square", "", 0.25, 1e-4}};
  settings.parameters = {{"x", "", 0.0, 1.0}};
  settings.first_runs = 8;
  const Calibration c = calibrate(settings, moody);
  CHECK(c.was_interrupted);
  CHECK(c.places.size() >= 8);
  CHECK(c.estimates.at(0).best == approx(0.5).epsilon(0.02));
}
