// SPDX-License-Identifier: Apache-2.0
#include "study/plan.hpp"

#include "base/error.hpp"
#include "io/run_files.hpp"
#include "io/scenario_leaves.hpp"
#include "preflight/derived.hpp"
#include "preflight/reader.hpp"
#include "run/branch/origin.hpp"
#include "run/folder/input_digests.hpp"
#include "scenario/text/overlay.hpp"
#include "scenario/text/suggest.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"
#include "study/measures.hpp"
#include "study/quantities.hpp"
#include "study/spec/axes.hpp"
#include "study/spec/point_problems.hpp"

#include <algorithm>
#include <charconv>
#include <set>

namespace dust::study {
namespace {

using scenario::Diagnostics;
using scenario::Mark;
using scenario::Node;

constexpr std::size_t k_max_points = 10000;
constexpr std::size_t k_hash_digits = 16;

/// What tells one run from another: its scenario, with what stands in the files that it reads.
/// Where they lie does not count.
std::string hash_of(const scenario::ReadResult& read, const std::vector<io::InputFile>& inputs) {
  std::string sha256;
  if (inputs.empty()) {
    io::Sha256 digest;
    digest.update(read.resolved_yaml.data(), read.resolved_yaml.size());
    sha256 = digest.hex_digest();
  } else {
    sha256 = io::ScenarioLeaves(read.resolved_yaml, inputs).sha256();
  }
  return sha256.substr(0, k_hash_digits);
}

/// Interactions[0].contact.friction of a vector's component is noted under the vector.
std::string without_index(const std::string& path) {
  return path.ends_with(']') ? path.substr(0, path.rfind('[')) : path;
}

void collect_marks(const Node& node, std::set<std::pair<int, int>>& marks) {
  marks.insert({node.where.line, node.where.column});
  for (const Node& item : node.items) collect_marks(item, marks);
  for (const auto& entry : node.entries) {
    marks.insert({entry.where.line, entry.where.column});
    collect_marks(entry.value, marks);
  }
}

/// The columns of an axis: common written unit, or SI where units differ.
struct Column {
  InputColumn head;
  std::vector<InputValue> values;  ///< per level
};

Column column_of(const Axis& axis, std::size_t axis_number, std::size_t setting,
                 const std::map<std::string, sdk::Dimension>& dimensions) {
  Column column;
  const std::string& path = axis.paths[setting];
  column.head = {path, "", false, axis_number};
  std::vector<scenario::WrittenNumber> written;
  bool has_common_unit = true;
  for (const Level& level : axis.levels) {
    const Node& value = level.settings[setting].value;
    std::string ignored;
    const auto number = value.is_text() && !value.is_quoted
                            ? scenario::split_number(value.text, ignored)
                            : std::optional<scenario::WrittenNumber>{};
    column.values.push_back({0.0, value_text(value)});
    if (!number) {
      column.head.is_text = true;
      continue;
    }
    written.push_back(*number);
    has_common_unit = has_common_unit && number->unit == written.front().unit;
  }
  if (column.head.is_text) return column;
  const auto found = dimensions.find(without_index(path));
  const sdk::Dimension dimension = found == dimensions.end() ? sdk::Dimension{} : found->second;
  const bool is_si = !has_common_unit || written.front().unit.empty();
  column.head.unit = is_si ? scenario::si_unit(dimension) : written.front().unit;
  for (std::size_t n = 0; n < written.size(); ++n) {
    double number = written[n].number;
    std::string ignored;
    if (!has_common_unit) {
      number = scenario::to_si(written[n], dimension, ignored).value_or(number);
    }
    column.values[n] = {number, scenario::number_text(number)};
  }
  return column;
}

}  // namespace

/// When the runs of points begin.
class Begins {
 public:
  explicit Begins(Origins origins) : origins_(origins) {}

  /// [s] Time of the state that a run starts from. Of a run that is still to come, as it is asked
  /// for, with a warning; where it has to be there, an error.
  double of(const scenario::StartSetup& start, const registry::Registry& registry,
            Diagnostics& own) {
    if (!start.from) return 0.0;
    if (!run::has_origin(*start.from)) {
      const std::string text = "start_from: " + run::no_origin_text(*start.from);
      if (origins_ == Origins::there) {
        own.error(start.from->where, text);
      } else {
        own.warning(start.from->where, text);
      }
      return start.from->time.value_or(0.0);
    }
    const auto [at, is_new] = times_.try_emplace(start.from->written, 0.0);
    if (is_new) at->second = run::Origin(*start.from, registry).time();
    return at->second;
  }

 private:
  Origins origins_;
  std::map<std::string, double> times_;  ///< [s] by what start_from says
};

/// Problems whose place does not tell which points they are of.
struct Kept {
  PointProblems errors, warnings;
};

struct Planner::Impl {
  const Spec& spec;
  const registry::Registry& registry;
  Diagnostics& diagnostics;
  std::optional<Node> base;   ///< with what all points set
  std::optional<Node> plain;  ///< without
  std::uint64_t base_seed = 1;
  MeasureCheck measures;
  run::InputDigests digests = {};
  std::set<std::string> reported;  ///< error lines
  std::vector<std::set<std::pair<int, int>>> axis_marks;
  std::set<std::size_t> reported_axes;
  std::map<std::string, sdk::Dimension> dimensions;
  std::set<std::filesystem::path> read_paths = {};  ///< by the points
  Begins begins;
  Kept kept = {};

  void read_base() {
    base = scenario::read_with_includes(spec.base, diagnostics);
    if (!base) return;
    if (base->where.line == 0) base->where = {spec.base.generic_string(), 1, 1};
    plain = base;
    set_all(*base, spec.settings, diagnostics);
    // Not checked by itself: what is varied may be what makes it whole.
    const scenario::Entry* seed = base->find("seed");
    if (seed != nullptr && seed->value.is_text()) {
      std::from_chars(seed->value.text.data(), seed->value.text.data() + seed->value.text.size(),
                      base_seed);
    }
    for (const Axis& axis : spec.axes) {
      axis_marks.emplace_back();
      for (const Level& level : axis.levels) {
        for (const Setting& s : level.settings) {
          axis_marks.back().insert({s.where.line, s.where.column});
          collect_marks(s.value, axis_marks.back());
        }
      }
    }
    if (!spec.calibration) return;
    for (const FreeParameter& p : spec.calibration->parameters) {
      axis_marks.push_back({{p.where.line, p.where.column}});
    }
  }

  static void set_all(Node& root, const std::vector<Setting>& settings, Diagnostics& to) {
    for (const Setting& s : settings) {
      if (s.value.kind == Node::Kind::nothing) {
        to.error(s.where, scenario::printable(s.path) + ": the value is missing");
        continue;
      }
      scenario::set_path(root, s.path, s.value, s.where, to);
    }
  }

  /// Problems of one point, without those that are only the same thing said for another level.
  /// Those of combination `n` whose place does not tell which point it is are kept till all are
  /// known; of none: `with` says what was set.
  void print(const Diagnostics& own, std::optional<std::size_t> n = {},
             const std::string& with = {}) {
    std::vector<Diagnostics::Problem> elsewhere;
    for (const Diagnostics::Problem& problem : own.errors()) {
      const std::size_t axis = axis_of(problem.where);
      if (n && axis == axis_marks.size()) {
        elsewhere.push_back(problem);
        continue;
      }
      if (axis < axis_marks.size() && !reported_axes.insert(axis).second) continue;
      if (!reported.insert(scenario::place(problem.where) + problem.text).second) continue;
      diagnostics.error(problem.where, problem.text + with);
    }
    if (n) kept.errors.add(elsewhere, *n);
  }
  void print_kept_errors(const PointProblems::Points& points) {
    kept.errors.report(points, [this](const Diagnostics::Problem& problem) {
      diagnostics.error(problem.where, problem.text);
    });
  }
  void print_kept_warnings(const PointProblems::Points& points) {
    kept.warnings.report(points, [this](const Diagnostics::Problem& problem) {
      diagnostics.warning(problem.where, problem.text);
    });
  }
  [[nodiscard]] std::size_t axis_of(const Mark& mark) const {
    if (mark.file != spec.file.generic_string()) return axis_marks.size();
    for (std::size_t n = 0; n < axis_marks.size(); ++n) {
      if (axis_marks[n].contains({mark.line, mark.column})) return n;
    }
    return axis_marks.size();
  }

  /// The point of combination `n`, if it is one, and of `seed`; nothing where it has problems,
  /// which are told, then `with` what was set.
  std::optional<Point> resolve(Node root, std::uint64_t seed, std::optional<std::size_t> n = {},
                               const std::string& with = {}) {
    Diagnostics own;
    own.add_file(spec.file.generic_string());
    own.note_resolved_files_of(diagnostics);
    Node number = Node::make_text(std::to_string(seed));
    number.where = spec.where;
    scenario::set_path(root, "seed", number, spec.where, own);
    const auto read = preflight::read_tree(root, spec.base, registry, own);
    for (const auto& [path, dimension] : own.dimensions()) dimensions[path] = dimension;
    const double begin = read ? begins.of(read->start, registry, own) : 0.0;
    if (own.has_errors()) {
      print(own, n, with);
      return std::nullopt;
    }
    if (n) kept.warnings.add(own.warnings(), *n);
    Point point;
    point.seed = seed;
    point.resolved_yaml = read->resolved_yaml;
    point.hash = hash_of(*read, digests.of(*read));
    for (std::filesystem::path& path : run::read_paths(*read)) read_paths.insert(std::move(path));
    const auto derived = preflight::derive(read->setup, registry, read->dust, begin);
    point.core_seconds = derived.cost.terms.seconds();
    point.memory_bytes = derived.cost.memory_bytes;
    measures.see(quantities_of(read->setup, read->dust, registry));
    return point;
  }

  /// Sets the parameters of a calibration.
  void set_parameters(Node& root, const std::vector<double>& values, Diagnostics& to) const {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const FreeParameter& p = spec.calibration->parameters[k];
      Node value = Node::make_text(parameter_text(k, values[k]));
      value.where = p.where;
      for (const std::string& path : p.paths) scenario::set_path(root, path, value, p.where, to);
    }
  }
  [[nodiscard]] std::string parameter_text(std::size_t k, double value) const {
    const std::string& unit = spec.calibration->parameters[k].unit;
    return scenario::number_text(value) + (unit.empty() ? "" : " " + unit);
  }
  [[nodiscard]] std::string parameters_text(const std::vector<double>& values) const {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k) {
      text += (k == 0 ? "" : ", ") + spec.calibration->parameters[k].name + ": " +
              parameter_text(k, values[k]);
    }
    return text;
  }

  [[nodiscard]] std::uint64_t seed_of(std::int64_t replicate) const {
    const std::uint64_t first = spec.seed >= 0 ? static_cast<std::uint64_t>(spec.seed) : base_seed;
    return first + static_cast<std::uint64_t>(replicate - 1);
  }

  /// Where no point can be read: what is wrong besides the settings of the study that are, so that
  /// all is told at once.
  void look_without_faulty();
  [[nodiscard]] bool is_faulty(const Setting& setting) const;

  [[nodiscard]] std::optional<std::size_t> count_combinations() const;
  [[nodiscard]] std::vector<std::size_t> levels_of(std::size_t n) const;
  [[nodiscard]] std::optional<Node> combined(std::size_t n);
  void add_inputs(std::size_t a, Plan& plan) const;

  /// Whether it is seeds that an axis names, which the study gives to its points by itself.
  bool refuse_seeds(const Axis& axis) {
    const auto& settings = axis.levels.front().settings;
    const bool has_seeds = std::any_of(settings.begin(), settings.end(),
                                       [](const Setting& s) { return s.path == "seed"; });
    if (!has_seeds) return false;
    if (!reported.insert(scenario::place(axis.where) + "seeds").second) return true;
    diagnostics.error(axis.where,
                      "points that differ by the seed alone are the same run, for a study gives "
                      "the seeds itself: write 'replicates: " +
                          std::to_string(axis.levels.size()) +
                          "' instead, and 'seed: N' in the study for the first of them");
    return true;
  }

  void refuse_twin(const Point& first, const Point& second) {
    Mark where = spec.where;
    for (std::size_t a = 0; a < spec.axes.size(); ++a) {
      if (second.levels[a] == first.levels[a]) continue;
      const Level& level = spec.axes[a].levels[second.levels[a]];
      where = level.where;
      if (refuse_seeds(spec.axes[a])) return;
      const std::string line = scenario::place(where) + "twin";
      if (!reported.insert(line).second) return;
      const Level& other = spec.axes[a].levels[first.levels[a]];
      const auto name = [](const Level& l) {
        return l.label.empty() ? value_text(l.settings.front().value) : l.label;
      };
      diagnostics.error(where, "two points are the same run: " + scenario::in_quotes(name(level)) +
                                   " makes the scenario of " + scenario::in_quotes(name(other)) +
                                   " in line " + std::to_string(other.where.line) +
                                   "; take one of them out");
      return;
    }
  }
};

Planner::Planner(const Spec& spec, const registry::Registry& registry, Diagnostics& diagnostics,
                 Origins origins)
    : impl_(new Impl{.spec = spec,
                     .registry = registry,
                     .diagnostics = diagnostics,
                     .base = {},
                     .measures = MeasureCheck(spec, diagnostics),
                     .reported = {},
                     .axis_marks = {},
                     .reported_axes = {},
                     .dimensions = {},
                     .begins = Begins(origins)}) {
  impl_->read_base();
}
Planner::~Planner() = default;

bool Planner::Impl::is_faulty(const Setting& setting) const {
  std::set<std::pair<int, int>> marks{{setting.where.line, setting.where.column}};
  collect_marks(setting.value, marks);
  return std::any_of(diagnostics.errors().begin(), diagnostics.errors().end(),
                     [&](const auto& problem) {
                       return problem.where.file == setting.where.file &&
                              marks.contains({problem.where.line, problem.where.column});
                     });
}

void Planner::Impl::look_without_faulty() {
  std::vector<Setting> settings = spec.settings;
  for (const Axis& axis : spec.axes) {
    if (axis.levels.empty()) return;
    const auto& of_first = axis.levels.front().settings;
    settings.insert(settings.end(), of_first.begin(), of_first.end());
  }
  const std::size_t count = settings.size();
  // One that makes a part of the scenario cannot be left out: what asks for the part would fail.
  for (const Setting& s : settings) {
    if (s.value.is_map() && is_faulty(s)) return;
  }
  std::erase_if(settings, [this](const Setting& s) { return is_faulty(s); });
  if (settings.size() == count) return;
  Node root = *plain;
  Diagnostics own;
  own.add_file(spec.file.generic_string());
  set_all(root, settings, own);
  if (!own.has_errors()) static_cast<void>(resolve(std::move(root), seed_of(1)));
}

/// How many combinations of levels there are; nothing where their runs are too many.
std::optional<std::size_t> Planner::Impl::count_combinations() const {
  std::size_t combinations = 1;
  for (const Axis& axis : spec.axes) {
    combinations *= axis.levels.size();
    if (combinations > k_max_points) break;
  }
  if (combinations * static_cast<std::size_t>(spec.replicates) <= k_max_points) return combinations;
  diagnostics.error(spec.axes.empty() ? spec.where : spec.axes.front().where,
                    "the study has more than " + std::to_string(k_max_points) +
                        " points: take fewer levels, or sample");
  return std::nullopt;
}

/// The level of each axis in the n-th combination; the last axis turns fastest.
std::vector<std::size_t> Planner::Impl::levels_of(std::size_t n) const {
  std::vector<std::size_t> levels(spec.axes.size());
  for (std::size_t a = spec.axes.size(); a-- > 0;) {
    levels[a] = n % spec.axes[a].levels.size();
    n /= spec.axes[a].levels.size();
  }
  return levels;
}

/// The scenario of a combination; nothing where it has problems, which are told.
std::optional<Node> Planner::Impl::combined(std::size_t n) {
  const std::vector<std::size_t> levels = levels_of(n);
  Node root = *base;
  Diagnostics own;
  own.add_file(spec.file.generic_string());
  for (std::size_t a = 0; a < levels.size(); ++a) {
    set_all(root, spec.axes[a].levels[levels[a]].settings, own);
  }
  if (!own.has_errors()) return root;
  print(own, n);
  return std::nullopt;
}

/// The columns of an axis in the table of points, filled for all of them.
void Planner::Impl::add_inputs(std::size_t a, Plan& plan) const {
  const Axis& axis = spec.axes[a];
  std::vector<Column> columns;
  for (std::size_t s = 0; s < axis.paths.size(); ++s) {
    columns.push_back(column_of(axis, a, s, dimensions));
  }
  if (axis.kind == AxisKind::cases) {
    Column column{{"case", "", true, a}, {}};
    for (const Level& level : axis.levels) column.values.push_back({0.0, level.label});
    columns.push_back(std::move(column));
  }
  for (const Column& column : columns) {
    plan.inputs.push_back(column.head);
    for (Point& point : plan.points) point.inputs.push_back(column.values[point.levels[a]]);
  }
}

Plan Planner::plan() {
  Plan plan;
  if (!impl_->base) return plan;
  const auto combinations = impl_->count_combinations();
  if (!combinations) return plan;
  std::map<std::string, std::size_t> by_hash;
  for (std::size_t n = 0; n < *combinations; ++n) {
    const std::vector<std::size_t> levels = impl_->levels_of(n);
    const std::optional<Node> root = impl_->combined(n);
    if (!root) continue;
    for (std::int64_t r = 1; r <= impl_->spec.replicates; ++r) {
      auto point = impl_->resolve(*root, impl_->seed_of(r), n);
      if (!point) break;
      point->levels = levels;
      point->replicate = r;
      const auto [at, is_new] = by_hash.try_emplace(point->hash, plan.points.size());
      if (!is_new) impl_->refuse_twin(plan.points[at->second], *point);
      plan.points.push_back(std::move(*point));
    }
  }
  const PointProblems::Points points{
      *combinations, static_cast<std::size_t>(impl_->spec.replicates),
      [this](std::size_t n) { return values_text(impl_->spec, impl_->levels_of(n)); }};
  impl_->print_kept_errors(points);
  if (plan.points.empty()) impl_->look_without_faulty();
  plan.outputs = impl_->measures.columns();
  plan.read_paths = impl_->read_paths;
  if (impl_->diagnostics.has_errors()) return plan;
  impl_->print_kept_warnings(points);
  for (std::size_t a = 0; a < impl_->spec.axes.size(); ++a) impl_->add_inputs(a, plan);
  return plan;
}

Plan Planner::calibration_columns() {
  Plan plan;
  if (impl_->diagnostics.has_errors()) return plan;
  // Both ends are tried, so that a wrong path, unit or range is told before anything is run.
  const auto& calibration = *impl_->spec.calibration;
  const auto values_of = [&](std::size_t end) {
    std::vector<double> values;
    for (const FreeParameter& p : calibration.parameters) {
      values.push_back(end == 0 ? p.low : p.high);
    }
    return values;
  };
  for (const std::size_t end : {0, 1}) {
    Node root = *impl_->base;
    Diagnostics own;
    own.add_file(impl_->spec.file.generic_string());
    impl_->set_parameters(root, values_of(end), own);
    if (own.has_errors()) {
      impl_->print(own, end);
    } else {
      static_cast<void>(impl_->resolve(root, impl_->seed_of(1), end));
    }
  }
  const PointProblems::Points ends{
      2, 0, [&](std::size_t end) { return impl_->parameters_text(values_of(end)); }};
  impl_->print_kept_errors(ends);
  if (impl_->diagnostics.has_errors()) return plan;
  impl_->print_kept_warnings(ends);
  plan.outputs = impl_->measures.columns();
  plan.read_paths = impl_->read_paths;
  if (impl_->diagnostics.has_errors()) return plan;
  for (const FreeParameter& p : calibration.parameters) {
    const auto found = impl_->dimensions.find(without_index(p.paths.front()));
    const std::string si =
        found == impl_->dimensions.end() ? std::string() : scenario::si_unit(found->second);
    plan.inputs.push_back({p.name, p.unit.empty() ? si : p.unit, false, plan.inputs.size()});
  }
  return plan;
}

std::vector<Point> Planner::calibration_points(const std::vector<double>& values) {
  const auto& calibration = *impl_->spec.calibration;
  Node root = *impl_->base;
  impl_->set_parameters(root, values, impl_->diagnostics);
  std::vector<InputValue> inputs;
  for (std::size_t k = 0; k < calibration.parameters.size(); ++k) {
    inputs.push_back({values[k], scenario::number_text(values[k])});
  }
  const std::string with = " (with " + impl_->parameters_text(values) + ")";
  std::vector<Point> points;
  for (std::int64_t r = 1; r <= impl_->spec.replicates; ++r) {
    auto point = impl_->resolve(root, impl_->seed_of(r), std::nullopt, with);
    impl_->diagnostics.throw_errors();
    point->inputs = inputs;
    point->replicate = r;
    points.push_back(std::move(*point));
  }
  return points;
}

}  // namespace dust::study
