// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/plugin.hpp"

#include <dlfcn.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace dust::test {

/// The models of one plugin library, straight from its entry point.
class PluginLibrary final : public sdk::Registrar {
 public:
  struct Offer {
    sdk::ModelInfo info;
    sdk::ModelFactory factory;
  };

  /// `name` is that of the library without its ending, for example "drag_ergun".
  explicit PluginLibrary(const std::string& name) {
    const std::string file = std::string(DUST_TEST_PLUGINS) + "/" + name + ".so";
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    const auto enter = reinterpret_cast<void (*)(sdk::Registrar&)>(dlsym(library, "dust_register"));
    if (enter == nullptr) throw std::runtime_error(file + " has no entry point");
    enter(*this);
  }
  void add(sdk::ModelInfo info, sdk::ModelFactory factory) override {
    offers.push_back({std::move(info), std::move(factory)});
  }

  std::vector<Offer> offers;
};

/// The one model of a library that needs no parameters.
template <class Kind>
std::unique_ptr<Kind> make_model(const std::string& kind, const std::string& name) {
  const PluginLibrary library(kind + "_" + name);
  const std::vector<sdk::Value> values(library.offers.at(0).info.parameters.size());
  std::unique_ptr<sdk::Model> model = library.offers.at(0).factory(values);
  return std::unique_ptr<Kind>(static_cast<Kind*>(model.release()));
}

}  // namespace dust::test
