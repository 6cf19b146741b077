// SPDX-License-Identifier: Apache-2.0
#include "study/spec/axes.hpp"

#include "base/text.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"
#include "study/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace dust::study {
namespace {

using scenario::Entry;
using scenario::MapReader;
using scenario::Mark;
using scenario::Node;
using scenario::printable;

/// More levels than any study needs; a slip of the pen like count: 1e9 is told.
constexpr std::int64_t k_max_levels = 10000;

struct SampleBlock {
  std::string method;
  std::int64_t count = 0;
  std::int64_t seed = 1;
  static const sdk::ParameterSchema& schema() {
    static const sdk::ParameterSchema made = [] {
      sdk::SchemaOf<SampleBlock> s;
      s.text(&SampleBlock::method, "method", "How the points are spread.")
          .one_of({"latin_hypercube", "sobol"});
      s.integer(&SampleBlock::count, "count", "Number of points.")
          .at_least(1)
          .at_most(k_max_levels);
      s.integer(&SampleBlock::seed, "seed", "Seed of the spread.").at_least(0).optional();
      return s.build();
    }();
    return made;
  }
};

sdk::Parameter whole_number(const char* name) {
  sdk::Parameter p;
  p.name = name;
  p.type = sdk::ParameterType::integer;
  p.range.low = 1;
  p.range.high = static_cast<double>(k_max_levels);
  return p;
}

}  // namespace

const sdk::ParameterSchema& sample_schema() { return SampleBlock::schema(); }

std::string value_text(const Node& value) {
  if (value.is_text()) return value.text;
  Node map = Node::make_map();
  add(map, "v", value);
  std::string text = scenario::emit_yaml(map);
  text = text.substr(2);
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::vector<Node> with_common_unit(std::vector<Node> values) {
  std::size_t with_unit = 0;
  for (const Node& value : values) {
    std::string ignored;
    const auto number = value.is_text() ? scenario::split_number(value.text, ignored)
                                        : std::optional<scenario::WrittenNumber>{};
    if (!number) return values;
    with_unit += number->unit.empty() ? 0 : 1;
  }
  std::string ignored;
  const auto last = values.empty() ? std::optional<scenario::WrittenNumber>{}
                                   : scenario::split_number(values.back().text, ignored);
  if (with_unit != 1 || !last || last->unit.empty()) return values;
  for (std::size_t n = 0; n + 1 < values.size(); ++n) {
    values[n].text += " " + last->unit;
    // A wrong unit is told once, where it stands.
    values[n].where = values.back().where;
  }
  return values;
}

double AxisReader::Interval::at(double share) const {
  const double value = is_log ? low * std::pow(high / low, share) : low + share * (high - low);
  // Twelve digits: 0.1 + 0.2 shall read 0.3.
  return std::strtod(base::digits_text(value, 12).c_str(), nullptr);
}

Node AxisReader::Interval::node(double share, const Mark& where) const {
  Node node = Node::make_text(scenario::number_text(at(share)) + (unit.empty() ? "" : " " + unit));
  node.where = where;
  return node;
}

void AxisReader::error(const Mark& where, const std::string& text) {
  diagnostics_.error(where, text);
}

bool AxisReader::is_map(const Entry& entry, const char* what) {
  if (!entry.value.is_map()) {
    error(entry.value.where,
          entry.key + ": " + what + " is expected, not " + scenario::kind_text(entry.value));
    return false;
  }
  if (entry.value.entries.empty()) {
    error(entry.value.where, entry.key + ": nothing is given: " + what + " is expected");
    return false;
  }
  return true;
}

std::optional<AxisReader::Interval> AxisReader::interval_of(const Node& node,
                                                            const std::string& path,
                                                            const Mark& where,
                                                            std::int64_t* count) {
  MapReader reader(node, path, where, diagnostics_);
  if (!node.is_map()) return std::nullopt;
  const Entry* from = reader.required("from", "first value");
  const Entry* to = reader.required("to", "last value");
  const Entry* spacing = reader.optional("spacing");
  const Entry* number = count != nullptr ? reader.required("count", "number of values") : nullptr;
  reader.finish();
  if (from == nullptr || to == nullptr || (count != nullptr && number == nullptr)) {
    return std::nullopt;
  }
  if (number != nullptr) {
    const auto value =
        scenario::read_value(number->value, whole_number("count"), path + ".count", diagnostics_);
    if (!value) return std::nullopt;
    *count = std::get<std::int64_t>(*value);
  }
  Interval interval;
  std::string units[2];
  int k = 0;
  for (const Entry* end : {from, to}) {
    std::string why = "a number is expected, not " + scenario::kind_text(end->value);
    std::optional<scenario::WrittenNumber> written;
    if (end->value.is_text()) written = scenario::split_number(end->value.text, why);
    if (!written) {
      error(end->value.where, path + "." + end->key + ": " + why);
      return std::nullopt;
    }
    (k == 0 ? interval.low : interval.high) = written->number;
    units[k++] = written->unit;
  }
  if (!units[0].empty() && units[0] != units[1]) {
    error(to->value.where, path + ": write both ends in one unit");
    return std::nullopt;
  }
  interval.unit = units[1];
  if (spacing != nullptr) {
    if (!spacing->value.is_word("log") && !spacing->value.is_word("linear")) {
      error(spacing->value.where, path + ".spacing: one of linear, log is expected");
      return std::nullopt;
    }
    interval.is_log = spacing->value.is_word("log");
  }
  if (interval.is_log && !(interval.low > 0.0 && interval.high > 0.0)) {
    error(spacing->value.where, path + ".spacing: log needs both ends above 0");
    return std::nullopt;
  }
  return interval;
}

std::vector<Node> AxisReader::levels_of(const Entry& entry, const std::string& path) {
  const Node& value = entry.value;
  if (value.is_list()) {
    if (value.items.empty()) {
      error(value.where, path + ": the list is empty: give at least one value");
    }
    return with_common_unit(value.items);
  }
  if (value.is_map()) {
    std::int64_t count = 0;
    const auto interval = interval_of(value, path, entry.where, &count);
    std::vector<Node> levels;
    for (std::int64_t n = 0; interval && n < count; ++n) {
      const double share =
          count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0.0;
      levels.push_back(interval->node(share, value.where));
    }
    return levels;
  }
  error(value.where, path + ": a list of values or {from, to, count} is expected, not " +
                         scenario::kind_text(value));
  return {};
}

void AxisReader::read_values(const Entry& entry, std::vector<Axis>& axes) {
  if (!is_map(entry, "a map of paths and values")) return;
  for (const Entry& one : entry.value.entries) {
    Axis axis{AxisKind::values, {one.key}, {}, one.where};
    for (const Node& value : levels_of(one, "vary." + printable(one.key))) {
      axis.levels.push_back({"", {{one.key, value, one.where}}, value.where});
    }
    if (!axis.levels.empty()) axes.push_back(std::move(axis));
  }
}

void AxisReader::read_one_zip(const Node& map, const Mark& where, std::vector<Axis>& axes) {
  Axis axis{AxisKind::zipped, {}, {}, where};
  for (const Entry& one : map.entries) {
    const std::string path = "zip." + printable(one.key);
    const std::vector<Node> values = levels_of(one, path);
    if (values.empty()) return;
    if (axis.paths.empty()) axis.levels.resize(values.size());
    if (values.size() != axis.levels.size()) {
      error(one.value.where, path + ": " + std::to_string(values.size()) +
                                 " values stand beside the " + std::to_string(axis.levels.size()) +
                                 " of " + printable(axis.paths.front()));
      return;
    }
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (axis.paths.empty()) axis.levels[n].where = values[n].where;
      axis.levels[n].settings.push_back({one.key, values[n], one.where});
    }
    axis.paths.push_back(one.key);
  }
  axes.push_back(std::move(axis));
}

void AxisReader::read_zip(const Entry& entry, std::vector<Axis>& axes) {
  if (!entry.value.is_list()) {
    if (is_map(entry, "a map of paths and lists of values")) {
      read_one_zip(entry.value, entry.where, axes);
    }
    return;
  }
  if (entry.value.items.empty()) error(entry.value.where, "zip: the list is empty");
  for (const Node& map : entry.value.items) {
    Entry one{"zip", map.where, map};
    if (is_map(one, "a map of paths and lists of values")) read_one_zip(map, map.where, axes);
  }
}

bool AxisReader::add_case(const std::string& name, const Node& settings, const Mark& where,
                          Axis& axis) {
  if (!settings.is_map() && settings.kind != Node::Kind::nothing) {
    error(settings.where, "cases." + printable(name) +
                              ": a map of paths and values is expected, not " +
                              scenario::kind_text(settings));
    return false;
  }
  for (const Level& level : axis.levels) {
    if (level.label != name) continue;
    error(where, "cases: two points are called '" + printable(name) + "'; the first stands in " +
                     "line " + std::to_string(level.where.line));
    return false;
  }
  Level level{name, {}, where};
  for (const Entry& one : settings.entries) {
    level.settings.push_back({one.key, one.value, one.where});
  }
  axis.levels.push_back(std::move(level));
  return true;
}

void AxisReader::read_cases(const Entry& entry, std::vector<Axis>& axes) {
  Axis axis{AxisKind::cases, {}, {}, entry.where};
  if (entry.value.is_list()) {
    if (entry.value.items.empty()) error(entry.value.where, "cases: the list is empty");
    for (std::size_t n = 0; n < entry.value.items.size(); ++n) {
      const Node& item = entry.value.items[n];
      MapReader reader(item, "cases[" + std::to_string(n) + "]", item.where, diagnostics_);
      if (!item.is_map()) continue;
      const Entry* name = reader.required("name", "what the point is called");
      const Entry* set = reader.optional("set");
      reader.finish();
      if (name == nullptr) continue;
      Node nothing;
      add_case(name->value.text, set != nullptr ? set->value : nothing, name->value.where, axis);
    }
  } else if (is_map(entry, "a map of names and what they set")) {
    for (const Entry& one : entry.value.entries) add_case(one.key, one.value, one.where, axis);
  }
  if (!axis.levels.empty()) axes.push_back(std::move(axis));
}

void AxisReader::read_sample(const Entry& entry, std::vector<Axis>& axes) {
  MapReader reader(entry.value, "sample", entry.where, diagnostics_);
  if (!entry.value.is_map()) return;
  const std::size_t errors = diagnostics_.error_count();
  const auto values = reader.values(SampleBlock::schema());
  const auto block = sdk::parameters_from<SampleBlock>(SampleBlock::schema(), values);
  const Entry* over = reader.required("over", "a map of paths and {from, to}");
  reader.finish();
  if (over == nullptr || !is_map(*over, "a map of paths and {from, to}")) return;
  Axis axis{AxisKind::samples, {}, {}, entry.where};
  std::vector<Interval> intervals;
  for (const Entry& one : over->value.entries) {
    const auto interval =
        interval_of(one.value, "sample.over." + printable(one.key), one.where, nullptr);
    if (!interval) continue;
    axis.paths.push_back(one.key);
    intervals.push_back(*interval);
  }
  if (diagnostics_.error_count() > errors) return;
  const auto count = static_cast<std::size_t>(block.count);
  const auto seed = static_cast<std::uint64_t>(block.seed);
  if (block.method == "sobol" && intervals.size() > k_max_sobol_dimensions) {
    error(over->where, "sample.over: sobol covers at most " +
                           std::to_string(k_max_sobol_dimensions) + " paths; take latin_hypercube");
    return;
  }
  const Sample sample = block.method == "sobol" ? sobol(count, intervals.size(), seed)
                                                : latin_hypercube(count, intervals.size(), seed);
  for (const auto& point : sample) {
    Level level{"", {}, entry.where};
    for (std::size_t d = 0; d < intervals.size(); ++d) {
      const Entry& one = over->value.entries[d];
      level.settings.push_back({one.key, intervals[d].node(point[d], one.value.where), one.where});
    }
    axis.levels.push_back(std::move(level));
  }
  axes.push_back(std::move(axis));
}

}  // namespace dust::study
