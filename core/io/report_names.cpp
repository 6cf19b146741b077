// SPDX-License-Identifier: Apache-2.0
#include "io/report_names.hpp"

#include "io/report_text.hpp"

#include <cstdlib>

namespace dust::io {

bool has_part(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

std::string leaf_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

int quantile_of(const std::string& path) {
  const std::string leaf = leaf_of(path);
  if (has_part(leaf, "spread") || has_part(leaf, "width") || has_part(leaf, "count")) return 0;
  if (has_part(leaf, "median") || has_part(leaf, "50")) return 50;
  if (has_part(leaf, "95")) return 95;
  if (has_part(leaf, "05") || leaf == "5" || leaf == "q5" || leaf == "quantile_5") return 5;
  return 0;
}

double drop_of(const std::string& path) {
  const auto at = path.find("drop_");
  if (at == std::string::npos) return -1.0;
  const char* begin = path.c_str() + at + 5;
  char* end = nullptr;
  const double value = std::strtod(begin, &end);
  if (end == begin) return -1.0;
  const std::string rest(end);
  if (rest.rfind("_mm", 0) == 0) return value * 1e-3;
  if (rest.rfind("_cm", 0) == 0) return value * 1e-2;
  return value;
}

double class_of(const std::string& path) {
  const auto at = path.find("class_");
  if (at == std::string::npos) return -1.0;
  const char* begin = path.c_str() + at + 6;
  char* end = nullptr;
  const double value = std::strtod(begin, &end);
  if (end == begin) return -1.0;
  return value * (std::string(end).rfind("_mm", 0) == 0 ? 1e-3 : 1e-6);
}

bool is_per_tonne(const Figure& figure) {
  return figure.unit == "g/t" || figure.unit == "g/tonne" || has_part(figure.name, "per_tonne");
}

bool is_opening(const std::string& sensor) {
  return has_part("_" + sensor + "_", "_out_") || has_part(sensor, "escape");
}

std::string place_words(const std::string& sensor) {
  const auto out = sensor.find("_out_");
  return words(out == std::string::npos ? sensor : sensor.substr(out + 5));
}

}  // namespace dust::io
