// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.hpp"
#include "report/page.hpp"
#include "study/effects.hpp"
#include "study/hoods/hood_results.hpp"
#include "study/hoods/hood_study.hpp"
#include "study/runner.hpp"
#include "study/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace dust::study {
namespace {

using Json = nlohmann::json;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + ", " + unit;
}

/// Long paths by their last part where that says which.
std::string short_name(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

/// A name zipped with a number, which tells the levels better: an opening with its mass flow.
bool is_given_by_number(const Plan& plan, std::size_t input) {
  const auto is_twin = [&](const InputColumn& c) {
    return c.axis == plan.inputs[input].axis && !c.is_text;
  };
  return plan.inputs[input].is_text && std::any_of(plan.inputs.begin(), plan.inputs.end(), is_twin);
}

std::size_t count_of(const Results& results, Status status) {
  return static_cast<std::size_t>(
      std::count_if(results.outcomes.begin(), results.outcomes.end(),
                    [&](const Outcome& o) { return o.status == status; }));
}

/// An error that is negative where it is not known.
Json known(double error) { return error >= 0.0 ? Json(error) : Json(nullptr); }

Json facts_json(const Spec& spec, const Results& results) {
  double wall = 0.0;
  for (const Outcome& o : results.outcomes) wall += o.wall_s;
  return {{"name", spec.name},
          {"sentence", spec.title},
          {"base", spec.base.stem().string()},
          {"base_file", spec.base.lexically_proximate(spec.file.parent_path()).generic_string()},
          {"runs", results.outcomes.size()},
          {"finished", count_of(results, Status::finished)},
          {"failed", count_of(results, Status::failed)},
          {"inputs", results.plan.inputs.size()},
          {"outputs", results.plan.outputs.size()},
          {"wall_s", wall}};
}

Json expectations_json(const Spec& spec, const Results& results) {
  Json list = Json::array();
  for (const Expectation& e : spec.expectations) {
    const Verdict verdict = assess(e, spec, results);
    const bool is_good = verdict.kind == Verdict::Kind::as_expected;
    const bool is_bad = verdict.kind == Verdict::Kind::against;
    list.push_back({{"output", e.output},
                    {"then", e.then},
                    {"input", e.input},
                    {"from", e.from},
                    {"to", e.to},
                    {"at", place_text(e)},
                    {"verdict", is_good  ? "as_expected"
                                : is_bad ? "against"
                                         : "open"},
                    {"text", with_true_signs(verdict.text)},
                    {"why", e.why}});
  }
  return list;
}

/// "1 of 2 points not steady" of so many; nothing where all are.
std::string unsteady_of(std::size_t unsteady, std::size_t of) {
  Coverage coverage;
  coverage.used = of;
  coverage.unsteady = unsteady;
  return unsteady_text(coverage);
}

/// Why a mean has no error; nothing where it has one. The levels of a sample have none of their
/// own: how they scatter about a line tells its error.
std::string why_no_error(const LevelMean& mean, bool is_scattered) {
  if (mean.unsteady > 0) return unsteady_of(mean.unsteady, mean.points);
  return mean.error < 0.0 && !is_scattered ? "no error is known" : "";
}

/// Names beside means with their errors.
Json rows_json(const MainEffect& effect, const Results& results) {
  Json rows = Json::array();
  for (const LevelMean& l : effect.levels) {
    if (l.points == 0) continue;
    rows.push_back({{"name", l.label},
                    {"value", l.mean},
                    {"error", known(l.error)},
                    {"no_error", why_no_error(l, effect.is_scattered)}});
  }
  const OutputColumn& output = results.plan.outputs[effect.output];
  return {{"title", output.name},
          {"unit", output.unit},
          {"input", short_name(results.plan.inputs[effect.input].name)},
          {"coverage", coverage_text(effect.coverage)},
          {"unsteady", unsteady_text(effect.coverage)},
          {"rows", rows}};
}

/// What the other inputs were, for the legend.
std::string others_of(const Results& results, const Point& point, std::size_t axis) {
  std::string text;
  for (std::size_t k = 0; k < results.plan.inputs.size(); ++k) {
    const InputColumn& c = results.plan.inputs[k];
    if (c.axis == axis || is_given_by_number(results.plan, k)) continue;
    text += (text.empty() ? "" : ", ") + short_name(c.name) + " " + point.inputs[k].text +
            (c.unit.empty() || c.unit == "1" ? "" : " " + c.unit);
  }
  return text;
}

/// One line per combination of the other inputs, means of replicates: shows whether they matter.
/// Empty where there is one combination only, or more than a reader tells apart.
Json lines_of_others(const MainEffect& effect, const Results& results) {
  constexpr std::size_t k_max = 5;
  const std::size_t axis = results.plan.inputs[effect.input].axis;
  struct LineSum {
    double sum = 0.0;
    std::size_t count = 0, unsteady = 0;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::map<std::vector<std::size_t>, std::pair<std::string, std::map<double, LineSum>>> groups;
  for (std::size_t n = 0; n < results.outcomes.size(); ++n) {
    const Outcome& o = results.outcomes[n];
    if (effect.output >= o.outputs.size() || !o.outputs[effect.output].value) continue;
    const Point& point = results.plan.points[n];
    std::vector<std::size_t> key = point.levels;
    if (axis < key.size()) key[axis] = 0;
    auto& [name, line] = groups[key];
    name = others_of(results, point, axis);
    LineSum& at = line[point.inputs[effect.input].number];
    at.sum += *o.outputs[effect.output].value;
    ++at.count;
    if (is_unsteady(o.outputs[effect.output])) ++at.unsteady;
  }
  Json lines = Json::array();
  if (groups.size() < 2 || groups.size() > k_max) return lines;
  for (const auto& [key, group] : groups) {
    Json line = {{"name", group.first},
                 {"x", Json::array()},
                 {"y", Json::array()},
                 {"no_error", Json::array()}};
    for (const auto& [x, sum] : group.second) {
      line["x"].push_back(x);
      line["y"].push_back(sum.mean());
      line["no_error"].push_back(unsteady_of(sum.unsteady, sum.count));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// The means with one standard error to either side, or why there is none.
Json mean_line(const MainEffect& effect) {
  Json mean = {{"name", effect.is_scattered ? "runs" : "mean"},
               {"x", Json::array()},
               {"y", Json::array()},
               {"low", Json::array()},
               {"high", Json::array()},
               {"no_error", Json::array()}};
  if (effect.is_scattered) mean["kind"] = "points";
  mean["width"] = 3.0;
  bool has_errors = false;
  double last = 0.0;
  for (const LevelMean& l : effect.levels) {
    if (l.points == 0) continue;
    // A plot needs one value per place.
    if (!mean["x"].empty() && l.input <= last) continue;
    last = l.input;
    has_errors = has_errors || l.error >= 0.0;
    mean["x"].push_back(l.input);
    mean["y"].push_back(l.mean);
    mean["low"].push_back(l.error >= 0.0 ? Json(l.mean - l.error) : Json(nullptr));
    mean["high"].push_back(l.error >= 0.0 ? Json(l.mean + l.error) : Json(nullptr));
    mean["no_error"].push_back(why_no_error(l, effect.is_scattered));
  }
  if (!has_errors || effect.is_scattered) {
    mean.erase("low");
    mean.erase("high");
  }
  return mean;
}

/// A plot for a page: the means, and the lines behind them.
Json effect_plot(const MainEffect& effect, const Results& results) {
  const InputColumn& input = results.plan.inputs[effect.input];
  const OutputColumn& output = results.plan.outputs[effect.output];
  Json mean = mean_line(effect);
  Json lines = Json::array();
  if (!mean["x"].empty()) lines.push_back(std::move(mean));
  if (!effect.is_scattered) {
    for (Json& line : lines_of_others(effect, results)) lines.push_back(std::move(line));
  }
  return {{"title", output.name},
          {"input", short_name(input.name)},
          {"x_label", with_unit(short_name(input.name), input.unit)},
          {"y_label", lines.size() > 1 ? "mean, and each combination of the other inputs" : "mean"},
          {"unit", output.unit == "1" ? "" : output.unit},
          {"change", effect.coverage.used > 0 ? Json(effect.change) : Json(nullptr)},
          {"change_error", known(effect.error)},
          {"coverage", coverage_text(effect.coverage)},
          {"unsteady", unsteady_text(effect.coverage)},
          {"is_scattered", effect.is_scattered},
          {"lines", lines}};
}

/// All effects of numbers at a glance: a row per output, a column per input.
Json table_json(const std::vector<MainEffect>& effects, const Results& results) {
  std::vector<std::size_t> columns;
  Json heads = Json::array();
  for (std::size_t k = 0; k < results.plan.inputs.size(); ++k) {
    const auto any = std::find_if(effects.begin(), effects.end(),
                                  [&](const MainEffect& e) { return e.input == k; });
    if (any == effects.end() || results.plan.inputs[k].is_text) continue;
    columns.push_back(k);
    heads.push_back({{"name", short_name(results.plan.inputs[k].name)},
                     {"unit", results.plan.inputs[k].unit},
                     {"from", any->levels.front().input},
                     {"to", any->levels.back().input}});
  }
  Json rows = Json::array();
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    Json cells = Json::array();
    for (const std::size_t k : columns) {
      const auto effect = std::find_if(effects.begin(), effects.end(), [&](const MainEffect& e) {
        return e.input == k && e.output == o;
      });
      if (effect == effects.end() || effect->coverage.used == 0) {
        cells.push_back(nullptr);
        continue;
      }
      cells.push_back({{"change", effect->change},
                       {"error", known(effect->error)},
                       {"is_clear", is_clear(*effect)},
                       {"coverage", coverage_text(effect->coverage)},
                       {"unsteady", unsteady_text(effect->coverage)}});
    }
    rows.push_back({{"output", results.plan.outputs[o].name},
                    {"unit", results.plan.outputs[o].unit},
                    {"cells", cells}});
  }
  return {{"columns", heads}, {"rows", rows}};
}

Json effects_json(const Spec& spec, const Results& results) {
  const auto effects = main_effects(spec, results);
  if (effects.empty()) return nullptr;
  Json outputs = Json::array();
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    Json plots = Json::array();
    Json rows = Json::array();
    for (const MainEffect& e : effects) {
      if (e.output != o || is_given_by_number(results.plan, e.input)) continue;
      if (results.plan.inputs[e.input].is_text) {
        Json table = rows_json(e, results);
        if (!table["rows"].empty()) rows.push_back(std::move(table));
      } else {
        Json plot = effect_plot(e, results);
        if (!plot["lines"].empty()) plots.push_back(std::move(plot));
      }
    }
    if (plots.empty() && rows.empty()) continue;
    const OutputColumn& c = results.plan.outputs[o];
    outputs.push_back({{"name", c.name},
                       {"quantity", c.quantity},
                       {"minus", c.minus},
                       {"plots", plots},
                       {"rows", rows}});
  }
  return {{"table", table_json(effects, results)}, {"outputs", outputs}};
}

Json points_json(const Results& results) {
  Json inputs = Json::array();
  for (const InputColumn& c : results.plan.inputs) {
    inputs.push_back({{"name", short_name(c.name)}, {"unit", c.unit}});
  }
  Json outputs = Json::array();
  for (const OutputColumn& c : results.plan.outputs) {
    outputs.push_back({{"name", c.name}, {"unit", c.unit}});
  }
  Json rows = Json::array();
  for (std::size_t n = 0; n < results.outcomes.size(); ++n) {
    const Point& point = results.plan.points[n];
    const Outcome& o = results.outcomes[n];
    Json row = {{"hash", point.hash},
                {"seed", point.seed},
                {"status", status_word(o.status)},
                {"reason", o.reason},
                {"wall_s", o.status == Status::waiting ? Json(nullptr) : Json(o.wall_s)}};
    row["inputs"] = Json::array();
    for (const InputValue& v : point.inputs) row["inputs"].push_back(v.text);
    row["outputs"] = Json::array();
    for (std::size_t k = 0; k < results.plan.outputs.size(); ++k) {
      const OutputValue v = k < o.outputs.size() ? o.outputs[k] : OutputValue{};
      row["outputs"].push_back({{"value", v.value ? Json(*v.value) : Json(nullptr)},
                                {"error", known(v.error)},
                                {"no_error", v.no_error}});
    }
    rows.push_back(std::move(row));
  }
  return {{"inputs", inputs}, {"outputs", outputs}, {"rows", rows}};
}

/// Whether it is a study of suggested hoods, all points of which have finished.
bool has_hoods(const Spec& spec, const Results& results) {
  const std::string hood = std::string("bodies.") + k_hood_body;
  const bool is_finished =
      std::all_of(results.outcomes.begin(), results.outcomes.end(),
                  [](const Outcome& outcome) { return outcome.status == Status::finished; });
  return is_finished && std::any_of(spec.axes.begin(), spec.axes.end(), [&](const Axis& axis) {
           return std::any_of(axis.levels.begin(), axis.levels.end(), [&](const Level& level) {
             return std::any_of(level.settings.begin(), level.settings.end(),
                                [&](const Setting& setting) { return setting.path == hood; });
           });
         });
}

}  // namespace

std::string with_true_signs(std::string text) {
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    const bool is_first = at == 0 || text[at - 1] == ' ';
    if (is_first && text[at] == '-' && text[at + 1] >= '0' && text[at + 1] <= '9') {
      text.replace(at, 1, "\u2212");
    }
  }
  for (auto at = text.find("+-"); at != std::string::npos; at = text.find("+-", at)) {
    text.replace(at, 2, "\u00b1");
  }
  return text;
}

Json study_document(const Spec& spec, const Results& results, const CalibrationAnswer* answer) {
  return {{"schema", "dust.report/1"},
          {"kind", "study"},
          {"facts", facts_json(spec, results)},
          {"calibration", answer != nullptr ? calibration_json(*answer) : Json(nullptr)},
          {"expectations", expectations_json(spec, results)},
          {"effects", effects_json(spec, results)},
          {"points", points_json(results)},
          {"study_file", io::read_text(spec.file)}};
}

void write_study_report(const std::filesystem::path& file, const Spec& spec, const Results& results,
                        const CalibrationAnswer* answer) {
  Json document = study_document(spec, results, answer);
  if (has_hoods(spec, results)) {
    document["hoods"] = hoods_json(hood_results(file.parent_path()));
  }
  report::write_page(file, report::page_of(report::Templates(), "study.html", document));
}

}  // namespace dust::study
