// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/air_passage.hpp"

namespace dust::preflight {
namespace {

using scenario::Setup;
using sdk::SideRule;

/// [s] Flows that begin later are no flows of any run.
constexpr double k_latest = 1e6;

/// A run that is given a later end is to find the same answer.
std::vector<double> instants_of_longer_runs(const Setup& setup, const SideModels& sides) {
  std::vector<double> times = instants(setup, sides);
  for (double later = setup.time.end; later < k_latest; later *= 10.0) times.push_back(later);
  return times;
}

}  // namespace

bool passes_air(const Setup& setup, std::size_t side, const SideModels& sides) {
  const sdk::BoundaryCondition* model = sides[side];
  if (!setup.fluid || model == nullptr) return false;
  if (model->rules().normal_velocity != SideRule::fixed) return true;
  if (is_too_large(setup, side)) return model->needs_flow();
  SideFaces faces(setup, side);
  for (const double time : instants_of_longer_runs(setup, sides)) {
    faces.ask(*model, time);
    if (faces.is_passed()) return true;
  }
  return false;
}

std::vector<bool> passed_faces(const Setup& setup, std::size_t side, const SideModels& sides) {
  const sdk::BoundaryCondition* model = sides[side];
  if (!setup.fluid || model == nullptr) return {};
  if (model->rules().normal_velocity != SideRule::fixed || is_too_large(setup, side)) return {};
  SideFaces faces(setup, side);
  std::vector<bool> passed(SideFaces::count_of(setup, side), false);
  for (const double time : instants_of_longer_runs(setup, sides)) {
    faces.ask(*model, time);
    faces.note_passed(passed);
  }
  return passed;
}

bool passes_air_everywhere(const Setup& setup, std::size_t side, const SideModels& sides) {
  if (sides[side] == nullptr) return false;
  const sdk::BoundaryCondition& model = *sides[side];
  if (model.rules().normal_velocity != SideRule::fixed) return true;
  if (is_too_large(setup, side)) return false;
  SideFaces faces(setup, side);
  for (const double time : instants(setup, sides)) {
    faces.ask(model, time);
    if (faces.is_passed_everywhere()) return true;
  }
  return false;
}

}  // namespace dust::preflight
