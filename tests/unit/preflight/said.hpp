// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unit/scenario/support.hpp"

#include <string>
#include <vector>

namespace dust::test {

/// What the check of a scenario says: all errors in one text, or warnings.
struct Said {
  std::vector<std::string> errors, warnings;
};

/// Of a scenario with the models that are shipped.
inline Said said_of(const std::string& scenario, const std::vector<scenario::Override>& set) {
  static const registry::Registry& models = []() -> const registry::Registry& {
    static registry::Registry all;
    all.load({DUST_TEST_PLUGINS});
    return all;
  }();
  const Folder folder;
  const auto file = folder.write("scenario.yaml", scenario);
  try {
    return {{}, preflight::read_scenario(file, set, models).warnings};
  } catch (const base::UserError& e) {
    return {{e.what()}, {}};
  }
}

}  // namespace dust::test
