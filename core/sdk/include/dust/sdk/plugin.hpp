// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/cohesion_law.hpp"
#include "dust/sdk/contact_law.hpp"
#include "dust/sdk/drag_law.hpp"
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "dust/sdk/kernel.hpp"
#include "dust/sdk/liberation_law.hpp"
#include "dust/sdk/motion.hpp"
#include "dust/sdk/sensor.hpp"
#include "dust/sdk/turbulence_model.hpp"
#include "dust/sdk/voidage_rule.hpp"

#include <cstdint>

namespace dust::sdk {

/// Raised with every change of a struct or virtual function in this folder.
inline constexpr std::uint32_t k_interface_version = 14;

/// What both sides of the plugin boundary must agree on, compared before any virtual call.
struct Handshake {
  std::uint32_t interface_version;
  std::uint32_t compiler_major;
  std::uint32_t size_of[13];
  std::uint32_t alignment_of[13];
  std::uint32_t standard_library_abi;
};

/// The handshake of the translation unit that calls it.
constexpr Handshake make_handshake() {
  return {k_interface_version,
          __GNUC__,
          {sizeof(ContactBatch), sizeof(DragBatch), sizeof(VoidageBatch), sizeof(SideBatch),
           sizeof(SurfaceBatch), sizeof(InsertionRequest), sizeof(WorldView), sizeof(Parameter),
           sizeof(CohesionBatch), sizeof(FluidForceBatch), sizeof(TurbulenceBatch),
           sizeof(GrainImpacts), sizeof(GrainWind)},
          {alignof(ContactBatch), alignof(DragBatch), alignof(VoidageBatch), alignof(SideBatch),
           alignof(SurfaceBatch), alignof(InsertionRequest), alignof(WorldView), alignof(Parameter),
           alignof(CohesionBatch), alignof(FluidForceBatch), alignof(TurbulenceBatch),
           alignof(GrainImpacts), alignof(GrainWind)},
#ifdef _GLIBCXX_USE_CXX11_ABI
          _GLIBCXX_USE_CXX11_ABI
#else
          0
#endif
  };
}

}  // namespace dust::sdk

/// Defines the two symbols a plugin library exports. Use once per library:
/// `DUST_PLUGIN(registrar) { registrar.add<MyLaw>(); }`
#define DUST_PLUGIN(registrar)                                                                   \
  extern "C" __attribute__((visibility("default"))) const ::dust::sdk::Handshake dust_handshake; \
  const ::dust::sdk::Handshake dust_handshake = ::dust::sdk::make_handshake();                   \
  extern "C" __attribute__((visibility("default"))) void dust_register(                          \
      ::dust::sdk::Registrar& registrar)
