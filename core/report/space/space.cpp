// SPDX-License-Identifier: Apache-2.0
#include "report/space/space.hpp"

namespace dust::report {

nlohmann::json space_of(const H5Source& source, const Box& box) {
  if (box.is_empty()) return nullptr;
  return {{"min", box.min},
          {"max", box.max},
          {"is_thin", box.is_thin()},
          {"surfaces", surfaces_of(source, box)},
          {"air", box.is_thin() ? nlohmann::json(nullptr) : air_field_of(source)}};
}

}  // namespace dust::report
