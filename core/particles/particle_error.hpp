// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/forces/contact_forces.hpp"
#include "particles/neighbours/inner_list.hpp"

#include <cstddef>
#include <string>

namespace dust::particles {

/// Stops the run for one particle, named with its place, velocity, last contact and the nearest
/// surface: `what` has happened to it, and what is the likely `cause`, unless it is in a nip.
[[noreturn]] void throw_particle_error(const ContactScene& scene, const InnerList& lists,
                                       std::size_t row, const std::string& what,
                                       const std::string& cause);
/// The same where its position or velocity is not a number.
[[noreturn]] void throw_not_a_number(const ContactScene& scene, const InnerList& lists,
                                     std::size_t row);

}  // namespace dust::particles
