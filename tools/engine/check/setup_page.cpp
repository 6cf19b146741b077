// SPDX-License-Identifier: Apache-2.0
#include "check/setup_page.hpp"

#include "bodies/body_set.hpp"
#include "report/page.hpp"
#include "report/setup_document.hpp"
#include "run/summary/summary_models.hpp"

#include <nlohmann/json.hpp>

namespace dust::engine {

std::string setup_page(const scenario::Setup& setup, const scenario::DustSetup& dust,
                       const registry::Registry& registry, const std::string& check) {
  bodies::BodySet bodies;
  for (const auto& spec : setup.bodies) bodies.push_back(bodies::make_body(setup, spec, nullptr));
  const auto document = report::setup_document(
      setup, bodies, run::setting_json(setup, dust, registry), nlohmann::json::parse(check));
  return report::page_of(report::Templates(), "setup.html", document);
}

}  // namespace dust::engine
