// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace dust::base {

/// [bytes] That programs may still take without swapping, as Linux tells it; nothing where it does
/// not.
std::optional<double> free_memory();

/// What is wrong with a need of memory [bytes] beside what is free; "" where it fits.
std::string shortage_text(double needed, double free);

}  // namespace dust::base
