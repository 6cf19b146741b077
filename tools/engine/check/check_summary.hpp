// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/body_survey.hpp"
#include "preflight/derived.hpp"
#include "preflight/learnt_costs.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <string>

namespace dust::engine {

/// What a scenario will do, for a person to read before it is run. `cost` is that of `derived` as
/// runs on this machine have corrected it.
std::string check_summary(const scenario::Setup& setup, const scenario::DustSetup& dust,
                          const preflight::Derived& derived, const preflight::BodySurvey& survey,
                          const preflight::LearntCosts::Expected& cost);

/// The numbers of it, for programs; times on one core.
std::string check_json(const scenario::Setup& setup, const scenario::DustSetup& dust,
                       const preflight::Derived& derived, const preflight::BodySurvey& survey,
                       const preflight::LearntCosts::Expected& cost);

}  // namespace dust::engine
