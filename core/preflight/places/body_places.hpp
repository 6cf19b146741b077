// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// Warns of bodies that stay where they are and have no surface in the domain: mostly the wrong
/// unit of a mesh.
void check_body_places(const scenario::Setup& setup, const ParticleModels& models,
                       scenario::Diagnostics& diagnostics);

/// Warns of meshes that are smaller than the smallest grain or than a cell of the fluid: drawn in
/// metres and read with `unit: 1 mm`.
void check_mesh_sizes(const scenario::Setup& setup, const ParticleModels& models,
                      scenario::Diagnostics& diagnostics);

/// Warns of bodies that are to be taken away when the run has ended.
void check_removals(const scenario::Setup& setup, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
