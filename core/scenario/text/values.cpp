// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/values.hpp"

#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace dust::scenario {
namespace {

using sdk::Parameter;
using sdk::ParameterType;
using sdk::Value;

/// Reads one parameter; every failure is told with the path in front.
class ValueReader {
 public:
  ValueReader(const Parameter& parameter, const std::string& path, Diagnostics& diagnostics)
      : parameter_(parameter), path_(path), diagnostics_(diagnostics) {}

  std::optional<Value> read(const Node& node) {
    switch (parameter_.type) {
      case ParameterType::number:
        return number(node);
      case ParameterType::integer:
        return integer(node);
      case ParameterType::boolean:
        return boolean(node);
      case ParameterType::text:
        return text(node);
      case ParameterType::vector:
        return vector(node);
      case ParameterType::numbers:
        return numbers(node);
      case ParameterType::texts:
        return texts(node);
      case ParameterType::vectors:
        return vectors(node);
    }
    return std::nullopt;
  }

 private:
  std::nullopt_t fail(const Node& node, const std::string& text) {
    diagnostics_.error(node.where, path_ + ": " + text);
    return std::nullopt;
  }
  std::string expected() const {
    if (parameter_.dimension == sdk::dimension::none) return "a number";
    return dimension_name(parameter_.dimension) + " (" + example_units(parameter_.dimension) + ")";
  }

  /// Infinite values stand only for "no limit" and only where that is the default.
  bool may_be_infinite() const {
    const auto infinite = [](double v) { return std::isinf(v); };
    if (const auto* v = std::get_if<double>(&parameter_.default_value)) return infinite(*v);
    if (const auto* v = std::get_if<sdk::Vec3>(&parameter_.default_value)) {
      return infinite(v->x) || infinite(v->y) || infinite(v->z);
    }
    return false;
  }
  std::optional<WrittenNumber> written(const Node& node) {
    if (!node.is_text()) {
      return fail(node, expected() + " is expected, not " + kind_text(node));
    }
    if (may_be_infinite() && (node.text == ".inf" || node.text == "-.inf")) {
      const double infinity = std::numeric_limits<double>::infinity();
      return WrittenNumber{node.text[0] == '-' ? -infinity : infinity, {}};
    }
    if (node.text == ".nan" || node.text == ".inf" || node.text == "-.inf" ||
        node.text == "+.inf" || node.text == "nan" || node.text == "inf" || node.text == "-inf") {
      return fail(node, printable(node.text) + " is not a finite number");
    }
    std::string error;
    auto result = split_number(node.text, error);
    if (!result) {
      if (error.starts_with("a number is expected")) error.replace(0, 8, expected());
      return fail(node, error);
    }
    return result;
  }
  std::optional<double> si(const Node& node, const WrittenNumber& number) {
    std::string error;
    const auto value = to_si(number, parameter_.dimension, error);
    if (!value) return fail(node, error);
    return value;
  }
  bool in_range(const Node& node, double value) {
    if (parameter_.range.contains(value)) {
      if (!parameter_.usual.contains(value)) warn_of_unusual(node);
      return true;
    }
    fail(node, printable(node.text) + " is outside " + range_text(parameter_) + degrees(node));
    return false;
  }
  void warn_of_unusual(const Node& node) {
    const bool has_unit = parameter_.dimension != sdk::dimension::none;
    diagnostics_.warning(node.where, path_ + ": " + printable(node.text) +
                                         " is far from what is usual, " + usual_text(parameter_) +
                                         ": " + (has_unit ? "is its unit right?" : "is it meant?"));
  }
  /// What a bare number that is too large for an angle is mostly meant to be.
  std::string degrees(const Node& node) const {
    constexpr double k_degree = std::numbers::pi / 180.0;
    if (parameter_.dimension != sdk::dimension::angle || !node.is_text()) return {};
    std::string error;
    const auto bare = split_number(node.text, error);
    if (!bare || !bare->unit.empty() || std::abs(bare->number) < std::numbers::pi) return {};
    if (!parameter_.range.contains(k_degree * bare->number)) return {};
    return ": a bare number is in rad; is '" + printable(node.text) + " deg' meant?";
  }

  std::optional<Value> number(const Node& node) {
    const auto w = written(node);
    if (!w) return std::nullopt;
    const auto value = si(node, *w);
    if (!value) return std::nullopt;
    if (Value(*value) != parameter_.default_value && !in_range(node, *value)) return std::nullopt;
    return *value;
  }

  std::optional<Value> integer(const Node& node) {
    if (!node.is_text()) return fail(node, "a whole number is expected, not " + kind_text(node));
    std::string error;
    const auto w = split_number(node.text, error);
    if (!w || !w->unit.empty()) {
      return fail(
          node, w ? "a whole number without a unit is expected, not '" + printable(node.text) + "'"
                  : error);
    }
    std::int64_t value = 0;
    const char* begin = node.text.data() + (node.text.starts_with('+') ? 1 : 0);
    const auto [end, code] = std::from_chars(begin, node.text.data() + node.text.size(), value);
    if (code != std::errc{} || end != node.text.data() + node.text.size()) {
      return fail(node, "a whole number is expected, not '" + printable(node.text) + "'");
    }
    if (Value(value) != parameter_.default_value && !in_range(node, static_cast<double>(value))) {
      return std::nullopt;
    }
    return value;
  }

  std::optional<Value> boolean(const Node& node) {
    if (node.is_word("true")) return true;
    if (node.is_word("false")) return false;
    std::string word = node.is_text() ? node.text : std::string();
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* yes : {"yes", "on", "y", "true", "1"}) {
      if (word == yes)
        return fail(node, "'" + printable(node.text) + "' is not true or false: write true");
    }
    for (const char* no : {"no", "off", "n", "false", "0"}) {
      if (word == no)
        return fail(node, "'" + printable(node.text) + "' is not true or false: write false");
    }
    return fail(node, "true or false is expected, not " + kind_text(node));
  }

  bool check_option(const Node& node) {
    const auto& options = parameter_.options;
    if (options.empty() || std::find(options.begin(), options.end(), node.text) != options.end()) {
      return true;
    }
    const std::string near = nearest(node.text, options);
    fail(node, "'" + printable(node.text) + "' is none of " + listed(options) +
                   (near.empty() ? "" : "; did you mean '" + near + "'?"));
    return false;
  }
  std::optional<Value> text(const Node& node) {
    if (!node.is_text()) {
      return fail(node, (parameter_.options.empty()
                             ? std::string("a text is expected")
                             : "one of " + listed(parameter_.options) + " is expected") +
                            ", not " + kind_text(node));
    }
    if (!check_option(node)) return std::nullopt;
    return node.text;
  }

  /// Where units are missing in a list: the first component with a unit where few have one, else
  /// the first without. Zeros need none.
  static std::optional<std::size_t> odd_one_out(const std::vector<WrittenNumber>& all,
                                                std::size_t with_unit) {
    const auto lacks = [](const WrittenNumber& w) { return w.unit.empty() && w.number != 0.0; };
    const auto lacking = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), lacks));
    if (lacking == 0) return std::nullopt;
    // Of three, two without a unit may be either mistake; of many, a few with one are the odd ones.
    const bool is_unit_odd = with_unit * 3 < lacking;
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (is_unit_odd ? !all[n].unit.empty() : lacks(all[n])) return n;
    }
    return std::nullopt;
  }

  /// Components of a list in SI. A unit on the last one alone holds for all.
  std::optional<std::vector<double>> components(const Node& node) {
    std::vector<WrittenNumber> all;
    bool is_good = true;
    for (const Node& item : node.items) {
      const auto w = written(item);
      is_good = is_good && w;
      all.push_back(w.value_or(WrittenNumber{}));
    }
    if (!is_good) return std::nullopt;
    const auto with_unit = static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [](const WrittenNumber& w) { return !w.unit.empty(); }));
    if (with_unit == 1 && !all.back().unit.empty()) {
      for (WrittenNumber& w : all) w.unit = all.back().unit;
    } else if (with_unit > 0 && with_unit < all.size()) {
      if (const auto odd = odd_one_out(all, with_unit)) {
        return fail(node.items[*odd],
                    "'" + printable(node.items[*odd].text) +
                        (all[*odd].unit.empty() ? "' has no unit but others have"
                                                : "' has a unit but most others have none") +
                        ": give each one its unit, or the last alone one for all");
      }
    }
    std::vector<double> values;
    for (std::size_t n = 0; n < all.size(); ++n) {
      const auto value = si(with_unit == 1 ? node.items.back() : node.items[n], all[n]);
      is_good = is_good && value;
      // One wrong unit on the last component is one mistake, not three.
      if (!value && with_unit == 1) return std::nullopt;
      values.push_back(value.value_or(0.0));
    }
    return is_good ? std::optional(values) : std::nullopt;
  }
  bool all_in_range(const Node& node, const std::vector<double>& values) {
    bool is_good = true;
    for (std::size_t n = 0; n < values.size(); ++n) {
      is_good = in_range(node.items[n], values[n]) && is_good;
    }
    return is_good;
  }
  std::optional<Value> vector(const Node& node) {
    if (!node.is_list() || node.items.size() != 3) {
      return fail(node, "a vector [x, y, z] is expected, not " +
                            (node.is_list() ? "a list of " + std::to_string(node.items.size())
                                            : kind_text(node)));
    }
    const auto values = components(node);
    if (!values) return std::nullopt;
    const sdk::Vec3 v{(*values)[0], (*values)[1], (*values)[2]};
    if (Value(v) != parameter_.default_value && !all_in_range(node, *values)) return std::nullopt;
    return v;
  }
  /// What to write in place of nothing.
  [[nodiscard]] std::string empty_list() const {
    std::string text = "the list is empty: give at least one";
    if (!parameter_.options.empty()) text += " of " + listed(parameter_.options);
    if (parameter_.is_required) return text;
    text += ", or leave '" + parameter_.name + "' out";
    const auto* usual = std::get_if<std::vector<std::string>>(&parameter_.default_value);
    return usual == nullptr || usual->empty() ? text : text + ", which means " + listed(*usual);
  }
  std::optional<Value> numbers(const Node& node) {
    if (!node.is_list()) {
      return fail(node, "a list like [1, 2, 3" +
                            (parameter_.dimension == sdk::dimension::none
                                 ? std::string()
                                 : " " + si_unit(parameter_.dimension)) +
                            "] is expected, not " + kind_text(node));
    }
    const auto values = components(node);
    if (!values) return std::nullopt;
    const bool is_default = Value(*values) == parameter_.default_value;
    if (values->empty() && !is_default) return fail(node, empty_list());
    if (!is_default && !all_in_range(node, *values)) return std::nullopt;
    return *values;
  }
  std::optional<Value> texts(const Node& node) {
    if (!node.is_list()) {
      return fail(node, "a list like [a, b] is expected, not " + kind_text(node));
    }
    std::vector<std::string> values;
    bool is_good = true;
    for (const Node& item : node.items) {
      if (!item.is_text()) {
        fail(item, "a text is expected, not " + kind_text(item));
        is_good = false;
        continue;
      }
      is_good = check_option(item) && is_good;
      values.push_back(item.text);
    }
    if (!is_good) return std::nullopt;
    if (values.empty() && Value(values) != parameter_.default_value) {
      return fail(node, empty_list());
    }
    return values;
  }

  std::optional<Value> vectors(const Node& node) {
    if (!node.is_list()) {
      return fail(node, "a list of vectors [[x, y, z], ...] is expected, not " + kind_text(node));
    }
    std::vector<sdk::Vec3> values;
    bool is_good = true;
    for (const Node& item : node.items) {
      const auto value = vector(item);
      is_good = is_good && value;
      values.push_back(value ? std::get<sdk::Vec3>(*value) : sdk::Vec3{});
    }
    if (!is_good) return std::nullopt;
    if (values.empty() && Value(values) != parameter_.default_value) {
      return fail(node, empty_list());
    }
    return values;
  }

  const Parameter& parameter_;
  const std::string& path_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Value> read_value(const Node& node, const Parameter& parameter,
                                const std::string& path, Diagnostics& diagnostics) {
  return ValueReader(parameter, path, diagnostics).read(node);
}

MapReader::MapReader(const Node& node, std::string path, Mark where, Diagnostics& diagnostics,
                     std::string whole, Of of)
    : node_(node),
      path_(std::move(path)),
      where_(std::move(where)),
      diagnostics_(diagnostics),
      whole_(std::move(whole)) {
  if (node_.is_map()) return;
  is_good_ = false;
  const bool is_name = of == Of::model && node_.is_text() && !node_.is_word("none");
  diagnostics_.error(node_.where,
                     path_ + ": a map of keys is expected, not " + kind_text(node_) +
                         (is_name ? ": write {model: " + printable(node_.text) + "}" : ""));
}

const Entry* MapReader::optional(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return node_.find(key);
}

const Entry* MapReader::required(const std::string& key, const std::string& what) {
  const Entry* entry = optional(key);
  if (entry == nullptr && node_.is_map()) {
    diagnostics_.error(where_, (path_.empty() ? "" : path_ + ": ") + "missing key '" + key + "'" +
                                   (what.empty() ? "" : " (" + what + ")"));
  }
  if (entry == nullptr) is_good_ = false;
  return entry;
}

std::vector<Value> MapReader::values(const sdk::ParameterSchema& schema) {
  std::vector<Value> result;
  for (const Parameter& parameter : schema) {
    const std::string unit = si_unit(parameter.dimension);
    const Entry* entry = parameter.is_required
                             ? required(parameter.name, type_text(parameter.type) +
                                                            (unit.empty() ? "" : " in " + unit) +
                                                            ": " + parameter.sentence)
                             : optional(parameter.name);
    if (entry == nullptr) {
      result.push_back(parameter.default_value);
      continue;
    }
    diagnostics_.note_dimension(path_of(parameter.name), parameter.dimension);
    auto value = read_value(entry->value, parameter, path_of(parameter.name), diagnostics_);
    if (!value) is_good_ = false;
    result.push_back(value.value_or(Value{}));
  }
  warn_of_bare_numbers(schema);
  return result;
}

namespace {

/// The unit of the numbers of a node, "" where all are bare; `largest`: the largest bare number.
std::string unit_in(const Node& node, double& largest) {
  std::string unit;
  const std::vector<Node> one{node};
  for (const Node& item : node.is_list() ? node.items : one) {
    if (item.is_list()) {
      const std::string inner = unit_in(item, largest);
      if (!inner.empty()) unit = inner;
      continue;
    }
    std::string error;
    const auto number = item.is_text() ? split_number(item.text, error) : std::nullopt;
    if (!number) continue;
    if (!number->unit.empty()) unit = number->unit;
    if (std::abs(number->number) > std::abs(largest)) largest = number->number;
  }
  return unit;
}

/// What is none is told by the value it stands behind.
bool is_unit_of(const std::string& unit, sdk::Dimension dimension) {
  const auto parsed = unit.empty() ? std::nullopt : parse_unit(unit);
  return parsed && parsed->dimension == dimension;
}

}  // namespace

std::string likely_unit(sdk::Dimension dimension, double value) {
  constexpr double k_sure_length = 10.0;
  const double size = std::abs(value);
  if (dimension == sdk::dimension::length) {
    return size >= k_sure_length || (size >= 1.0 && size == std::floor(size)) ? "mm" : "";
  }
  if (dimension == sdk::dimension::angle && size > 2.0 * std::numbers::pi) return "deg";
  return "";
}

/// `max: [330, 11, 350]` is a domain of 330 m, `min: [-20, -20, 0]` beside `max: [20, 20, 60 mm]`
/// reaches over 20 m: hardly meant.
void MapReader::warn_of_bare_numbers(const sdk::ParameterSchema& schema) {
  for (const Parameter& parameter : schema) {
    const std::string si = si_unit(parameter.dimension);
    const Entry* entry = node_.is_map() ? node_.find(parameter.name) : nullptr;
    if (entry == nullptr || si.empty()) continue;
    if (diagnostics_.is_resolved_file(entry->value.where.file)) continue;
    if (parameter.type == ParameterType::vectors) {
      warn_of_bare_vector(entry->value, parameter);
    }
    double largest = 0.0;
    if (!unit_in(entry->value, largest).empty() || largest == 0.0) continue;
    if (parameter.type == ParameterType::vector && warn_of_bare_neighbour(schema, parameter)) {
      continue;
    }
    const std::string likely = likely_unit(parameter.dimension, largest);
    if (likely.empty()) continue;
    const std::string number = number_text(largest);
    diagnostics_.warning(entry->value.where, path_of(parameter.name) + ": " + number +
                                                 " has no unit and is read as " + number + " " +
                                                 si + ": write " + number + " " + likely + " or " +
                                                 number + " " + si);
  }
}

/// In a list of vectors each has a unit of its own: `[[10, 10, 5], [30, 10, 5 mm]]` begins 10 m
/// off.
void MapReader::warn_of_bare_vector(const Node& vectors, const Parameter& parameter) {
  const std::string path = path_of(parameter.name);
  const std::string si = si_unit(parameter.dimension);
  std::size_t bare = vectors.items.size();
  std::size_t other = vectors.items.size();
  std::string unit;
  for (std::size_t n = vectors.items.size(); n-- > 0;) {
    double largest = 0.0;
    const std::string own = unit_in(vectors.items[n], largest);
    if (own.empty() && largest != 0.0) bare = n;
    if (own == si || !is_unit_of(own, parameter.dimension)) continue;
    other = n;
    unit = own;
  }
  if (bare == vectors.items.size() || unit.empty()) return;
  diagnostics_.warning(vectors.items[bare].where,
                       path + "[" + std::to_string(bare) + "]: has no unit and is read in " + si +
                           ", while " + path + "[" + std::to_string(other) + "] is in " + unit +
                           ": write " + unit + " or " + si + " behind its last number");
}

/// Reported where another vector of the same map has a unit.
bool MapReader::warn_of_bare_neighbour(const sdk::ParameterSchema& schema,
                                       const Parameter& parameter) {
  const std::string si = si_unit(parameter.dimension);
  for (const Parameter& other : schema) {
    const Entry* beside = node_.find(other.name);
    if (beside == nullptr || other.type != ParameterType::vector) continue;
    double ignored = 0.0;
    const std::string unit = unit_in(beside->value, ignored);
    if (!(other.dimension == parameter.dimension) || unit == si) continue;
    if (!is_unit_of(unit, parameter.dimension)) continue;
    diagnostics_.warning(node_.find(parameter.name)->value.where,
                         path_of(parameter.name) + ": has no unit and is read in " + si +
                             ", while " + path_of(other.name) + " is in " + unit + ": write " +
                             unit + " or " + si + " behind its last number");
    return true;
  }
  return false;
}

void MapReader::finish() {
  for (const Entry& entry : node_.entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    if (is_open_ && nearest(entry.key, known_).empty()) continue;
    if (entry.is_of_other_model) continue;
    diagnostics_.error(entry.where, "unknown key '" + printable(entry.key) + "' in " +
                                        (path_.empty() ? whole_ : path_) +
                                        suggestion(entry.key, known_, "its keys are"));
  }
}

}  // namespace dust::scenario
