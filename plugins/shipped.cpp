// SPDX-License-Identifier: Apache-2.0
// In every library that is shipped with the engine: its models have the engine's own tests, so the
// engine does not look after each of their numbers (core/registry/guard.hpp).
extern "C" __attribute__((visibility("default"))) const char dust_shipped;
constinit const char dust_shipped = 1;
