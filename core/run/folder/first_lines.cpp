// SPDX-License-Identifier: Apache-2.0
#include "run/folder/first_lines.hpp"

#include "particles/time_steps.hpp"
#include "scenario/text/units.hpp"

#include <cstdio>

namespace dust::run {
namespace {

using Lines = std::vector<std::string>;

/// What meshes say of themselves, and how fine they are beside the grains.
void add_bodies(const Simulation& simulation, Lines& lines) {
  const auto& diameters = simulation.models().class_diameters;
  for (const auto& body : simulation.models().bodies) {
    for (const std::string& remark : body.shape->notes()) {
      lines.push_back("body " + body.name + ": " + remark);
    }
    const double edge = body.shape->shortest_edge();
    if (!(edge > 0.0) || diameters.empty()) continue;
    char text[120];
    std::snprintf(text, sizeof text, ": the shortest edge is %.3g of the largest grain's diameter",
                  edge / diameters.back());
    lines.push_back("body " + body.name + text);
  }
}

void add_start(const StartFacts& s, Lines& lines) {
  lines.push_back("starts from " + s.state + " at " + scenario::number_text(s.time) + " s with " +
                  std::to_string(s.particles) + " grains, " + std::to_string(s.contacts) +
                  " contacts in touch" +
                  (s.is_same ? "; the scenario is the same: the same bits as if not cut" : ""));
}

/// As `engine check` tells them, every digit of them.
void add_steps(const Simulation& simulation, Lines& lines) {
  const particles::TimeSteps& steps = simulation.dem().time_steps();
  lines.push_back("time step " + scenario::number_text(steps.coarse_step) + " s");
  if (simulation.models().class_diameters.empty()) return;
  for (const auto& c : steps.classes) {
    lines.push_back("grains of " + scenario::number_text(c.diameter) + " m: stable step " +
                    scenario::number_text(c.stable_step) + " s, step " +
                    scenario::number_text(steps.step_of(c)) + " s");
  }
}

void add_moisture(const Simulation& simulation, Lines& lines) {
  const LiberationStage* liberation = simulation.liberation();
  if (liberation == nullptr) return;
  for (const std::string& line : liberation->moisture_lines(simulation.setup().materials)) {
    lines.push_back(line);
  }
}

}  // namespace

std::vector<std::string> first_lines(const Simulation& simulation, const RunFacts& facts) {
  Lines lines;
  if (facts.start) add_start(*facts.start, lines);
  add_bodies(simulation, lines);
  add_steps(simulation, lines);
  add_moisture(simulation, lines);
  return lines;
}

}  // namespace dust::run
