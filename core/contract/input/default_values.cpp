// SPDX-License-Identifier: Apache-2.0
#include "contract/input/default_values.hpp"

#include "contract/contract.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace dust::contract {
namespace {

using sdk::Parameter;
using sdk::ParameterType;
using sdk::Value;
using sdk::Vec3;

/// Sizes of things in the standard scenes, the most usual first.
std::vector<double> typical(sdk::Dimension d) {
  namespace dim = sdk::dimension;
  if (d == dim::none) return {0.5, 0.25, 0.9, 0.1, 2.0, 1.0, 0.01, 10.0};
  if (d == dim::length) return {1e-3, 5e-4, 1e-4, 0.01, 0.05, 0.1, 1e-5, 1.0};
  if (d == dim::time) return {0.03, 0.05, 1e-3, 1e-6};
  if (d == dim::velocity) return {0.5, 0.05, 2.0};
  if (d == dim::frequency) return {50.0, 5.0};
  if (d == dim::mass_flow) return {1e-3, 2e-3, 1e-4};
  if (d == dim::mass) return {1e-4, 1e-5};
  if (d == dim::volume) return {1e-13, 1e-12};
  if (d == dim::stiffness) return {1e3, 1e4, 1e2};
  if (d == dim::angle) return {0.2, 1.0};
  if (d == dim::angular_velocity) return {10.0, 100.0, 1000.0};
  if (d == dim::density) return {2000.0, 1.2};
  if (d == dim::pressure) return {100.0, 1e5, 1e7};
  if (d == dim::force) return {1e-5, 1e-3};
  return {1.0, 0.1, 10.0, 1e-3, 1e-6};
}

std::vector<double> allowed_numbers(const Parameter& p) {
  std::vector<double> numbers;
  // J/m2 and N/m are one dimension: the stiffness of a spring and what surfaces hold each other
  // with are told apart by name.
  const bool is_stiffness = p.name.find("stiffness") != std::string::npos;
  const bool is_surface = p.dimension == sdk::dimension::surface_energy && !is_stiffness;
  for (const double v : is_surface ? std::vector<double>{0.05, 0.5} : typical(p.dimension)) {
    if (p.range.contains(v)) numbers.push_back(v);
  }
  if (numbers.empty()) {
    const bool has_both = std::isfinite(p.range.low) && std::isfinite(p.range.high);
    if (has_both) numbers = {0.5 * (p.range.low + p.range.high)};
    if (!has_both && std::isfinite(p.range.low)) numbers = {p.range.low + 1.0, p.range.low * 2.0};
    if (!has_both && std::isfinite(p.range.high)) numbers = {p.range.high - 1.0};
  }
  return numbers;
}

/// The middle of a cube's sides, where openings of sides are shown.
constexpr int k_cube = 4;

/// Corners of a box in the standard scene, flat along `flat` (3 = full), or in the middle of a
/// cube.
Vec3 corner(bool is_upper, int flat) {
  if (flat == k_cube) return is_upper ? Vec3{0.2, 0.2, 0.2} : Vec3{0.1, 0.1, 0.1};
  Vec3 at = is_upper ? Vec3{0.2, 0.011, 0.2} : Vec3{0.1, 0.0, 0.02};
  if (flat < 3) at[flat] = Vec3{0.15, 0.005, 0.1}[flat];
  return at;
}

/// A corner of a box, by its name.
bool is_corner(const Parameter& p) {
  return p.dimension == sdk::dimension::length && (p.name == "min" || p.name == "max");
}

/// Which of the lists that may be left out are there, as bits: none, one, two that belong together
/// (times and factors, diameters and fractions), all. Lists are guessed with one length.
constexpr unsigned k_lists[] = {0b0000, 0b0001, 0b0010, 0b0100, 0b1000, 0b0011,
                                0b0101, 0b0110, 0b1001, 0b1010, 0b1100, 0b1111};
constexpr int k_list_choices = static_cast<int>(std::size(k_lists));
constexpr int k_boxes = 5;
constexpr int k_sizes = 3;
constexpr int k_attempts = k_sizes * k_list_choices * k_boxes;

bool is_list(const Parameter& p) {
  return p.type == ParameterType::numbers || p.type == ParameterType::vectors;
}

/// One guess; attempts differ in the shape of boxes, in which of the lists that may be left out are
/// there (`list` counts them from 1), in sizes; of numbers that may be left out one `is_filled`.
std::optional<Value> guess(const Parameter& p, int attempt, int list, bool is_filled) {
  const int flat = (attempt + 3) % k_boxes;
  const bool fills_list =
      list > 0 && (k_lists[attempt / k_boxes % k_list_choices] >> (list - 1)) & 1u;
  const auto size = static_cast<std::size_t>(attempt / (k_boxes * k_list_choices));
  const std::vector<double> numbers = allowed_numbers(p);
  if (!p.is_required) {
    const bool is_given = is_list(p) ? fills_list : is_filled;
    if (!is_given || numbers.empty()) {
      return p.default_value;
    }
  }
  switch (p.type) {
    case ParameterType::number:
      if (numbers.empty()) return std::nullopt;
      return numbers[size % numbers.size()];
    case ParameterType::integer: {
      const double low = std::isfinite(p.range.low) ? p.range.low : 1.0;
      return static_cast<std::int64_t>(std::min(std::max(low, 2.0), p.range.high));
    }
    case ParameterType::boolean:
      return false;
    case ParameterType::text:
      if (!p.options.empty()) return p.options.front();
      return p.refers == sdk::Refers::nothing ? std::nullopt : std::optional<Value>("sand");
    case ParameterType::texts:
      if (!p.options.empty()) return std::vector<std::string>{p.options.front()};
      return std::vector<std::string>{};
    case ParameterType::vector:
      if (is_corner(p)) return corner(p.name == "max", flat);
      if (p.dimension == sdk::dimension::length) return Vec3{0.15, 0.005, 0.1};
      if (p.dimension == sdk::dimension::none) return Vec3{1.0, 0.0, 0.0};
      return Vec3{0.0, 0.0, -typical(p.dimension).front()};
    case ParameterType::numbers:
      if (numbers.empty()) return std::nullopt;
      if (p.dimension == sdk::dimension::length) return std::vector<double>{3e-4, 6e-4};
      // Ascending: times, edges and sizes are.
      return std::vector<double>{std::min(numbers.front(), numbers.back()),
                                 std::max(numbers.front(), numbers.back())};
    case ParameterType::vectors:
      if (p.dimension == sdk::dimension::length) {
        return std::vector<Vec3>{{0.15, 0.005, 0.1}, {0.12, 0.005, 0.1}};
      }
      if (numbers.empty()) return std::nullopt;
      return std::vector<Vec3>{{0.0, 0.0, -numbers.front()}, {numbers.front(), 0.0, 0.0}};
  }
  return std::nullopt;
}

struct Guess {
  std::vector<Value> values;
  std::string
      missing;  ///< " --set NAME=VALUE (what it is)" of those that nothing can be guessed for
};
Guess guess_all(const sdk::ModelInfo& info, const std::map<std::string, Value>& given, int attempt,
                int filled) {
  Guess all;
  int list = 0;
  for (const Parameter& p : info.parameters) {
    const bool is_filled =
        filled == static_cast<int>(all.values.size()) && p.type == ParameterType::number;
    const bool may_be_empty = is_list(p) && !p.is_required;
    if (may_be_empty) ++list;
    const auto one = given.find(p.name);
    const auto value = one != given.end() ? std::optional<Value>(one->second)
                                          : guess(p, attempt, may_be_empty ? list : 0, is_filled);
    if (!value) {
      all.missing += " --set " + p.name + "=VALUE";
      if (!p.sentence.empty()) all.missing += " (" + p.sentence + ")";
    }
    all.values.push_back(value.value_or(Value{}));
  }
  return all;
}

/// Another corner of a box; the other way round; moved along each axis.
void add_other_vectors(const Parameter& p, Vec3 vector, std::vector<Value>& others) {
  if (is_corner(p) && vector != corner(p.name == "max", 3)) {
    others.emplace_back(corner(p.name == "max", 3));
  }
  others.emplace_back(-vector);
  const bool is_direction = p.dimension == sdk::dimension::none;
  for (const double step : is_direction ? std::vector<double>{1.0} : typical(p.dimension)) {
    for (int d = 0; d < 3; ++d) {
      for (const double sign : {1.0, -1.0}) {
        Vec3 moved = vector;
        moved[d] += sign * step;
        others.emplace_back(moved);
      }
    }
  }
}

}  // namespace

std::vector<Value> default_values(const sdk::ModelInfo& info, const sdk::ModelFactory& factory,
                                  const std::map<std::string, Value>& given,
                                  const std::function<bool(const std::vector<Value>&)>& is_usable) {
  // Showing the scene takes longer than making a model; boxes of every shape are among the first.
  constexpr int k_shown = 3 * k_boxes;
  std::optional<std::vector<Value>> accepted;  // none, or one without parameters
  std::string refusal;
  // First with no number that may be left out, then with one of them at a time (a bridge needs its
  // liquid, by volume or by share).
  const int one_filled = static_cast<int>(info.parameters.size());
  for (int n = 0; n < k_attempts * (1 + one_filled); ++n) {
    if (accepted && n >= k_shown) break;
    const Guess one = guess_all(info, given, n % k_attempts, n / k_attempts - 1);
    if (!one.missing.empty()) {
      throw NotTested(info, "no value can be guessed; write" + one.missing);
    }
    try {
      if (!factory(one.values)) {
        refusal = "the factory gives nothing";
        continue;
      }
    } catch (const std::exception& problem) {
      if (refusal.empty()) refusal = problem.what();
      continue;
    }
    if (is_usable(one.values)) return one.values;
    if (!accepted) accepted = one.values;
  }
  if (accepted) return *accepted;
  throw NotTested(info, "it accepts no values that were tried (" + refusal +
                            "); give some: --set PARAMETER=VALUE");
}

std::vector<Value> other_values(const Parameter& p, const Value& value) {
  std::vector<Value> others;
  if (!p.is_required && value != p.default_value &&
      !std::holds_alternative<std::monostate>(p.default_value)) {
    others.push_back(p.default_value);
  }
  if (const auto* number = std::get_if<double>(&value)) {
    for (const double v : {2.0 * *number, 0.5 * *number, 10.0 * *number, 0.1 * *number}) {
      if (v != *number && p.range.contains(v) && std::isfinite(v)) others.emplace_back(v);
    }
    for (const double v : allowed_numbers(p)) {
      if (v != *number) others.emplace_back(v);
    }
  } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    for (const std::int64_t v : {*integer + 1, *integer - 1, *integer + 5, std::int64_t{1}}) {
      if (v != *integer && p.range.contains(static_cast<double>(v))) others.emplace_back(v);
    }
  } else if (const auto* flag = std::get_if<bool>(&value)) {
    others.emplace_back(!*flag);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    for (const std::string& option : p.options) {
      if (option != *text) others.emplace_back(option);
    }
  } else if (const auto* vector = std::get_if<Vec3>(&value)) {
    add_other_vectors(p, *vector, others);
  } else if (const auto* vectors = std::get_if<std::vector<Vec3>>(&value)) {
    if (!vectors->empty()) {
      std::vector<Vec3> changed = *vectors;
      for (const double factor : {0.5, -1.0}) {
        changed.front() = factor * vectors->front();
        others.emplace_back(changed);
      }
    }
  } else if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    if (!numbers->empty()) {
      std::vector<double> changed = *numbers;
      changed.front() *= 0.5;
      others.emplace_back(changed);
      others.emplace_back(std::vector<double>(numbers->begin(), numbers->end() - 1));
    }
    const std::vector<double> allowed = allowed_numbers(p);
    for (std::size_t count = 1; count <= 3 && !allowed.empty(); ++count) {
      std::vector<double> list;
      for (std::size_t n = 0; n < count; ++n) list.push_back(allowed[n % allowed.size()]);
      others.emplace_back(list);
    }
  }
  return others;
}

}  // namespace dust::contract
