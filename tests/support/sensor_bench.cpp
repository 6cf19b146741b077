// SPDX-License-Identifier: Apache-2.0
#include "support/sensor_bench.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace dust::test {
namespace {

class OneModel final : public sdk::Registrar {
 public:
  void add(sdk::ModelInfo info, sdk::ModelFactory factory) override {
    kind = {std::move(info), std::move(factory)};
  }
  SensorKind kind;
};

}  // namespace

SensorKind load_sensor(const std::string& name) {
  const std::string file = std::string(DUST_TEST_PLUGINS) + "/sensor_" + name + ".so";
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(::dlerror());
  using Register = void (*)(sdk::Registrar&);
  const auto enter = reinterpret_cast<Register>(::dlsym(library, "dust_register"));
  if (enter == nullptr) throw std::runtime_error(file + " has no entry point");
  OneModel registrar;
  enter(registrar);
  return registrar.kind;
}

std::unique_ptr<sdk::Sensor> SensorKind::make(
    const std::map<std::string, sdk::Value>& parameters) const {
  std::vector<sdk::Value> values;
  std::size_t used = 0;
  for (const sdk::Parameter& p : info.parameters) {
    const auto given = parameters.find(p.name);
    used += given != parameters.end();
    values.push_back(given != parameters.end() ? given->second : p.default_value);
  }
  if (used != parameters.size()) throw std::runtime_error("a parameter is not in the schema");
  return std::unique_ptr<sdk::Sensor>(static_cast<sdk::Sensor*>(factory(values).release()));
}

}  // namespace dust::test
