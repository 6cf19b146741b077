// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "study/point_store.hpp"

#include <string>
#include <vector>

namespace dust::study {

/// Throws base::UserError where points of a study that is resumed were run with other versions of
/// their models than there are now: one table would hold both. Points that failed do not count.
void refuse_changed_models(const Plan& plan, const PointStore& store,
                           const registry::Registry& registry);

/// One line per model whose library is another one than that of points which were run before,
/// though its version is the same. What comes with the engine is the engine's.
std::vector<std::string> rebuilt_models(const Plan& plan, const PointStore& store,
                                        const registry::Registry& registry);

}  // namespace dust::study
