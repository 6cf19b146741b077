// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace dust::preflight {

/// What the time of a run goes to.
enum class CostTerm : std::size_t { grains, fine_grains, fluid, exchange, dust, output, rest };
inline constexpr std::size_t k_cost_terms = 7;

/// A term as people and files name it, and what its amount counts.
struct CostTermText {
  const char* name;
  const char* counts;
};
inline constexpr std::array<CostTermText, k_cost_terms> k_cost_term_texts = {{
    {"grains", "steps of grains at the coarse rate"},
    {"fine_grains", "steps of grains at finer rates"},
    {"fluid", "sub-steps of cells"},
    {"exchange", "fluid steps of grains and of the cells they share their volume with"},
    {"dust", "sub-steps of cells, for each class of dust in the air"},
    {"output", "frames"},
    {"rest", "fluid steps"},
}};

/// An amount of work and the processor time [s] it takes.
struct Spent {
  double amount = 0.0;
  double seconds = 0.0;
};

/// An amount of work and its time for each term.
class CostTerms {
 public:
  [[nodiscard]] Spent& operator[](CostTerm term) { return (*this)[static_cast<std::size_t>(term)]; }
  [[nodiscard]] const Spent& operator[](CostTerm term) const {
    return (*this)[static_cast<std::size_t>(term)];
  }
  [[nodiscard]] Spent& operator[](std::size_t n) { return all_[n]; }
  [[nodiscard]] const Spent& operator[](std::size_t n) const { return all_[n]; }
  /// [s] of one processor, all terms together
  [[nodiscard]] double seconds() const {
    double sum = 0.0;
    for (const Spent& term : all_) sum += term.seconds;
    return sum;
  }

 private:
  std::array<Spent, k_cost_terms> all_;
};

/// What a run costs, as estimated before or as measured.
struct RunCost {
  CostTerms terms;
  double memory_bytes = 0.0;
  double disk_bytes = 0.0;
};

}  // namespace dust::preflight
