// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"
#include "report/pictures/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr std::size_t k_coarse_per_frame = 20000;  ///< more cannot be told apart on a screen
constexpr std::size_t k_dust_per_frame = 8000;
constexpr std::size_t k_grains_per_page = 1000000;  ///< 6 bytes each before compression
constexpr std::size_t k_frames = 150;
constexpr std::size_t k_classes = 24;

/// A number in [0, 1) that belongs to the grain: the same in every frame (splitmix64).
double share_of(std::int64_t id) {
  auto bits = static_cast<std::uint64_t>(id) + 0x9E3779B97F4A7C15ull;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
  return static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1p-53;
}

/// Size classes of the legend, ascending: those of the run, or else the diameters met; with more
/// than 24 of them, 24 geometric steps.
std::vector<double> legend_of(const json& given, const std::vector<std::vector<float>>& diameters) {
  std::vector<double> classes;
  for (const json& d : given) {
    if (d.is_number() && d.get<double>() > 0.0) classes.push_back(d.get<double>());
  }
  if (classes.empty()) {
    std::set<float> met;
    for (const auto& frame : diameters) {
      for (const float d : frame) {
        if (d > 0.0F) met.insert(d);
      }
    }
    classes.assign(met.begin(), met.end());
  }
  std::sort(classes.begin(), classes.end());
  if (classes.size() <= k_classes) return classes;
  const double ratio = classes.back() / classes.front();
  const double first = classes.front();
  classes.resize(k_classes);
  for (std::size_t k = 0; k < k_classes; ++k) {
    classes[k] = first * std::pow(ratio, static_cast<double>(k) / (k_classes - 1));
  }
  return classes;
}

std::uint8_t class_of(const std::vector<double>& classes, double diameter) {
  const auto above = std::lower_bound(classes.begin(), classes.end(), diameter);
  if (above == classes.begin()) return 0;
  if (above == classes.end()) return static_cast<std::uint8_t>(classes.size() - 1);
  const auto below = above - 1;
  const bool is_nearer_below = diameter * diameter < *above * *below;
  return static_cast<std::uint8_t>((is_nearer_below ? below : above) - classes.begin());
}

void put16(std::vector<std::uint8_t>& bytes, double share) {
  const auto code = static_cast<unsigned>(std::lround(share * 65535.0));
  bytes.push_back(static_cast<std::uint8_t>(code & 255));
  bytes.push_back(static_cast<std::uint8_t>(code >> 8));
}

struct Share {
  double coarse = 1.0, dust = 1.0;
};

/// The share of the grains a page can hold, one for coarse grains and one for dust.
Share share_shown(const std::vector<std::vector<float>>& diameters) {
  std::size_t most_coarse = 0, most_dust = 0, all_coarse = 0, all_dust = 0;
  for (const auto& frame : diameters) {
    const auto dust = static_cast<std::size_t>(
        std::count_if(frame.begin(), frame.end(), [](float d) { return d < k_dust_diameter; }));
    most_dust = std::max(most_dust, dust);
    most_coarse = std::max(most_coarse, frame.size() - dust);
    all_dust += dust;
    all_coarse += frame.size() - dust;
  }
  const auto limit = [](std::size_t most, std::size_t allowed) {
    return most > allowed ? static_cast<double>(allowed) / static_cast<double>(most) : 1.0;
  };
  Share share;
  share.coarse =
      std::min(limit(most_coarse, k_coarse_per_frame), limit(all_coarse, k_grains_per_page));
  share.dust = std::min(limit(most_dust, k_dust_per_frame), limit(all_dust, k_grains_per_page / 2));
  return share;
}

/// The speed below which 99.8 % of the grains of the fastest frame stay [m/s]; the colours end
/// there. 0 without velocities.
double speed_scale(const H5Source& source, const std::vector<std::string>& frames) {
  double scale = 0.0;
  for (const std::string& name : frames) {
    const auto velocity = source.floats("/particles/" + name + "/velocity");
    std::vector<double> speeds;
    for (std::size_t k = 0; k + 2 < velocity.size(); k += 3) {
      const double speed = std::hypot(velocity[k], velocity[k + 1], velocity[k + 2]);
      if (std::isfinite(speed)) speeds.push_back(speed);
    }
    if (speeds.empty()) continue;
    const auto place = speeds.begin() +
                       static_cast<std::ptrdiff_t>(0.998 * static_cast<double>(speeds.size() - 1));
    std::nth_element(speeds.begin(), place, speeds.end());
    scale = std::max(scale, *place);
  }
  return scale;
}

/// Speed as a byte, by its root, so that slow grains differ as well.
std::uint8_t speed_code(const std::vector<float>& velocity, std::size_t k, double scale) {
  if (3 * k + 2 >= velocity.size() || !(scale > 0.0)) return 0;
  const double speed = std::hypot(velocity[3 * k], velocity[3 * k + 1], velocity[3 * k + 2]);
  if (!std::isfinite(speed)) return 0;
  return static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::min(speed / scale, 1.0))));
}

/// The grains of a frame in the order in which they are painted: the coarse ones from the back to
/// the front in slabs, those of a class side by side within a slab; then the dust.
std::vector<std::size_t> paint_order(const std::vector<float>& position,
                                     const std::vector<float>& diameter,
                                     const std::vector<double>& classes, std::size_t count) {
  constexpr double k_slabs = 24.0;
  double front = std::numeric_limits<double>::infinity();
  double back = -front;
  for (std::size_t k = 0; k < count; ++k) {
    front = std::min(front, static_cast<double>(position[3 * k + 1]));
    back = std::max(back, static_cast<double>(position[3 * k + 1]));
  }
  const double depth = std::max(back - front, 1e-30);
  std::vector<std::pair<int, std::size_t>> keys;
  for (std::size_t k = 0; k < count; ++k) {
    const bool is_dust = diameter[k] < k_dust_diameter;
    const double share = (back - static_cast<double>(position[3 * k + 1])) / depth;
    const int slab = std::isfinite(share) ? static_cast<int>(k_slabs * share) : 0;
    const int size = class_of(classes, diameter[k]);
    keys.emplace_back(is_dust ? std::numeric_limits<int>::max() : 256 * slab + size, k);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& [key, k] : keys) order.push_back(k);
  return order;
}

}  // namespace

json grains_of(const H5Source& source, const View& view, const json& given_classes) {
  auto names = source.frames("/particles");
  if (names.empty() || view.is_empty()) return nullptr;
  const std::size_t stride = (names.size() + k_frames - 1) / k_frames;
  const std::size_t frames_written = names.size();
  std::vector<std::string> kept;  // counted from the end, so that the last frame is always there
  for (std::size_t k = names.size(); k-- > 0;) {
    if ((names.size() - 1 - k) % stride == 0) kept.push_back(names[k]);
  }
  std::reverse(kept.begin(), kept.end());

  std::vector<std::vector<float>> diameters;
  for (const auto& name : kept)
    diameters.push_back(source.floats("/particles/" + name + "/diameter"));
  const auto classes = legend_of(given_classes, diameters);
  const Share share = share_shown(diameters);
  const double fastest = speed_scale(source, kept);

  std::map<std::int64_t, std::uint32_t> dust_numbers;  // short numbers for trails
  std::size_t most = 0;
  json frames = json::array();
  for (std::size_t f = 0; f < kept.size(); ++f) {
    const std::string path = "/particles/" + kept[f];
    const auto position = source.floats(path + "/position");
    const auto velocity = source.floats(path + "/velocity");
    const auto id = source.integers(path + "/id");
    const auto& diameter = diameters[f];
    const std::size_t count = std::min(position.size() / 3, diameter.size());
    most = std::max(most, count);
    std::vector<std::uint8_t> x, z, size, number, speed;
    std::size_t dust = 0;
    for (const std::size_t k : paint_order(position, diameter, classes, count)) {
      const bool is_dust = diameter[k] < k_dust_diameter;
      const std::int64_t name = k < id.size() ? id[k] : static_cast<std::int64_t>(k);
      const double limit = is_dust ? share.dust : share.coarse;
      if (limit < 1.0 && share_of(name) >= limit) continue;
      const double across = (position[3 * k] - view.min_x) / (view.max_x - view.min_x);
      const double up = (position[3 * k + 2] - view.min_z) / (view.max_z - view.min_z);
      if (!(across >= 0.0 && across <= 1.0 && up >= 0.0 && up <= 1.0)) continue;
      put16(x, across);
      put16(z, up);
      size.push_back(class_of(classes, diameter[k]));
      speed.push_back(speed_code(velocity, k, fastest));
      if (is_dust) {
        const auto short_number =
            dust_numbers.try_emplace(name, static_cast<std::uint32_t>(dust_numbers.size()))
                .first->second;
        for (int byte = 0; byte < 4; ++byte) {
          number.push_back(static_cast<std::uint8_t>(short_number >> (8 * byte)));
        }
        ++dust;
      }
    }
    const auto time = source.attribute(path, "time");
    std::vector<std::uint8_t> bytes;
    // The 4-byte numbers come first, so that typed views of the buffer stay aligned.
    for (const auto* part : {&number, &x, &z, &size, &speed})
      bytes.insert(bytes.end(), part->begin(), part->end());
    frames.push_back({{"t", time.empty() ? static_cast<double>(f) : time[0]},
                      {"n", size.size()},
                      {"dust", dust},
                      {"all", count},
                      {"data", packed(bytes)}});
  }
  return {{"frames", frames},      {"classes", classes},
          {"share", share.coarse}, {"dust_share", share.dust},
          {"speed", fastest},      {"written", frames_written},
          {"most", most},          {"dust_below", k_dust_diameter}};
}

}  // namespace dust::report
