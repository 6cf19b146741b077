// SPDX-License-Identifier: Apache-2.0
#include "study/spec/axes.hpp"
#include "study/spec/spec.hpp"

#include "dust/sdk/parameter_schema.hpp"
#include "scenario/text/overlay.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"
#include "study/calibration/surrogate.hpp"
#include "study/spec/spec_blocks.hpp"

#include <algorithm>

namespace dust::study {
namespace {

using scenario::Entry;
using scenario::MapReader;
using scenario::Node;
using scenario::printable;

template <class Block>
Block read_block(MapReader& reader) {
  return sdk::parameters_from<Block>(Block::schema(), reader.values(Block::schema()));
}

/// Reads the tree of a study file.
class SpecReader {
 public:
  SpecReader(const Node& root, const std::filesystem::path& file,
             scenario::Diagnostics& diagnostics)
      : root_(root), diagnostics_(diagnostics) {
    spec_.file = file;
    spec_.where = root.where;
  }

  Spec read() {
    MapReader top(root_, "", root_.where, diagnostics_, "the study");
    read_general(top);
    if (const Entry* set = top.optional("set")) spec_.settings = read_settings(*set, "set");
    AxisReader axes(diagnostics_);
    if (const Entry* vary = top.optional("vary")) axes.read_values(*vary, spec_.axes);
    if (const Entry* zip = top.optional("zip")) axes.read_zip(*zip, spec_.axes);
    if (const Entry* cases = top.optional("cases")) axes.read_cases(*cases, spec_.axes);
    if (const Entry* sample = top.optional("sample")) axes.read_sample(*sample, spec_.axes);
    check_paths();
    const Entry* calibrate = top.optional("calibrate");
    if (calibrate != nullptr) read_calibration(*calibrate);
    const Entry* measure =
        calibrate == nullptr
            ? top.required("measure", "what is taken from every run: NAME: sensors.SENSOR.FIGURE")
            : top.optional("measure");
    if (measure != nullptr) read_measures(*measure);
    if (const Entry* expect = top.optional("expect")) read_expectations(*expect);
    if (const Entry* run = top.optional("run")) {
      MapReader reader(run->value, "run", run->where, diagnostics_);
      spec_.execution = read_block<Execution>(reader);
      reader.finish();
    }
    if (const Entry* slurm = top.optional("slurm")) {
      MapReader reader(slurm->value, "slurm", slurm->where, diagnostics_);
      spec_.slurm = read_block<SlurmSpec>(reader);
      reader.finish();
    }
    top.finish();
    const bool varies = !spec_.axes.empty() || spec_.replicates > 1;
    if (calibrate != nullptr && !spec_.axes.empty()) {
      error(calibrate->where,
            "calibrate: the parameters are varied by the calibration itself: "
            "take vary, zip, cases and sample out, or calibrate");
    } else if (calibrate == nullptr && !varies && !diagnostics_.has_errors()) {
      error(root_.where, "nothing is varied: give vary, zip, cases, sample or replicates");
    }
    return std::move(spec_);
  }

 private:
  void error(const scenario::Mark& where, const std::string& text) {
    diagnostics_.error(where, text);
  }

  void read_general(MapReader& top) {
    const auto general = read_block<GeneralBlock>(top);
    spec_.name = general.name.empty() ? spec_.file.stem().string() : general.name;
    const bool is_folder_name =
        !spec_.name.empty() && std::all_of(spec_.name.begin(), spec_.name.end(), [](char c) {
          return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
        });
    if (!is_folder_name) {
      const Entry* name = root_.find("name");
      error(name != nullptr ? name->value.where : root_.where,
            "name: '" + printable(spec_.name) +
                "' is also a folder's name: use letters, digits, '_' and '-'");
    }
    spec_.title = general.title;
    spec_.replicates = general.replicates;
    spec_.seed = general.seed;
    const Entry* base = root_.find("base");
    if (base == nullptr || !base->value.is_text()) return;
    spec_.base = (spec_.file.parent_path() / general.base).lexically_normal();
    spec_.base_where = base->value.where;
    if (!std::filesystem::is_regular_file(spec_.base)) {
      error(base->value.where, "base: there is no file " + spec_.base.generic_string());
    }
  }

  std::vector<Setting> read_settings(const Entry& entry, const std::string& path) {
    std::vector<Setting> settings;
    if (!entry.value.is_map()) {
      error(entry.value.where, path + ": a map of paths and values is expected, not " +
                                   scenario::kind_text(entry.value));
      return settings;
    }
    for (const Entry& one : entry.value.entries) {
      settings.push_back({one.key, one.value, one.where});
    }
    return settings;
  }

  /// Two axes that set the same key would make the later one win in silence, and an axis what `set`
  /// says of every point.
  void check_paths() {
    std::vector<std::string> seen;
    for (const Axis& axis : spec_.axes) {
      std::vector<std::string> own = axis.paths;
      for (const Level& level : axis.levels) {
        if (axis.kind != AxisKind::cases) break;
        for (const Setting& s : level.settings) own.push_back(s.path);
      }
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      for (const std::string& path : own) {
        if (std::find(seen.begin(), seen.end(), path) != seen.end()) {
          error(axis.where, printable(path) +
                                " is varied twice: by this and by another part of "
                                "the study");
        }
        seen.push_back(path);
        if (is_in_all(axis, path)) refuse_set(path, "is varied");
      }
    }
  }

  /// Cases may leave a path to what `set` says.
  static bool is_in_all(const Axis& axis, const std::string& path) {
    return std::all_of(axis.levels.begin(), axis.levels.end(), [&](const Level& level) {
      return std::any_of(level.settings.begin(), level.settings.end(),
                         [&](const Setting& s) { return s.path == path; });
    });
  }

  /// `set` says of every point what has another value in each of them.
  void refuse_set(const std::string& path, const std::string& otherwise) {
    for (const Setting& s : spec_.settings) {
      if (s.path != path) continue;
      error(s.where, "set." + printable(path) + ": it " + otherwise +
                         ", so this value is in no point: take one of them out");
    }
  }

  std::optional<Measure> read_measure(const Entry& entry, const std::string& path) {
    if (entry.value.is_text()) {
      return Measure{.name = entry.key,
                     .quantity = entry.value.text,
                     .minus = {},
                     .unit = {},
                     .where = entry.value.where};
    }
    MapReader reader(entry.value, path, entry.where, diagnostics_);
    if (!entry.value.is_map()) return std::nullopt;
    const auto block = read_block<MeasureBlock>(reader);
    reader.finish();
    const Entry* quantity = entry.value.find("quantity");
    if (quantity == nullptr || !reader.is_good()) return std::nullopt;
    return Measure{.name = entry.key,
                   .quantity = block.quantity,
                   .minus = block.minus,
                   .unit = block.unit,
                   .where = quantity->value.where};
  }

  void read_measures(const Entry& entry) {
    if (!entry.value.is_map() || entry.value.entries.empty()) {
      error(entry.value.where,
            "measure: a map of names and quantities is expected, like "
            "dust: sensors.out.forward.grams_per_tonne");
      return;
    }
    for (const Entry& one : entry.value.entries) {
      const auto measure = read_measure(one, "measure." + printable(one.key));
      if (!measure) continue;
      const bool is_target = std::any_of(spec_.measures.begin(), spec_.measures.end(),
                                         [&](const Measure& m) { return m.name == measure->name; });
      if (is_target) {
        error(one.where, "measure." + printable(one.key) + ": a target has this name already");
        continue;
      }
      spec_.measures.push_back(*measure);
    }
  }

  void read_expectations(const Entry& entry) {
    if (!entry.value.is_list()) {
      error(entry.value.where,
            "expect: a list of {output: ..., input: ..., then: rises} is "
            "expected, not " +
                scenario::kind_text(entry.value));
      return;
    }
    for (std::size_t n = 0; n < entry.value.items.size(); ++n) {
      const Node& item = entry.value.items[n];
      MapReader reader(item, "expect[" + std::to_string(n) + "]", item.where, diagnostics_);
      if (!item.is_map()) continue;
      const auto block = read_block<ExpectationBlock>(reader);
      Expectation e{.output = block.output,
                    .input = block.input,
                    .at = {},
                    .then = block.then,
                    .from = block.from,
                    .to = block.to,
                    .why = block.why,
                    .where = item.where};
      const Entry* at = reader.optional("at");
      reader.finish();
      check_expectation(item, e, n);
      if (at != nullptr) read_held(*at, "expect[" + std::to_string(n) + "].at", e);
      spec_.expectations.push_back(std::move(e));
    }
  }

  /// Levels of other inputs at which an effect is looked at.
  void read_held(const Entry& entry, const std::string& path, Expectation& e) {
    if (!entry.value.is_map()) {
      error(entry.value.where, path +
                                   ": a map of paths and levels is expected, like "
                                   "{bodies.belt.speed: 0.2 m/s}, not " +
                                   scenario::kind_text(entry.value));
      return;
    }
    for (const Entry& one : entry.value.entries) {
      const Axis* axis = varied(one.key, one.where, path);
      if (axis == nullptr) continue;
      if (is_of(*axis, e.input)) {
        error(one.where, path + ": " + printable(one.key) + " is the input itself");
        continue;
      }
      std::vector<std::string> levels;
      for (const Level& level : axis->levels) levels.push_back(level_text(*axis, level, one.key));
      const std::string given = value_text(one.value);
      const auto found = std::find(levels.begin(), levels.end(), given);
      if (found == levels.end()) {
        // Of values the nearest word is no likely one: all are named.
        const std::string near = axis->kind == AxisKind::cases ? given : std::string();
        error(one.value.where, path + "." + printable(one.key) + ": there is no level '" +
                                   printable(given) + "'" +
                                   scenario::suggestion(near, levels, "there are"));
        continue;
      }
      e.at.push_back({one.key, given, static_cast<std::size_t>(axis - spec_.axes.data()),
                      static_cast<std::size_t>(found - levels.begin())});
    }
  }

  static std::vector<std::string> inputs_of(const Axis& axis) {
    return axis.kind == AxisKind::cases ? std::vector<std::string>{"case"} : axis.paths;
  }

  static bool is_of(const Axis& axis, const std::string& input) {
    const auto own = inputs_of(axis);
    return std::find(own.begin(), own.end(), input) != own.end();
  }

  /// The axis of an input; nothing, and an error, where it is not varied.
  const Axis* varied(const std::string& input, const scenario::Mark& where,
                     const std::string& path) {
    std::vector<std::string> inputs;
    for (const Axis& axis : spec_.axes) {
      if (is_of(axis, input)) return &axis;
      for (const std::string& name : inputs_of(axis)) inputs.push_back(name);
    }
    error(where, path + ": '" + printable(input) + "' is not varied" +
                     scenario::suggestion(input, inputs, "there are"));
    return nullptr;
  }

  static std::string level_text(const Axis& axis, const Level& level, const std::string& path) {
    if (axis.kind == AxisKind::cases) return level.label;
    for (const Setting& s : level.settings) {
      if (s.path == path) return value_text(s.value);
    }
    return {};
  }

  void check_expectation(const Node& item, const Expectation& e, std::size_t n) {
    const std::string path = "expect[" + std::to_string(n) + "]";
    const auto where = [&](const char* key) {
      const Entry* entry = item.find(key);
      return entry != nullptr ? entry->value.where : item.where;
    };
    std::vector<std::string> outputs;
    for (const Measure& m : spec_.measures) outputs.push_back(m.name);
    if (!e.output.empty() && std::find(outputs.begin(), outputs.end(), e.output) == outputs.end()) {
      error(where("output"), path + ".output: there is no measure '" + printable(e.output) + "'" +
                                 scenario::suggestion(e.output, outputs, "there are"));
    }
    const Axis* chosen =
        e.input.empty() ? nullptr : varied(e.input, where("input"), path + ".input");
    if (chosen == nullptr) return;
    const bool is_case = chosen->kind == AxisKind::cases;
    if (!is_case && !(e.from.empty() && e.to.empty())) {
      error(item.where, path + ": from and to name cases; other inputs count upwards");
    }
    if (!is_case) return;
    std::vector<std::string> labels;
    for (const Level& level : chosen->levels) labels.push_back(level.label);
    for (const auto& [key, name] : {std::pair{"from", e.from}, std::pair{"to", e.to}}) {
      if (std::find(labels.begin(), labels.end(), name) != labels.end()) continue;
      error(where(key), path + "." + key + ": there is no case '" + printable(name) + "'" +
                            scenario::suggestion(name, labels, "there are"));
    }
  }

  void read_calibration(const Entry& entry) {
    MapReader reader(entry.value, "calibrate", entry.where, diagnostics_);
    if (!entry.value.is_map()) return;
    CalibrationSpec calibration = read_block<CalibrationSpec>(reader);
    calibration.where = entry.where;
    const Entry* targets =
        reader.required("targets", "NAME: {quantity: ..., value: 41.6, error: 1.1}");
    const Entry* parameters =
        reader.required("parameters", "NAME: {path: ..., from: 0.2, to: 0.7}");
    reader.finish();
    if (targets != nullptr) read_targets(*targets, calibration);
    if (parameters != nullptr) read_parameters(*parameters, calibration);
    for (const FreeParameter& p : calibration.parameters) {
      for (const std::string& path : p.paths) refuse_set(path, "is calibrated");
    }
    if (calibration.parameters.size() > 4) {
      error(parameters->where, "calibrate.parameters: at most 4 can be found at a time");
    }
    check_runs(entry, calibration);
    spec_.calibration = std::move(calibration);
  }

  void check_runs(const Entry& entry, const CalibrationSpec& calibration) {
    if (calibration.parameters.empty() || diagnostics_.has_errors()) return;
    const std::size_t fewest =
        make_surrogate(calibration.surrogate)->fewest(calibration.parameters.size());
    if (static_cast<std::size_t>(calibration.runs) >= fewest) return;
    const Entry* runs = entry.value.find("runs");
    error(runs != nullptr ? runs->value.where : entry.where,
          "calibrate.runs: " + calibration.surrogate + " learns from " + std::to_string(fewest) +
              " runs or more where " + std::to_string(calibration.parameters.size()) +
              (calibration.parameters.size() == 1 ? " parameter is" : " parameters are") +
              " sought");
  }

  /// Value and unit of a number; the problem is told.
  std::optional<scenario::WrittenNumber> number_of(const Entry* entry, const std::string& path) {
    if (entry == nullptr) return std::nullopt;
    std::string why = "a number is expected, not " + scenario::kind_text(entry->value);
    std::optional<scenario::WrittenNumber> number;
    if (entry->value.is_text()) number = scenario::split_number(entry->value.text, why);
    if (!number) error(entry->value.where, path + ": " + why);
    return number;
  }

  void read_targets(const Entry& entry, CalibrationSpec& calibration) {
    if (!entry.value.is_map() || entry.value.entries.empty()) {
      error(entry.value.where, "calibrate.targets: at least one is needed");
      return;
    }
    for (const Entry& one : entry.value.entries) {
      const std::string path = "calibrate.targets." + printable(one.key);
      MapReader reader(one.value, path, one.where, diagnostics_);
      if (!one.value.is_map()) continue;
      const Entry* quantity = reader.required("quantity", "sensors.SENSOR.FIGURE");
      const Entry* value = reader.required("value", "as measured, with its unit");
      const Entry* uncertainty = reader.required("error", "one standard error, with its unit");
      reader.finish();
      const auto v = number_of(value, path + ".value");
      const auto e = number_of(uncertainty, path + ".error");
      if (quantity == nullptr || !v || !e) continue;
      if (!(e->number > 0.0)) {
        error(uncertainty->value.where, path + ".error: must be above 0");
      }
      if (!e->unit.empty() && e->unit != v->unit) {
        error(uncertainty->value.where, path + ".error: write it in the unit of the value");
      }
      Target target{{one.key, quantity->value.text, {}, v->unit, quantity->value.where},
                    v->number,
                    e->number};
      spec_.measures.push_back(target.measure);
      calibration.targets.push_back(std::move(target));
    }
  }

  void read_parameters(const Entry& entry, CalibrationSpec& calibration) {
    if (!entry.value.is_map() || entry.value.entries.empty()) {
      error(entry.value.where, "calibrate.parameters: at least one is needed");
      return;
    }
    for (const Entry& one : entry.value.entries) {
      const std::string path = "calibrate.parameters." + printable(one.key);
      MapReader reader(one.value, path, one.where, diagnostics_);
      if (!one.value.is_map()) continue;
      FreeParameter parameter{.name = one.key, .paths = {}, .unit = {}, .where = one.where};
      if (const Entry* at = reader.required("path", "where it stands; or a list of such paths")) {
        std::vector<Node> nodes{at->value};
        if (at->value.is_list()) nodes = at->value.items;
        for (const Node& node : nodes) parameter.paths.push_back(node.text);
      }
      const auto low = number_of(reader.required("from", "lower end"), path + ".from");
      const Entry* to = reader.required("to", "upper end");
      const auto high = number_of(to, path + ".to");
      reader.finish();
      if (!low || !high) continue;
      parameter.low = low->number;
      parameter.high = high->number;
      parameter.unit = high->unit;
      if (!low->unit.empty() && low->unit != high->unit) {
        error(to->value.where, path + ": write both ends in one unit");
      } else if (!(high->number > low->number)) {
        error(to->value.where, path + ".to: must be above from");
      }
      calibration.parameters.push_back(std::move(parameter));
    }
  }

  const Node& root_;
  scenario::Diagnostics& diagnostics_;
  Spec spec_;
};

}  // namespace

namespace {

/// Rather than one error for each key of a scenario.
bool is_scenario(const Node& root, const std::filesystem::path& file,
                 scenario::Diagnostics& diagnostics) {
  for (const char* key : {"base", "measure", "calibrate", "vary", "zip", "cases", "sample"}) {
    if (root.find(key) != nullptr) return false;
  }
  const Entry* domain = root.find("domain");
  if (domain == nullptr) return false;
  diagnostics.error(domain->where, "this is a scenario, not a study: engine run " +
                                       file.generic_string() +
                                       " runs it; a study names it as its 'base'");
  return true;
}

}  // namespace

std::optional<Spec> read_spec(const std::filesystem::path& file,
                              scenario::Diagnostics& diagnostics) {
  auto root = scenario::read_with_includes(file, diagnostics);
  if (!root || is_scenario(*root, file, diagnostics)) return std::nullopt;
  if (root->where.line == 0) root->where = {file.generic_string(), 1, 1};
  return SpecReader(*root, file, diagnostics).read();
}

}  // namespace dust::study
