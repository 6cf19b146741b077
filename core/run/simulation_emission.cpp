// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "run/simulation.hpp"

/// Grains into the domain: what emitters propose, and what finds a free place.
namespace dust::run {

void Simulation::propose_seeds(double begin, double end) {
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) propose_seeds_of(n, begin, end);
}

void Simulation::propose_seeds_of(std::size_t n, double begin, double end) {
  const auto& spec = setup_.emitters[n];
  const scenario::FrameSpec* frame =
      spec.frame >= 0 ? &setup_.frames[static_cast<std::size_t>(spec.frame)] : nullptr;
  sdk::EmitterContext context;
  context.begin = begin;
  context.end = end;
  context.grain_density =
      setup_.materials[static_cast<std::size_t>(spec.material)].properties.density;
  context.gravity = setup_.gravity;
  context.random = sdk::Random(setup_.seed, sdk::stream_of(spec.name.c_str()));
  const LazySurroundings surroundings(entry_scene_, dem_->rows(), waiting_,
                                      models_.class_diameters.back(), frame);
  context.surroundings = &surroundings;
  requests_.clear();
  try {
    models_.emitters[n]->propose(context, requests_);
  } catch (const std::exception& problem) {
    throw sdk::ModelError(entry_scene_.names[n] + ": " + problem.what());
  }
  for (const sdk::InsertionRequest& request : requests_) {
    // Carried back to the beginning of the interval; inside the feed nothing but the feed acts.
    Entrant e;
    e.emitter = static_cast<std::int32_t>(n);
    e.line = request.line;
    particles::NewGrain& grain = e.grain;
    grain.position = request.position - (request.time - begin) * request.velocity;
    grain.velocity = request.velocity;
    grain.rotation = request.angular_velocity;
    if (frame != nullptr) {
      const sdk::Vec3 axis = frame->axis / norm(frame->axis);
      grain.position = turned(grain.position, *frame);
      grain.velocity = rotate(grain.velocity, axis, frame->angle);
      grain.rotation = rotate(grain.rotation, axis, frame->angle);
    }
    grain.diameter = request.diameter;
    grain.weight = request.weight;
    grain.material = request.material < 0
                         ? spec.material
                         : spec.more_materials.at(static_cast<std::size_t>(request.material));
    waiting_.push_back(e);
  }
}

void Simulation::emit() {
  if (is_started_) {
    is_started_ = false;
    return;
  }
  entry_scene_.time = time();
  propose_seeds(time(), time() + setup_.time.fluid_step);
  dem_->remove_leavers();
  const auto entering = take_free_places(waiting_, dem_->rows(), entry_scene_);
  delayed_entries_ += static_cast<std::int64_t>(waiting_.size());
  if (!entering.empty()) {
    std::vector<particles::NewGrain> grains;
    grains.reserve(entering.size());
    for (const Entrant& e : entering) {
      grains.push_back(e.grain);
      const auto& material = setup_.materials[static_cast<std::size_t>(e.grain.material)];
      emissions_.enter(static_cast<std::size_t>(e.emitter), e.grain.diameter, e.grain.weight,
                       material.properties.density * sdk::sphere_volume(e.grain.diameter));
    }
    dem_->insert(grains);
  }
  grain_table_.note_births(dem_->rows());
}

}  // namespace dust::run
