// SPDX-License-Identifier: Apache-2.0
#include "report/space/space.hpp"

namespace dust::report {

nlohmann::json space_of(const H5Source& source, const Box& box,
                        const std::vector<std::string>& dust_classes) {
  if (box.is_empty()) return nullptr;
  const nlohmann::json air = box.is_thin() ? nlohmann::json(nullptr) : air_field_of(source);
  return {{"min", box.min},
          {"max", box.max},
          {"is_thin", box.is_thin()},
          {"surfaces", surfaces_of(source, box)},
          {"air", air},
          {"dust", dust_field_of(source, dust_classes, air)}};
}

}  // namespace dust::report
