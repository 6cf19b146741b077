// SPDX-License-Identifier: Apache-2.0
#include "preflight/reader.hpp"

#include "preflight/derived.hpp"
#include "preflight/dust_check.hpp"
#include "preflight/flow_check.hpp"
#include "scenario/diagnostics.hpp"

#include <stdexcept>

namespace dust::preflight {
namespace {

using Result = std::optional<scenario::ReadResult>;

void check_sides(const scenario::Setup& setup, const registry::Registry& registry,
                 scenario::Diagnostics& diagnostics) {
  const SideModelSet sides(setup, registry);
  check_flow(setup, sides.models(), diagnostics);
}

/// Looks at what was read without errors.
Result checked(Result read, const registry::Registry& registry,
               scenario::Diagnostics& diagnostics) {
  if (!read) return read;
  check_sides(read->setup, registry, diagnostics);
  check_fixed_step(read->setup, registry, diagnostics);
  if (!diagnostics.has_errors()) {
    check_suctions(read->setup, registry, diagnostics);
    check_openings(read->setup, read->dust, registry, diagnostics);
    check_drift(read->setup, read->dust, registry, diagnostics);
  }
  if (diagnostics.has_errors()) return std::nullopt;
  read->warnings = diagnostics.warning_lines();
  return read;
}

}  // namespace

scenario::ReadResult read_scenario(const std::filesystem::path& file,
                                   const std::vector<scenario::Override>& overrides,
                                   const registry::Registry& registry,
                                   const std::vector<std::filesystem::path>& set_files) {
  scenario::Diagnostics diagnostics;
  Result read = checked(scenario::read_file(file, overrides, registry, set_files, diagnostics),
                        registry, diagnostics);
  diagnostics.throw_errors();
  if (!read) throw std::logic_error("a scenario that cannot be read gave no error");
  return std::move(*read);
}

std::optional<scenario::ReadResult> read_tree(const scenario::Node& root,
                                              const std::filesystem::path& file,
                                              const registry::Registry& registry,
                                              scenario::Diagnostics& diagnostics) {
  return checked(scenario::read_tree(root, file, registry, diagnostics), registry, diagnostics);
}

}  // namespace dust::preflight
