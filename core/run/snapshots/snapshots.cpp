// SPDX-License-Identifier: Apache-2.0
#include "run/snapshots/snapshots.hpp"

namespace dust::run {

void Snapshots::take(particles::Dem& dem, double time) {
  particles_.publish(dem.rows(), dem.last_force());
  if (wanted_.contacts) contacts_.publish(dem.contacts(time), particles_.order());
}

void Snapshots::take(fluid::FluidSolver& fluid, const fluid::CellField& void_fraction,
                     FaceTable::Moment moment) {
  fluid_->publish(fluid, void_fraction);
  if (faces_) faces_->publish(fluid, void_fraction, moment);
}

void Snapshots::show(sdk::WorldView& view) const {
  view.grains = particles_.columns();
  if (wanted_.contacts) view.contacts = contacts_.columns();
  if (fluid_) view.fluid = fluid_->columns();
  if (faces_) view.fluid.faces = faces_->columns();
}

}  // namespace dust::run
