// SPDX-License-Identifier: Apache-2.0
#include "run/folder/recorder.hpp"

#include "base/write_error.hpp"
#include "io/atomic_file.hpp"
#include "run/branch/origin.hpp"
#include "run/branch/past.hpp"
#include "run/snapshots/sensor_fields.hpp"
#include "run/summary/figure_json.hpp"
#include "run/summary/first_row.hpp"
#include "run/summary/series_row.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace dust::run {
namespace {

namespace fs = std::filesystem;
using Clock = RunTimes::Clock;

constexpr const char* k_checkpoint_file = "checkpoint.h5";
constexpr const char* k_series_file = "series.csv";

std::int64_t steps(const scenario::TimeSpec& time, double every) {
  return std::llround(every / time.fluid_step);
}

}  // namespace

Intervals::Intervals(const scenario::TimeSpec& time, double keep_every)
    : frame(std::max<std::int64_t>(1, steps(time, time.output_every))),
      checkpoint(time.checkpoint_every > 0.0
                     ? std::max<std::int64_t>(1, steps(time, time.checkpoint_every))
                     : frame),
      row(std::max<std::int64_t>(1, frame / 20)),
      kept(steps(time, keep_every)) {}

Recorder::Recorder(Simulation& simulation, fs::path folder, io::ScenarioIdentity scenario,
                   std::vector<UsedModel> models, double keep_every)
    : simulation_(simulation),
      folder_(std::move(folder)),
      scenario_(std::move(scenario)),
      models_(std::move(models)),
      every_(simulation_.setup().time, keep_every) {}

io::Resumption Recorder::resume() {
  const fs::path checkpoint = folder_ / k_checkpoint_file;
  refuse_changed_models(checkpoint, models_);
  auto parts = simulation_.load_parts();
  parts.emplace_back("files", [this](sdk::ArchiveReader& a) {
    frames_ = a.integer("frames");
    forces_.load(a);
    rows_ = a.integer("rows");
    times_.load(a);
  });
  io::Resumption resumption = io::read_checkpoint(checkpoint, scenario_, parts);
  scenario_.inputs = resumption.inputs;
  is_resumed_ = true;
  return resumption;
}

void Recorder::open() {
  std::vector<std::string> materials;
  for (const auto& m : simulation_.setup().materials) materials.push_back(m.name);
  const auto& domain = simulation_.setup().domain;
  results_ = std::make_unique<io::ResultsFile>(folder_, is_resumed_ ? frames_ : -1,
                                               simulation_.models().bodies, materials, domain.min,
                                               domain.max);
  series_ = std::make_unique<io::SeriesFile>(folder_ / k_series_file, is_resumed_ ? rows_ : -1);
  if (is_resumed_) drop_end();
}

void Recorder::drop_end() const {
  for (const char* name : {"summary.json", "report.json", "report.html"}) {
    std::error_code problem;
    fs::remove(folder_ / name, problem);
    if (problem) throw base::WriteError(folder_ / name, problem.value());
  }
}

void Recorder::write_scenario() const {
  io::write_text(folder_ / "scenario.yaml", scenario_.resolved_yaml);
}

void Recorder::write_frame() {
  const auto begin = Clock::now();
  io::Frame frame;
  if (simulation_.steps_done() > 0) simulation_.sample_forces(forces_);
  frame.number = frames_;
  frame.time = simulation_.time();
  frame.world = simulation_.world();
  frame.momentum_exchange = simulation_.momentum_exchange();
  if (simulation_.has_changing_walls()) frame.bodies = &simulation_.models().bodies;
  frame.fields = fields_of_sensors(simulation_);
  if (const DustStage* dust = simulation_.dust_stage()) frame.fluid_fields = dust->fields();
  if (const LiberationStage* liberation = simulation_.liberation()) {
    for (io::SensorField& field : liberation->fields()) {
      frame.fluid_fields.push_back(std::move(field));
    }
  }
  results_->append(frame);
  ++frames_;
  times_.add_output(begin);
}

void Recorder::write_first_row(const RunFacts& facts) {
  io::write_text(folder_ / (std::string(k_series_file) + "-metadata.json"),
                 series_metadata(simulation_).dump(1) + "\n");
  // Means that sensors take over rows have not begun yet, or go on from another run's.
  const std::vector<std::string> none;
  const auto row =
      first_row(simulation_, *facts.registry, facts.start ? facts.start->sensors : none);
  series_->append(row.names, row.values);
}

void Recorder::write_row() {
  const auto row = series_row(simulation_);
  series_->append(row.names, row.values);
  for (const auto& sensor : simulation_.models().sensors) sensor->end_row();
}

void Recorder::checkpoint(const RunFacts& facts) {
  const auto begin = Clock::now();
  results_->sync();
  series_->sync();
  auto parts = simulation_.save_parts();
  parts.emplace_back("files", [this](sdk::ArchiveWriter& a) {
    a.integer("frames", frames_);
    forces_.save(a);
    a.integer("rows", series_->rows());
    times_.save(a, node_seconds(simulation_, times_.nodes_before()));
  });
  parts.emplace_back(k_models_part, [this](sdk::ArchiveWriter& a) { save_models(models_, a); });
  parts.emplace_back(k_past_part, [&facts](sdk::ArchiveWriter& a) {
    save_past({facts.start, facts.past_warnings}, a);
  });
  const fs::path file = folder_ / k_checkpoint_file;
  io::write_checkpoint(file, scenario_, parts);
  if (every_.is_kept(simulation_.steps_done())) {
    io::keep_checkpoint(file, kept_checkpoint(folder_, simulation_.time()));
  }
  times_.add_output(begin);
}

void Recorder::note_progress(RunFacts& facts) const {
  facts.wall_s = times_.wall();
  facts.cpu_s = times_.cpu();
  facts.node_s = node_seconds(simulation_, times_.nodes_before());
  facts.output_s = times_.output();
  facts.frames = frames_;
  facts.forces = forces_;
}

}  // namespace dust::run
