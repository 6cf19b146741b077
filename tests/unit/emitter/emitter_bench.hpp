// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/error.hpp"
#include "support/dem_rig.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dust::test {

using Parameters = std::map<std::string, sdk::Value>;

inline std::unique_ptr<sdk::Emitter> emitter(const std::string& name, const Parameters& p) {
  return ModelLoader::make<sdk::Emitter>("emitter", name, p);
}

inline sdk::EmitterContext context(double begin, double end, double density = 2650.0) {
  sdk::EmitterContext c;
  c.begin = begin;
  c.end = end;
  c.grain_density = density;
  c.gravity = {0, 0, -9.81};
  c.random = sdk::Random(1, 42);
  return c;
}

/// All requests of the first millisecond.
inline std::vector<sdk::InsertionRequest> requests_of(sdk::Emitter& e, double density = 2650.0) {
  std::vector<sdk::InsertionRequest> requests;
  e.propose(context(0.0, 1e-3, density), requests);
  return requests;
}

/// The text of a ParameterError.
inline std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const sdk::ParameterError& e) {
    return e.what();
  }
  return "not refused";
}

/// Pairs that overlap, by brute force.
inline std::size_t overlaps(const std::vector<sdk::InsertionRequest>& requests) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    for (std::size_t j = i + 1; j < requests.size(); ++j) {
      const sdk::Vec3 apart = requests[i].position - requests[j].position;
      const double reach = 0.5 * (requests[i].diameter + requests[j].diameter);
      count += dot(apart, apart) < reach * reach ? 1 : 0;
    }
  }
  return count;
}

}  // namespace dust::test
