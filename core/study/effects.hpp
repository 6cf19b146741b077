// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/noise.hpp"
#include "study/spec/spec.hpp"
#include "study/table.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dust::study {

/// Mean of one output at one level of an input, over the combinations of the other inputs that
/// every level has.
struct LevelMean {
  std::string label;
  double input = 0.0;  ///< of numbers, in the unit of the column
  double mean = 0.0;
  double error = -1.0;       ///< standard error of the mean by noise, negative: not known
  std::size_t points = 0;    ///< none: the levels have no combination in common
  std::size_t unsteady = 0;  ///< of the points
  std::size_t level = 0;     ///< of the axis
};

/// What a comparison is over, in runs.
struct Coverage {
  std::size_t planned = 0;   ///< at the levels that are compared
  std::size_t used = 0;      ///< with a value on either side
  std::size_t left_out = 0;  ///< with a value, but none on the other side to compare it with
  std::size_t unsteady = 0;  ///< of those used
};

/// "2 of 8 points are missing, 2 left out: ..."; nothing where all are there.
std::string coverage_text(const Coverage& coverage);

/// "2 of 4 points not steady"; nothing where all are.
std::string unsteady_text(const Coverage& coverage);

/// "2 of 4 points without a value: nothing passed": of this output, of runs that have finished and
/// say why; nothing where all have one.
std::string valueless_text(const Results& results, const std::string& output);

/// What one input does to one output, whatever the others are.
struct MainEffect {
  std::size_t input = 0;          ///< column
  std::size_t output = 0;         ///< column
  bool is_scattered = false;      ///< an input of a sample: too many levels for means
  std::vector<LevelMean> levels;  ///< ascending for numbers, as written for names
  /// From the first to the last level (of a line, if scattered): the mean of the changes at each
  /// combination of the other inputs that finished at both.
  double change = 0.0;
  /// Standard error of the change, negative: not known. Of replicates with the same seeds at both
  /// levels by the scatter of their changes, else by noise_of. Where that is not known, by the
  /// scatter of the change over what else is varied, of three or more: it holds, besides noise, how
  /// far the effect hangs on the other inputs. Where points are not steady it is not known.
  double error = -1.0;
  double freedom = k_free;  ///< degrees of freedom of the error
  Coverage coverage;
};

/// Whether the change is told from noise, by clear_limit.
bool is_clear(const MainEffect& effect);

/// Every input's effect on every output; inputs with fewer than two levels that finished are left
/// out.
std::vector<MainEffect> main_effects(const Spec& spec, const Results& results);

/// "60.334 +- 0.099 mm": the error with two digits, the value cut at the same place; without an
/// error (0 or negative) four digits.
std::string amount_text(double value, double error, const std::string& unit);

/// What came of an expectation.
struct Verdict {
  enum class Kind { as_expected, against, unresolved, unknown } kind = Kind::unknown;
  double change = 0.0;
  double error = -1.0;
  std::string text;  ///< one sentence
};

/// "at bodies.belt.speed 0.2 m/s": where an effect is looked at; nothing where it is a mean over
/// all.
std::string place_text(const Expectation& expectation);

/// By the sign of what is_clear; open where points are not steady.
Verdict assess(const Expectation& expectation, const Spec& spec, const Results& results);

}  // namespace dust::study
