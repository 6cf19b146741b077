// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/plugin_library.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace dust::test {

/// A model of some kind found among the plugins, ready to be called.
template <class Kind>
struct Found {
  sdk::ModelInfo info;
  std::unique_ptr<Kind> model;
};

/// Every model of a kind that needs no parameters, of all plugin libraries of that kind.
template <class Kind>
std::vector<Found<Kind>> all_models() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(DUST_TEST_PLUGINS)) {
    const std::string name = entry.path().stem().string();
    if (name.starts_with(std::string(Kind::k_kind) + "_")) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  std::vector<Found<Kind>> models;
  for (const std::string& name : names) {
    PluginLibrary library(name);
    for (PluginLibrary::Offer& offer : library.offers) {
      std::vector<sdk::Value> values;
      bool is_complete = offer.info.kind == Kind::k_kind;
      for (const sdk::Parameter& parameter : offer.info.parameters) {
        is_complete = is_complete && !parameter.is_required;
        values.push_back(parameter.default_value);
      }
      if (!is_complete) continue;
      std::unique_ptr<sdk::Model> model = offer.factory(values);
      models.push_back({offer.info, std::unique_ptr<Kind>(static_cast<Kind*>(model.release()))});
    }
  }
  return models;
}

/// The README of a model's folder, empty if there is none.
inline std::string readme_of(const sdk::ModelInfo& info) {
  std::ifstream file(std::string(DUST_SOURCE) + "/plugins/" + info.kind + "/" + info.name +
                     "/README.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace dust::test
