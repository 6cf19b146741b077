// SPDX-License-Identifier: Apache-2.0
#include "contract/contract.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "contract/as_kind.hpp"
#include "contract/input/default_values.hpp"
#include "contract/rule_runner.hpp"
#include "registry/crash_notice.hpp"
#include "registry/guard_report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace dust::contract {
namespace {

using sdk::Value;

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Name of the first reading that differs with both answers, "" if none does.
std::string first_difference(const Observations& a, const Observations& b) {
  constexpr int k_all_digits = 17;
  if (a.size() != b.size()) {
    return "the number of results (" + std::to_string(a.size()) + ", " + std::to_string(b.size()) +
           ")";
  }
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (a[n].name != b[n].name) return a[n].name + " (once '" + b[n].name + "')";
    if (is_same(a[n].value, b[n].value)) continue;
    return a[n].name + " (" + base::digits_text(a[n].value, k_all_digits) + ", " +
           base::digits_text(b[n].value, k_all_digits) + ")";
  }
  return {};
}

/// The numbers of a value; none of a text.
std::vector<double> numbers_of(const Value& value) {
  if (const auto* v = std::get_if<double>(&value)) return {*v};
  if (const auto* v = std::get_if<std::int64_t>(&value)) return {static_cast<double>(*v)};
  if (const auto* v = std::get_if<sdk::Vec3>(&value)) return {v->x, v->y, v->z};
  if (const auto* v = std::get_if<std::vector<double>>(&value)) return *v;
  return {};
}

/// A parameter that can have no value, or not the one that it has unless given.
void check_range(const sdk::Parameter& p) {
  const sdk::Range& range = p.range;
  const bool is_point = range.low == range.high && !range.low_is_open && !range.high_is_open;
  const std::string name = "the parameter '" + p.name + "'";
  const std::string ends =
      std::string(range.low_is_open ? "above " : "at least ") + base::digits_text(range.low, 6) +
      " and " + (range.high_is_open ? "below " : "at most ") + base::digits_text(range.high, 6);
  require(range.low < range.high || is_point, name + " can have no value: " + ends);
  for (const double v : numbers_of(p.default_value)) {
    require(range.contains(v), "the default of " + name.substr(4) + ", " + base::digits_text(v, 6) +
                                   ", is outside its own range: " + ends);
  }
  for (const double end : {p.usual.low, p.usual.high}) {
    require(!std::isfinite(end) || range.contains(end) || end == range.low || end == range.high,
            "what is usual of " + name.substr(4) + ", " + base::digits_text(end, 6) +
                ", is outside its range: " + ends);
  }
  const auto* text = std::get_if<std::string>(&p.default_value);
  require(text == nullptr || text->empty() || p.options.empty() ||
              std::find(p.options.begin(), p.options.end(), *text) != p.options.end(),
          "the default of " + name.substr(4) + ", '" + (text != nullptr ? *text : std::string()) +
              "', is none of its options");
}

void check_description(const sdk::ModelInfo& info) {
  require(!info.equation.empty(), "it has no equation");
  require(!info.source.empty(), "it has no source: author, year, or \"own definition\"");
  require(!info.version.empty(), "it has no version");
  for (const sdk::Parameter& p : info.parameters) {
    require(!p.sentence.empty() && p.sentence.back() == '.',
            "the sentence of '" + p.name + "' does not end with a full stop");
    check_range(p);
  }
}

/// The most any number of a group is: components of one result are judged by the largest of them.
std::map<std::string, double> sizes(const Observations& observations) {
  std::map<std::string, double> largest;
  for (const Observation& r : observations) {
    double& size = largest[r.name.substr(0, r.name.find(' '))];
    size = std::max(size, std::abs(r.value));
  }
  return largest;
}

void check_units(const Kind& kind, const Maker& make) {
  // Roots and powers of other numbers round differently; a wrong exponent is off by a factor of 2.
  constexpr double k_rounding = 1e-6;
  const Observations here = kind.observe(make, {});
  const Observations there = kind.observe(make, {.units = kind.other_units});
  require(here.size() == there.size(),
          "the number of results depends on the units: " + std::to_string(here.size()) + ", and " +
              std::to_string(there.size()) +
              " where everything is given in others; a number has a hidden unit");
  const auto largest = sizes(here);
  for (std::size_t n = 0; n < here.size(); ++n) {
    if (!here[n].has_dimension) continue;
    const double back = there[n].value / kind.other_units.of(here[n].dimension);
    const double size = largest.at(here[n].name.substr(0, here[n].name.find(' ')));
    require(std::abs(back - here[n].value) <= k_rounding * size,
            here[n].name + " is " + std::to_string(back / here[n].value) +
                " times as large when everything is given in other units: a number with a hidden "
                "unit, or a parameter declared with the wrong dimension");
  }
}

/// What the model gives in the kind's scene with these values.
Observations observe_with(const Kind& kind, const registry::Entry& entry,
                          const std::vector<Value>& values) {
  return kind.observe(
      [&](const Units& units) {
        return entry.factory(in_units(units, entry.info.parameters, values));
      },
      {});
}

/// Tries other values of the parameters of one model.
class Variation {
 public:
  Variation(const Kind& kind, const registry::Entry& entry, std::vector<Value> values,
            const Options& options)
      : kind_(kind), entry_(entry), values_(std::move(values)) {
    for (std::size_t n = 0; n < values_.size(); ++n) {
      const sdk::Parameter& p = entry.info.parameters[n];
      const auto given = options.others.find(p.name);
      others_.push_back(given != options.others.end() ? std::vector<Value>{given->second}
                                                      : other_values(p, values_[n]));
    }
  }
  [[nodiscard]] bool is_open(std::size_t n) const { return !others_[n].empty(); }

  /// Whether another value of parameter n changes what the model gives, by itself or beside another
  /// value of one other parameter (a limit that is switched off, one list in place of another).
  [[nodiscard]] bool matters(std::size_t n) const {
    const auto base = observe(values_);
    for (const Value& other : others_[n]) {
      if (differs(base, with(values_, n, other))) return true;
    }
    constexpr std::size_t k_few = 4;
    for (std::size_t m = 0; m < values_.size(); ++m) {
      for (std::size_t b = 0; m != n && b < std::min(k_few, others_[m].size()); ++b) {
        const auto beside = with(values_, m, others_[m][b]);
        const auto without = observe(beside);
        for (std::size_t a = 0; a < std::min(k_few, others_[n].size()); ++a) {
          if (differs(without, with(beside, n, others_[n][a]))) return true;
        }
      }
    }
    return false;
  }
  /// Why no other value of parameter n is accepted by itself; empty where one is.
  [[nodiscard]] std::string refusal(std::size_t n) const {
    std::string why;
    for (const Value& other : others_[n]) {
      try {
        (void)observe_with(kind_, entry_, with(values_, n, other));
        return {};
      } catch (const std::exception& problem) {
        if (why.empty()) why = problem.what();
      }
    }
    return why;
  }
  /// Whether another whole set of values, with another value of parameter n, gives something else:
  /// the only way to try a choice that brings parameters of its own.
  [[nodiscard]] bool matters_beside(const Variation& other, std::size_t n) const {
    if (values_[n] == other.values_[n]) return false;
    const auto mine = observe(values_);
    const auto theirs = other.observe(other.values_);
    return mine && theirs && !first_difference(*mine, *theirs).empty();
  }

 private:
  /// Nothing where the values contradict each other.
  [[nodiscard]] std::optional<Observations> observe(const std::vector<Value>& values) const {
    try {
      return observe_with(kind_, entry_, values);
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }
  [[nodiscard]] bool differs(const std::optional<Observations>& base,
                             const std::vector<Value>& values) const {
    const auto observations = observe(values);
    return observations && (!base || !first_difference(*base, *observations).empty());
  }
  static std::vector<Value> with(std::vector<Value> values, std::size_t n, const Value& value) {
    values[n] = value;
    return values;
  }

  const Kind& kind_;
  const registry::Entry& entry_;
  std::vector<Value> values_;
  std::vector<std::vector<Value>> others_;
};

/// The values that a model is tried with: usable in the kind's scene, where some are.
std::vector<Value> values_in_scene(const registry::Entry& entry, const Kind* kind,
                                   const std::map<std::string, Value>& given) {
  return default_values(entry.info, entry.factory, given, [&](const std::vector<Value>& values) {
    if (kind == nullptr) return true;
    try {
      (void)observe_with(*kind, entry, values);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  });
}

void check_parameters(const Kind& kind, const registry::Entry& entry,
                      const std::vector<Value>& values, const Maker& make, const Options& options) {
  std::vector<Variation> variations{{kind, entry, values, options}};
  for (const auto& given : options.also_given) {
    variations.emplace_back(kind, entry, values_in_scene(entry, &kind, given), options);
  }
  std::string idle;
  std::string unknown;
  std::string refused;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const auto is_open = [&](const Variation& v) { return v.is_open(n); };
    const auto matters = [&](const Variation& v) {
      return v.matters(n) || variations.front().matters_beside(v, n);
    };
    const std::string name = " '" + entry.info.parameters[n].name + "'";
    if (std::none_of(variations.begin(), variations.end(), is_open)) {
      unknown += name;
    } else if (std::none_of(variations.begin(), variations.end(), matters)) {
      const std::string why = variations.front().refusal(n);
      (why.empty() ? idle : refused) += name + (why.empty() ? "" : " (" + why + ")");
    }
  }
  if (!idle.empty() && refused.empty()) {
    const Observations base = kind.observe(make, {});
    const bool is_nothing =
        std::none_of(base.begin(), base.end(), [](const Observation& r) { return r.value > 0.0; });
    if (is_nothing || (kind.is_met && !kind.is_met(make))) {
      throw Remark("the model gives nothing here to tell by; place it with --set PARAMETER=VALUE");
    }
  }
  // What does nothing by itself may do something beside what could not be tried.
  if (refused.empty()) require(idle.empty(), "no other value changes anything:" + idle);
  refused += idle;
  if (!refused.empty()) {
    throw Remark(
        "no other value is accepted beside the rest, give some with --set "
        "PARAMETER=VALUE:" +
        refused);
  }
  if (!unknown.empty()) throw Remark("no other value could be guessed:" + unknown);
}

void check_common(const registry::Entry& entry, const Kind& kind, const Maker& make,
                  const std::vector<Value>& values, const Options& options, RuleRunner& runner) {
  runner.rule("gives finite numbers, all of them", [&] {
    for (const Observation& r : kind.observe(make, {})) {
      require(std::isfinite(r.value),
              r.name + " is " + shown(r.value) +
                  ": not finite, or is not written; expected: a finite number");
    }
  });
  runner.rule("gives the same bits when asked again", [&] {
    const std::string what = first_difference(kind.observe(make, {}), kind.observe(make, {}));
    require(what.empty(),
            what +
                " differs between two models of the same parameters: nothing may come from "
                "outside, for example from a clock or memory that is not set");
  });
  if (!kind.batches.empty()) {
    runner.rule("gives the same bits however its batch is split", [&] {
      const Observations whole = kind.observe(make, {});
      for (const std::size_t batch : kind.batches) {
        const std::string what = first_difference(whole, kind.observe(make, {.batch = batch}));
        require(what.empty(), what + " differs in batches of " + std::to_string(batch) +
                                  ": a row may depend on its own input alone");
      }
    });
  }
  runner.rule("every parameter matters",
              [&] { check_parameters(kind, entry, values, make, options); });
  runner.rule("is homogeneous in its dimensions", [&] { check_units(kind, make); });
  if (kind.is_hot) {
    runner.rule("does not allocate in the hot call", [&] {
      if (!runner.watches_allocations())
        throw Remark("allocations are not watched in this program");
      (void)kind.observe(make, {.runner = &runner});
    });
  }
}

}  // namespace

std::vector<RuleResult> check_model(const registry::Entry& entry, const Options& options) {
  std::vector<const std::map<std::string, Value>*> named{&options.given, &options.others};
  for (const auto& given : options.also_given) named.push_back(&given);
  for (const auto* values : named) {
    for (const auto& [name, value] : *values) {
      const auto& all = entry.info.parameters;
      const std::string& wanted = name;
      if (std::any_of(all.begin(), all.end(), [&](const auto& p) { return p.name == wanted; })) {
        continue;
      }
      throw base::UserError("error: " + entry.info.kind + "/" + entry.info.name +
                            ": there is no parameter '" + name + "'");
    }
  }
  const Kind* kind = find_kind(entry.info.kind);
  const std::string who = registry::identity_of(entry);
  const registry::Asking asking(who.c_str(), " was tried with values for its parameters");
  const ModelUnderTest model_under_test{entry.info, values_in_scene(entry, kind, options.given)};
  const Maker make = [&](const Units& units) {
    return entry.factory(in_units(units, entry.info.parameters, model_under_test.values));
  };
  RuleRunner runner(options.allocations, who);
  runner.rule("says what it is: equation, source, parameters",
              [&] { check_description(entry.info); });
  if (kind == nullptr) {
    runner.rule("keeps the rules of its kind", [&] {
      throw Remark("this engine has no rules for the kind '" + entry.info.kind + "'");
    });
    return runner.results();
  }
  check_common(entry, *kind, make, model_under_test.values, options, runner);
  kind->rules(make, model_under_test, runner);
  return runner.results();
}

}  // namespace dust::contract
