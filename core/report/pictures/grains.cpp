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
constexpr std::size_t k_grain_frames = 150;
constexpr std::size_t k_classes = 256;  ///< a byte of each grain tells which

/// A number in [0, 1) that belongs to the grain: the same in every frame (splitmix64).
double share_of(std::int64_t id) {
  auto bits = static_cast<std::uint64_t>(id) + 0x9E3779B97F4A7C15ull;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
  return static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1p-53;
}

/// Size classes of the grains, ascending: those of the run, or else the diameters met; with more
/// than k_classes of them, so many geometric steps.
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
Share share_shown(const std::vector<std::vector<float>>& diameters, const DustSizes& sizes) {
  std::size_t most_coarse = 0, most_dust = 0, all_coarse = 0, all_dust = 0;
  for (const auto& frame : diameters) {
    const auto dust = static_cast<std::size_t>(
        std::count_if(frame.begin(), frame.end(), [&](float d) { return sizes.is_dust(d); }));
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

/// The depth y in 16 bits; the higher byte comes first, alone where the space is thin.
std::uint32_t depth_code(double y, const Box& box) {
  const double share = (y - box.min[1]) / (box.max[1] - box.min[1]);
  return std::isfinite(share)
             ? static_cast<std::uint32_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)))
             : 0;
}

/// The grains of a frame in the order in which they are painted: the coarse ones from the back to
/// the front in slabs, those of a class side by side within a slab; then the dust.
std::vector<std::size_t> paint_order(const std::vector<float>& position,
                                     const std::vector<float>& diameter,
                                     const std::vector<double>& classes,
                                     const std::vector<bool>& is_dust) {
  constexpr double k_slabs = 24.0;
  double front = std::numeric_limits<double>::infinity();
  double back = -front;
  for (std::size_t k = 0; k < is_dust.size(); ++k) {
    front = std::min(front, static_cast<double>(position[3 * k + 1]));
    back = std::max(back, static_cast<double>(position[3 * k + 1]));
  }
  const double depth = std::max(back - front, 1e-30);
  std::vector<std::pair<int, std::size_t>> keys;
  for (std::size_t k = 0; k < is_dust.size(); ++k) {
    const double share = (back - static_cast<double>(position[3 * k + 1])) / depth;
    const int slab = std::isfinite(share) ? static_cast<int>(k_slabs * share) : 0;
    const int size = class_of(classes, diameter[k]);
    keys.emplace_back(is_dust[k] ? std::numeric_limits<int>::max() : 256 * slab + size, k);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  order.reserve(keys.size());
  for (const auto& [key, k] : keys) order.push_back(k);
  return order;
}

/// Puts frames into bytes: what all of them have in common stands here.
class GrainFrames {
 public:
  GrainFrames(const H5Source& source, const View& view, const Box& box, const DustSizes& sizes)
      : source_(source), view_(view), box_(box), sizes_(sizes) {}

  /// Looks at the sizes and speeds of `frames` first.
  void look_at(const std::vector<std::string>& frames, const json& given_classes) {
    for (const auto& name : frames) {
      diameters_.push_back(source_.floats("/particles/" + name + "/diameter"));
    }
    classes_ = legend_of(given_classes, diameters_);
    share_ = share_shown(diameters_, sizes_);
    fastest_ = speed_scale(source_, frames);
  }

  json frame(std::size_t f, const std::string& name) {
    const std::string path = "/particles/" + name;
    const auto position = source_.floats(path + "/position");
    const auto velocity = source_.floats(path + "/velocity");
    const auto id = source_.integers(path + "/id");
    const auto& diameter = diameters_[f];
    std::vector<bool> is_dust;
    for (std::size_t k = 0; k < std::min(position.size() / 3, diameter.size()); ++k) {
      is_dust.push_back(sizes_.is_dust(diameter[k]));
    }
    most_ = std::max(most_, is_dust.size());
    Bytes bytes;
    for (const std::size_t k : paint_order(position, diameter, classes_, is_dust)) {
      const std::int64_t number = k < id.size() ? id[k] : static_cast<std::int64_t>(k);
      const double limit = is_dust[k] ? share_.dust : share_.coarse;
      if (limit < 1.0 && share_of(number) >= limit) continue;
      if (!put_place(bytes, &position[3 * k])) continue;
      bytes.size.push_back(class_of(classes_, diameter[k]));
      bytes.speed.push_back(speed_code(velocity, k, fastest_));
      if (is_dust[k]) put_number(bytes, number);
    }
    const auto time = source_.attribute(path, "time");
    return {{"t", time.empty() ? static_cast<double>(f) : time[0]},
            {"n", bytes.size.size()},
            {"dust", bytes.number.size() / 4},
            {"all", is_dust.size()},
            {"data", packed(bytes.joined())}};
  }

  /// What the page has to know of all frames.
  [[nodiscard]] json facts() const {
    json dust = json::array();
    for (const double d : classes_) dust.push_back(sizes_.is_dust(d));
    return {{"classes", classes_},
            {"is_dust", std::move(dust)},
            {"dust_below", sizes_.limit()},
            {"share", share_.coarse},
            {"dust_share", share_.dust},
            {"speed", fastest_},
            {"most", most_},
            {"depth_bytes", box_.is_thin() ? 1 : 2}};
  }

 private:
  struct Bytes {
    std::vector<std::uint8_t> number, x, z, size, speed, depth, depth_low;
    /// The 4-byte numbers come first, so that typed views of the buffer stay aligned.
    [[nodiscard]] std::vector<std::uint8_t> joined() const {
      std::vector<std::uint8_t> all;
      for (const auto* part : {&number, &x, &z, &size, &speed, &depth, &depth_low}) {
        all.insert(all.end(), part->begin(), part->end());
      }
      return all;
    }
  };

  /// False outside the view.
  bool put_place(Bytes& bytes, const float* position) const {
    const double across = (position[0] - view_.min_x) / (view_.max_x - view_.min_x);
    const double up = (position[2] - view_.min_z) / (view_.max_z - view_.min_z);
    if (!(across >= 0.0 && across <= 1.0 && up >= 0.0 && up <= 1.0)) return false;
    put16(bytes.x, across);
    put16(bytes.z, up);
    const std::uint32_t y = depth_code(position[1], box_);
    bytes.depth.push_back(static_cast<std::uint8_t>(y >> 8));
    if (!box_.is_thin()) bytes.depth_low.push_back(static_cast<std::uint8_t>(y & 255));
    return true;
  }

  void put_number(Bytes& bytes, std::int64_t id) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    const std::uint32_t number = numbers_.try_emplace(id, next).first->second;
    for (int byte = 0; byte < 4; ++byte) {
      bytes.number.push_back(static_cast<std::uint8_t>(number >> (8 * byte)));
    }
  }

  const H5Source& source_;
  const View& view_;
  const Box& box_;
  const DustSizes& sizes_;
  std::vector<std::vector<float>> diameters_;
  std::vector<double> classes_;
  Share share_;
  double fastest_ = 0.0;
  std::size_t most_ = 0;
  std::map<std::int64_t, std::uint32_t> numbers_;  ///< short ones of the dust, for trails
};

}  // namespace

json grains_of(const H5Source& source, const View& view, const Box& box, const DustSizes& dust,
               const json& given_classes) {
  const auto names = source.frames("/particles");
  if (names.empty() || view.is_empty()) return nullptr;
  std::vector<std::string> kept;
  for (const std::size_t k : spread_frames(names.size(), k_grain_frames)) kept.push_back(names[k]);
  GrainFrames frames(source, view, box, dust);
  frames.look_at(kept, given_classes);
  json list = json::array();
  for (std::size_t f = 0; f < kept.size(); ++f) list.push_back(frames.frame(f, kept[f]));
  json grains = frames.facts();
  grains["frames"] = std::move(list);
  grains["written"] = names.size();
  return grains;
}

}  // namespace dust::report
