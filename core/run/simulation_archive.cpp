// SPDX-License-Identifier: Apache-2.0
#include "run/simulation.hpp"

#include <span>

/// The state of a run: its digest, and its parts in a checkpoint.
namespace dust::run {

std::string Simulation::state_digest() const {
  io::Sha256 sha;
  const auto update = [&sha](const auto& span) { sha.update(span.data(), span.size_bytes()); };
  const auto c = grain_table_.columns();
  update(c.id);
  for (const auto& column : {c.x, c.y, c.z, c.velocity_x, c.velocity_y, c.velocity_z,
                             c.angular_velocity_x, c.angular_velocity_y, c.angular_velocity_z}) {
    update(column);
  }
  if (fluid_) {
    for (int k = 0; k < grid_.count[2]; ++k) {
      for (int j = 0; j < grid_.count[1]; ++j) {
        const auto from = static_cast<std::size_t>(grid_.index(0, j, k));
        const auto count = static_cast<std::size_t>(grid_.count[0]);
        for (const auto& component : fluid_->velocity().component) {
          update(std::span(component).subspan(from, count));
        }
        update(std::span(fluid_->pressure()).subspan(from, count));
      }
    }
  }
  return sha.hex_digest();
}

Simulation::SaveParts Simulation::save_parts() const {
  SaveParts parts;
  parts.emplace_back("clock", [this](sdk::ArchiveWriter& a) {
    a.integer("steps_done", steps_done_);
    a.integer("fluid_sub_steps", fluid_sub_steps_);
    a.integer("pressure_iterations", pressure_iterations_);
    a.integer("delayed_entries", delayed_entries_);
    a.integer("is_started", is_started_ ? 1 : 0);
    save_waiting(waiting_, a);
    emissions_.save(a);
  });
  parts.emplace_back("bodies", [this](sdk::ArchiveWriter& a) {
    std::vector<double> removed_at;
    for (const auto& body : models_.bodies) removed_at.push_back(body.removed_at);
    a.numbers("removed_at", removed_at);
  });
  parts.emplace_back("grains", [this](sdk::ArchiveWriter& a) { dem_->save(a); });
  parts.emplace_back("columns", [this](sdk::ArchiveWriter& a) { grain_table_.save(a); });
  if (fluid_) {
    parts.emplace_back("fluid", [this](sdk::ArchiveWriter& a) { fluid_->save(a); });
  }
  if (coupling_) {
    parts.emplace_back("coupling", [this](sdk::ArchiveWriter& a) { coupling_->save(a); });
  }
  if (held_fluid_) {
    parts.emplace_back("held_fluid", [this](sdk::ArchiveWriter& a) {
      held_fluid_->each(
          [&](const std::string& name, const auto& field) { a.numbers(name, field); });
    });
  }
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) {
    parts.emplace_back("emitter." + setup_.emitters[n].name,
                       [this, n](sdk::ArchiveWriter& a) { models_.emitters[n]->save(a); });
  }
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    parts.emplace_back("sensor." + setup_.sensors[n].name,
                       [this, n](sdk::ArchiveWriter& a) { models_.sensors[n]->save(a); });
  }
  return parts;
}

Simulation::LoadParts Simulation::load_parts() {
  LoadParts parts;
  parts.emplace_back("clock", [this](sdk::ArchiveReader& a) {
    steps_done_ = a.integer("steps_done");
    fluid_sub_steps_ = a.integer("fluid_sub_steps");
    pressure_iterations_ = a.integer("pressure_iterations");
    delayed_entries_ = a.integer("delayed_entries");
    is_started_ = a.integer("is_started") != 0;
    load_waiting(waiting_, a);
    emissions_.load(a);
  });
  parts.emplace_back("bodies", [this](sdk::ArchiveReader& a) {
    const auto removed_at = a.numbers("removed_at");
    for (std::size_t b = 0; b < models_.bodies.size(); ++b) {
      models_.bodies[b].removed_at = removed_at.at(b);
    }
  });
  parts.emplace_back("grains", [this](sdk::ArchiveReader& a) { dem_->load(a); });
  if (fluid_) {
    parts.emplace_back("fluid", [this](sdk::ArchiveReader& a) {
      fluid_->load(a, time());
      take_open_fraction();
      if (!coupling_) fluid_table_->publish(*fluid_, void_fraction());
    });
  }
  if (coupling_) {
    parts.emplace_back("coupling", [this](sdk::ArchiveReader& a) {
      coupling_->load(a);
      fluid_table_->publish(*fluid_, void_fraction());
    });
  }
  if (held_fluid_) {
    parts.emplace_back("held_fluid", [this](sdk::ArchiveReader& a) {
      held_fluid_->each([&](const std::string& name, auto& field) { field = a.numbers(name); });
    });
  }
  // Last, so that the places of the last sample are those saved, not those just published.
  parts.emplace_back("columns", [this](sdk::ArchiveReader& a) {
    publish_grains();
    grain_table_.load(a);
  });
  for (std::size_t n = 0; n < models_.emitters.size(); ++n) {
    parts.emplace_back("emitter." + setup_.emitters[n].name,
                       [this, n](sdk::ArchiveReader& a) { models_.emitters[n]->load(a); });
  }
  for (std::size_t n = 0; n < models_.sensors.size(); ++n) {
    parts.emplace_back("sensor." + setup_.sensors[n].name,
                       [this, n](sdk::ArchiveReader& a) { models_.sensors[n]->load(a); });
  }
  return parts;
}

}  // namespace dust::run
