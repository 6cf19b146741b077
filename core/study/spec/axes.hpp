// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"
#include "study/spec/spec.hpp"

#include <string>
#include <vector>

namespace dust::study {

/// A value on one line, as it is written.
std::string value_text(const scenario::Node& value);

/// What `sample` declares besides the intervals `over` which it spreads.
const sdk::ParameterSchema& sample_schema();

/// Reads what is varied into axes with their levels; an axis with a problem is left out.
class AxisReader {
 public:
  explicit AxisReader(scenario::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// `vary: {PATH: [levels], PATH: {from, to, count}}`: one axis each.
  void read_values(const scenario::Entry& entry, std::vector<Axis>& axes);
  /// `zip: {PATH: [levels], PATH: [as many]}`, or a list of such maps: one axis each.
  void read_zip(const scenario::Entry& entry, std::vector<Axis>& axes);
  /// `cases: {NAME: {PATH: value, ...}}`, or `[{name: NAME, set: {...}}]`: one axis.
  void read_cases(const scenario::Entry& entry, std::vector<Axis>& axes);
  /// `sample: {method, count, seed, over: {PATH: {from, to}}}`: one axis.
  void read_sample(const scenario::Entry& entry, std::vector<Axis>& axes);

 private:
  struct Interval {
    double low = 0.0;
    double high = 0.0;
    std::string unit;
    bool is_log = false;
    [[nodiscard]] double at(double share) const;
    [[nodiscard]] scenario::Node node(double share, const scenario::Mark& where) const;
  };
  void error(const scenario::Mark& where, const std::string& text);
  bool is_map(const scenario::Entry& entry, const char* what);
  std::vector<scenario::Node> levels_of(const scenario::Entry& entry, const std::string& path);
  std::optional<Interval> interval_of(const scenario::Node& node, const std::string& path,
                                      const scenario::Mark& where, std::int64_t* count);
  void read_one_zip(const scenario::Node& map, const scenario::Mark& where,
                    std::vector<Axis>& axes);
  bool add_case(const std::string& name, const scenario::Node& settings,
                const scenario::Mark& where, Axis& axis);

  scenario::Diagnostics& diagnostics_;
};

}  // namespace dust::study
