// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/cloud.hpp"

#include "dust/sdk/random.hpp"
#include "study/calibration/landscape.hpp"
#include "study/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace dust::study {
namespace {

constexpr std::size_t k_count = 1000;
/// Moves of every place each time the goals weigh more.
constexpr std::size_t k_moves = 4;
/// The goals weigh so much more each time that this share of the places still counts.
constexpr double k_share = 0.5;
/// A bound, for surrogates that say nothing: the share above halves the volume each time.
constexpr std::size_t k_max_rounds = 200;

class Cloud {
 public:
  Cloud(const CalibrationSettings& settings, const Surrogates& surrogates)
      : settings_(settings),
        surrogates_(surrogates),
        dimensions_(settings.parameters.size()),
        random_(settings.seed, sdk::stream_of("cloud")) {}

  WeighedPlaces draw() {
    places_ = sobol(k_count, dimensions_, settings_.seed);
    for (const auto& place : places_) minus_log_.push_back(minus_log_at(place));
    double reached = 0.0;
    for (std::size_t round = 0; round < k_max_rounds && reached < 1.0; ++round) {
      const double next = next_weight(reached);
      thin(next - reached);
      reached = next;
      for (std::size_t n = 0; n < k_moves; ++n) move(reached, n);
    }
    WeighedPlaces cloud;
    cloud.places = places_;
    cloud.minus_log = minus_log_;
    cloud.weight.assign(places_.size(), 1.0);
    cloud.predictions.resize(surrogates_.size());
    for (const auto& place : places_) {
      const auto here = predictions_at(surrogates_, place);
      for (std::size_t g = 0; g < here.size(); ++g) cloud.predictions[g].push_back(here[g]);
    }
    return cloud;
  }

 private:
  [[nodiscard]] double minus_log_at(const std::vector<double>& place) const {
    return fit_of(settings_, predictions_at(surrogates_, place)).minus_log;
  }

  double draw_number(std::size_t id, std::uint32_t slot) const {
    return random_.uniform(id, turn_, slot);
  }

  /// How many places count once the goals weigh `more`: the square of the weights' sum over the sum
  /// of their squares.
  [[nodiscard]] double counting(double more) const {
    const double least = *std::min_element(minus_log_.begin(), minus_log_.end());
    double sum = 0.0;
    double squares = 0.0;
    for (const double v : minus_log_) {
      const double weight = std::exp(-more * (v - least));
      sum += weight;
      squares += weight * weight;
    }
    return sum * sum / squares;
  }

  [[nodiscard]] double next_weight(double reached) const {
    const double wanted = k_share * static_cast<double>(k_count);
    if (counting(1.0 - reached) >= wanted) return 1.0;
    // By halves of the logarithm: the first steps may be of a billionth.
    double low = -60.0;
    double high = std::log(1.0 - reached);
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (low + high);
      (counting(std::exp(middle)) >= wanted ? low : high) = middle;
    }
    return reached + std::exp(low);
  }

  /// Each place as often as its weight says, by one draw.
  void thin(double more) {
    ++turn_;
    const double least = *std::min_element(minus_log_.begin(), minus_log_.end());
    double total = 0.0;
    for (const double v : minus_log_) total += std::exp(-more * (v - least));
    const double step = total / static_cast<double>(k_count);
    double at = step * draw_number(0, 0);
    double sum = 0.0;
    Sample kept;
    std::vector<double> kept_minus_log;
    for (std::size_t n = 0; n < places_.size() && kept.size() < k_count; ++n) {
      sum += std::exp(-more * (minus_log_[n] - least));
      for (; at < sum && kept.size() < k_count; at += step) {
        kept.push_back(places_[n]);
        kept_minus_log.push_back(minus_log_[n]);
      }
    }
    places_ = std::move(kept);
    minus_log_ = std::move(kept_minus_log);
  }

  /// Every place by the difference of two others, accepted as Metropolis does; every other time by
  /// the whole of it, which leads from one piece of a region to another.
  void move(double reached, std::size_t number) {
    ++turn_;
    const Sample before = places_;
    const double length =
        number % 2 == 0 ? 2.38 / std::sqrt(2.0 * static_cast<double>(dimensions_)) : 1.0;
    const auto any = [&](std::size_t n, std::uint32_t slot) -> const std::vector<double>& {
      const double share = draw_number(n, slot) * static_cast<double>(before.size());
      return before[std::min(before.size() - 1, static_cast<std::size_t>(share))];
    };
    for (std::size_t n = 0; n < places_.size(); ++n) {
      const auto& a = any(n, 0);
      const auto& b = any(n, 1);
      std::vector<double> next = places_[n];
      bool is_inside = true;
      for (std::size_t d = 0; d < dimensions_; ++d) {
        constexpr double k_jitter = 1e-6;
        next[d] += length * (a[d] - b[d]) +
                   k_jitter * (draw_number(n, static_cast<std::uint32_t>(3 + d)) - 0.5);
        is_inside = is_inside && next[d] >= 0.0 && next[d] <= 1.0;
      }
      if (!is_inside) continue;
      const double there = minus_log_at(next);
      if (draw_number(n, 2) >= std::exp(-reached * (there - minus_log_[n]))) continue;
      places_[n] = std::move(next);
      minus_log_[n] = there;
    }
  }

  const CalibrationSettings& settings_;
  const Surrogates& surrogates_;
  std::size_t dimensions_;
  sdk::Random random_;
  std::uint32_t turn_ = 0;
  Sample places_;
  std::vector<double> minus_log_;
};

}  // namespace

std::vector<Prediction> predictions_at(const Surrogates& surrogates,
                                       const std::vector<double>& place) {
  std::vector<Prediction> predictions;
  predictions.reserve(surrogates.size());
  for (const auto& s : surrogates) predictions.push_back(s->at(place));
  return predictions;
}

WeighedPlaces draw_cloud(const CalibrationSettings& settings, const Surrogates& surrogates) {
  return Cloud(settings, surrogates).draw();
}

std::vector<double> refined(const CalibrationSettings& settings, const Surrogates& surrogates,
                            std::vector<double> place, double step) {
  constexpr double k_finest = 1e-6;
  const auto minus_log_at = [&](const std::vector<double>& at) {
    return fit_of(settings, predictions_at(surrogates, at)).minus_log;
  };
  double here = minus_log_at(place);
  while (step > k_finest) {
    bool is_better = false;
    for (std::size_t d = 0; d < place.size(); ++d) {
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> next = place;
        next[d] = std::clamp(next[d] + sign * step, 0.0, 1.0);
        const double there = minus_log_at(next);
        if (there >= here) continue;
        place = std::move(next);
        here = there;
        is_better = true;
      }
    }
    if (!is_better) step *= 0.5;
  }
  return place;
}

}  // namespace dust::study
