// SPDX-License-Identifier: Apache-2.0
#include "unit/scenario/fake_models.hpp"

DUST_PLUGIN(registrar) { fake::add_all(registrar); }
