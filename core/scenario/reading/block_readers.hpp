// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/blocks.hpp"
#include "scenario/reading/reading.hpp"

/// Readers of the blocks of a scenario, in the order in which read_setup() calls them: each reads
/// its block to the Setup and, side by side, to the resolved tree. The files are named by subject.
namespace dust::scenario {

// read_domain.cpp
void read_general(Reading& reading, MapReader& top);
// read_start.cpp
void read_start(Reading& reading, MapReader& top);
// read_domain.cpp
void read_time(Reading& reading, MapReader& top);
void read_domain(Reading& reading, MapReader& top);
// read_grains.cpp
void read_materials(Reading& reading, MapReader& top);
void read_interactions(Reading& reading, MapReader& top);
// read_bodies.cpp
void read_frames(Reading& reading, MapReader& top);
void read_bodies(Reading& reading, MapReader& top);
// read_grains.cpp
void read_emitters(Reading& reading, MapReader& top);
// read_air.cpp
void read_fluid(Reading& reading, MapReader& top);
void read_coupling(Reading& reading, MapReader& top);
/// `coupling.resolved`: spheres whose flow the grid resolves; read_resolved.cpp.
void read_resolved(Reading& reading, const CouplingBlock& coupling, const Entry* entry);
void read_drag_and_voidage(Reading& reading, MapReader& top);
void read_fluid_forces(Reading& reading, MapReader& top);
// read_dust.cpp
/// What counts as dust, by size and material, and through what it gets out.
void read_dust(Reading& reading, MapReader& top);
/// `dust.field`: concentrations on the fluid's grid; read_dust_field.cpp.
void read_dust_field(Reading& reading, MapReader& dust, Node& written);
/// `dust.liberation`: how the dust on grains becomes airborne; read_liberation.cpp.
void read_liberation(Reading& reading, MapReader& dust, Node& written);
/// `dust_load` and `moisture` of materials, against field and law; of a law that could not be read
/// nothing is said.
void check_dust_loads(Reading& reading, const sdk::Model* law, bool is_law_read = true);
/// `audit: {energy: true}`; read_audit.cpp.
void read_audit(Reading& reading, MapReader& top);
void check_audit(Reading& reading);

/// A rule of the void fraction is valid up to a size of grains relative to the cells.
void check_voidage(Reading& reading);
/// Sizes and densities of the grains that are to be resolved.
void check_resolved(Reading& reading);
bool is_resolved(const Reading& reading, const EmitterSpec& emitter);

}  // namespace dust::scenario
