// SPDX-License-Identifier: Apache-2.0
#include "run/summary/taken_cost.hpp"

#include <sys/resource.h>

#include <cmath>
#include <string_view>
#include <system_error>

namespace dust::run {
namespace {

namespace fs = std::filesystem;
using preflight::CostTerm;

double folder_bytes(const fs::path& folder) {
  double bytes = 0.0;
  std::error_code error;
  for (fs::recursive_directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    std::error_code ignored;
    if (file->is_regular_file(ignored)) bytes += static_cast<double>(file->file_size(ignored));
  }
  return bytes;
}

CostTerm term_of(std::string_view node) {
  for (const std::string_view name :
       {"synchronise", "neighbour", "contact", "force", "integration"})
    if (node == name) return CostTerm::grains;
  if (node == "fine_level") return CostTerm::fine_grains;
  if (node == "fluid") return CostTerm::fluid;
  for (const std::string_view name : {"voidage", "drag", "collect"}) {
    if (node == name) return CostTerm::exchange;
  }
  for (const std::string_view name : {"dust", "liberation"}) {
    if (node == name) return CostTerm::dust;
  }
  return CostTerm::rest;
}

double cell_count(const Simulation& s) {
  if (s.fluid() == nullptr) return 0.0;
  const auto& n = s.setup().fluid->cells;
  return static_cast<double>(n[0]) * n[1] * n[2];
}

}  // namespace

CountsBefore::Work work_so_far(const Simulation& s) {
  const auto dem = s.dem().report();
  return {.particle_steps = dem.particle_steps,
          .fine_steps = dem.fine_steps,
          .steps = s.steps_done(),
          .fluid_sub_steps = s.fluid() != nullptr ? s.fluid_stage()->sub_steps() : 0,
          .dust_sub_steps = s.dust_stage() != nullptr ? s.dust_stage()->field().sub_steps() : 0};
}

preflight::RunCost taken_cost(const Simulation& s, const RunFacts& facts, const fs::path& folder) {
  preflight::RunCost cost;
  const auto nodes = node_timings(s);
  double sum = facts.output_s;
  for (std::size_t n = 0; n < nodes.size() && n < facts.node_s.size(); ++n) {
    // It holds the nodes of the grains' steps.
    if (nodes[n].name == "dem_cycle") continue;
    cost.terms[term_of(nodes[n].name)].seconds += facts.node_s[n];
    sum += facts.node_s[n];
  }
  cost.terms[CostTerm::output].seconds = facts.output_s;
  const double processors = sum > 0.0 ? facts.cpu_s / sum : 0.0;
  for (std::size_t n = 0; n < preflight::k_cost_terms; ++n) cost.terms[n].seconds *= processors;

  const CountsBefore::Work now = work_so_far(s);
  const CountsBefore::Work before = facts.start ? facts.start->before.work : CountsBefore::Work{};
  const auto steps = static_cast<double>(now.steps - before.steps);
  const double cells = cell_count(s);
  const auto grain_steps = static_cast<double>(now.particle_steps - before.particle_steps);
  cost.terms[CostTerm::grains].amount = grain_steps;
  cost.terms[CostTerm::fine_grains].amount =
      static_cast<double>(now.fine_steps - before.fine_steps);
  if (s.fluid() != nullptr) {
    cost.terms[CostTerm::fluid].amount =
        cells * static_cast<double>(now.fluid_sub_steps - before.fluid_sub_steps);
    cost.terms[CostTerm::exchange].amount =
        grain_steps * s.dem().coarse_step() / s.setup().time.fluid_step + cells * steps;
  }
  if (s.dust_stage() != nullptr) {
    cost.terms[CostTerm::dust].amount =
        cells * static_cast<double>(now.dust_sub_steps - before.dust_sub_steps);
  }
  cost.terms[CostTerm::output].amount = static_cast<double>(facts.frames);
  cost.terms[CostTerm::rest].amount = steps;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  cost.memory_bytes = static_cast<double>(usage.ru_maxrss) * 1024.0;
  cost.disk_bytes = folder_bytes(folder);
  return cost;
}

}  // namespace dust::run
