// SPDX-License-Identifier: Apache-2.0
#include "drag.hpp"

extern "C" __attribute__((visibility("default"))) const dust::sdk::Handshake dust_handshake;
const dust::sdk::Handshake dust_handshake = dust::sdk::make_handshake();
