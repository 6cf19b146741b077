// SPDX-License-Identifier: Apache-2.0
#include "run/branch/preview.hpp"

#include "run/branch/branch.hpp"
#include "run/branch/origin.hpp"
#include "run/folder/input_digests.hpp"

namespace dust::run {

std::optional<StartFacts> preview_start(const scenario::ReadResult& read,
                                        const registry::Registry& registry,
                                        scenario::Diagnostics& diagnostics) {
  if (!read.start.from) return std::nullopt;
  const scenario::StartSpec& start = *read.start.from;
  if (!has_origin(start)) {
    diagnostics.error(start.where, "start_from: " + no_origin_text(start));
    return std::nullopt;
  }
  Branch branch(read, InputDigests().of(read), registry, diagnostics);
  Models models = make_models(read.setup, registry);
  branch.add_diameters(models);
  const auto particles = make_particles(read.setup, models, read.dust);
  branch.check(models, *particles);
  return StartFacts{.state = branch.origin().state().file().string(),
                    .time = branch.origin().time(),
                    .particles = branch.particles_there(),
                    .is_same = branch.is_same()};
}

}  // namespace dust::run
