// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"

#include <ostream>
#include <string>
#include <vector>

namespace dust::engine {

/// What there is to tell, of a plugin or of a shape of the core.
struct Subject {
  sdk::ModelInfo info;
  std::string file;
};

/// All models and shapes, sorted by kind and name.
std::vector<Subject> subjects(const registry::Registry& registry);
/// Kinds in alphabetical order.
std::vector<std::string> kinds_of(const std::vector<Subject>& all);

/// The models of one kind, a line each: name and summary; `with_parameters` adds those, one line
/// per model.
void print_kind(std::ostream& out, const std::vector<Subject>& all, const std::string& kind,
                bool with_parameters);

}  // namespace dust::engine
