// SPDX-License-Identifier: Apache-2.0
#include "run/snapshots/snapshots.hpp"

namespace dust::run {

void Snapshots::take(particles::Dem& dem) {
  particles_.publish(dem.rows(), dem.last_force());
  if (wants_contacts_) contacts_.publish(dem.contacts(), particles_.order());
}

void Snapshots::show(sdk::WorldView& view) const {
  view.grains = particles_.columns();
  if (wants_contacts_) view.contacts = contacts_.columns();
  if (fluid_) view.fluid = fluid_->columns();
}

}  // namespace dust::run
