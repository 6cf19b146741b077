// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "study/point_store.hpp"

namespace dust::study {

/// Throws base::UserError where points of a study that is resumed were run with other versions of
/// their models than there are now: one table would hold both. Points that failed do not count.
void refuse_changed_models(const Plan& plan, const PointStore& store,
                           const registry::Registry& registry);

}  // namespace dust::study
