// SPDX-License-Identifier: Apache-2.0
#include "run/insertion/insertion.hpp"

#include "base/named.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "setup/mark.hpp"

#include <cmath>
#include <utility>

namespace dust::run {
namespace {

EntryScene entry_scene_of(const scenario::Setup& setup, const preflight::ParticleModels& models) {
  EntryScene scene;
  scene.min = setup.domain.min;
  scene.max = setup.domain.max;
  for (std::size_t d = 0; d < 3; ++d) {
    scene.is_periodic[d] = setup.domain.sides[2 * d].grains == scenario::GrainSide::periodic;
  }
  scene.surfaces = particles::surfaces_of(setup, models.bodies);
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const auto& choice = setup.emitters[n].model;
    scene.rules.push_back(models.emitters[n]->insertion_rule());
    scene.names.push_back(scenario::place(choice.where) + ": error: " + choice.path);
  }
  return scene;
}

/// The turned frame of an emitter, if it has one.
const scenario::FrameSpec* frame_of(const scenario::Setup& setup, std::size_t emitter) {
  const int frame = setup.emitters[emitter].frame;
  return frame >= 0 ? &setup.frames[static_cast<std::size_t>(frame)] : nullptr;
}

}  // namespace

Insertion::Insertion(const scenario::Setup& setup, const preflight::ParticleModels& models)
    : setup_(setup),
      models_(models),
      scene_(entry_scene_of(setup, models)),
      ledger_(models.emitters.size()),
      departures_(setup.domain) {}

void Insertion::propose(double time, const particles::GrainRows& rows) {
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) {
    propose(n, time, time + setup_.time.fluid_step, rows);
  }
}

sdk::EmitterContext Insertion::context_of(std::size_t n, double begin, double end) const {
  const auto& spec = setup_.emitters[n];
  sdk::EmitterContext context;
  context.begin = begin;
  context.end = end;
  context.grain_density =
      setup_.materials[static_cast<std::size_t>(spec.material)].properties.density;
  context.gravity = setup_.gravity;
  context.random = sdk::Random(setup_.seed, sdk::stream_of(spec.name.c_str()));
  return context;
}

void Insertion::propose(std::size_t n, double begin, double end, const particles::GrainRows& rows) {
  sdk::EmitterContext context = context_of(n, begin, end);
  const LazySurroundings surroundings(scene_, rows, waiting_, models_.class_diameters.back(),
                                      frame_of(setup_, n));
  context.surroundings = &surroundings;
  requests_.clear();
  try {
    models_.emitters[n]->propose(context, requests_);
  } catch (const std::exception& problem) {
    throw sdk::ModelError(scene_.names[n] + ": " + problem.what());
  }
  for (const sdk::InsertionRequest& request : requests_) add_waiting(n, begin, request);
}

void Insertion::add_waiting(std::size_t n, double begin, const sdk::InsertionRequest& request) {
  const auto& spec = setup_.emitters[n];
  const scenario::FrameSpec* frame = frame_of(setup_, n);
  // Carried back to the beginning of the interval; inside the feed nothing but the feed acts.
  InsertionCandidate e;
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

void Insertion::start(particles::Dem& dem) {
  insert(0.0, dem);
  is_started_ = true;
}

bool Insertion::run(double time, particles::Dem& dem) {
  if (std::exchange(is_started_, false)) return false;
  insert(time, dem);
  return true;
}

void Insertion::insert(double time, particles::Dem& dem) {
  scene_.time = time;
  propose(time, dem.rows());
  const particles::GrainRows rows = dem.rows();
  departures_.note(rows, dem.openings(), rounding(scene_), {dem.report().steps, time});
  dem.remove_escaped();
  const auto entering = take_without_overlap(waiting_, dem.rows(), scene_);
  delayed_ += static_cast<std::int64_t>(waiting_.size());
  if (entering.empty()) return;
  std::vector<particles::NewGrain> grains;
  grains.reserve(entering.size());
  for (const InsertionCandidate& e : entering) {
    grains.push_back(e.grain);
    const auto& material = setup_.materials[static_cast<std::size_t>(e.grain.material)];
    ledger_.enter(static_cast<std::size_t>(e.emitter), e.grain.diameter, e.grain.weight,
                  e.grain.material,
                  material.properties.density * sdk::sphere_volume(e.grain.diameter));
  }
  dem.insert(grains);
}

void Insertion::rehearse(double time, std::span<const std::size_t> emitters) {
  const particles::GrainRows none;
  scene_.time = time;
  for (const std::size_t n : emitters) propose(n, time, time + setup_.time.fluid_step, none);
  take_without_overlap(waiting_, none, scene_);
  waiting_.clear();
}

double Insertion::waiting_mass(std::size_t emitter) const {
  double mass = 0.0;
  for (const InsertionCandidate& w : waiting_) {
    if (static_cast<std::size_t>(w.emitter) != emitter) continue;
    const auto& material = setup_.materials[static_cast<std::size_t>(w.grain.material)];
    mass += w.grain.weight * material.properties.density * sdk::sphere_volume(w.grain.diameter);
  }
  return mass;
}

std::int64_t Insertion::transfer_from(const Insertion& other) {
  std::vector<std::int32_t> emitters;
  for (const auto& theirs : other.setup_.emitters) {
    emitters.push_back(base::number_of(setup_.emitters, theirs.name));
  }
  std::vector<std::int32_t> materials;
  for (const auto& theirs : other.setup_.materials) {
    materials.push_back(base::number_of(setup_.materials, theirs.name));
  }
  std::vector<double> density;
  for (const auto& material : setup_.materials) density.push_back(material.properties.density);
  ledger_.transfer_from(other.ledger_, emitters, materials, density);
  departures_ = other.departures_;  // of the same domain
  delayed_ = other.delayed_;
  for (InsertionCandidate e : other.waiting_) {
    e.emitter = emitters[static_cast<std::size_t>(e.emitter)];
    e.grain.material = materials[static_cast<std::size_t>(e.grain.material)];
    if (e.emitter >= 0 && e.grain.material >= 0) waiting_.push_back(e);
  }
  return static_cast<std::int64_t>(other.waiting_.size() - waiting_.size());
}

void Insertion::pass_time(std::size_t n, double time) {
  // Step by step, as in a run: what an emitter keeps of the past is then the same, and no more.
  const double step = setup_.time.fluid_step;
  const std::int64_t steps = std::llround(time / step);
  try {
    for (std::int64_t k = 0; k < steps; ++k) {
      const double begin = static_cast<double>(k) * step;
      requests_.clear();
      models_.emitters[n]->propose(context_of(n, begin, begin + step), requests_);
    }
  } catch (const std::exception& problem) {
    throw sdk::ModelError(scene_.names[n] + ": " + problem.what());
  }
  requests_.clear();
}

void Insertion::save(sdk::ArchiveWriter& archive) const {
  archive.integer("delayed_entries", delayed_);
  archive.integer("is_started", is_started_ ? 1 : 0);
  save_waiting(waiting_, archive);
  ledger_.save(archive);
  departures_.save(archive);
}

void Insertion::load(sdk::ArchiveReader& archive) {
  delayed_ = archive.integer("delayed_entries");
  is_started_ = archive.integer("is_started") != 0;
  load_waiting(waiting_, archive);
  ledger_.load(archive);
  departures_.load(archive);
}

}  // namespace dust::run
