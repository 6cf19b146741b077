// SPDX-License-Identifier: Apache-2.0
#include "run/audit/departures.hpp"

#include <algorithm>
#include <string>

namespace dust::run {
namespace {

constexpr std::size_t k_numbers = 5;  // of a grain beside its id and step

bool is_taken(std::span<const particles::Opening> openings, double rounding, int side,
              sdk::Vec3 point) {
  return std::any_of(openings.begin(), openings.end(), [&](const particles::Opening& o) {
    return o.side == side && o.holds(point, rounding);
  });
}

}  // namespace

int Departures::side_of(sdk::Vec3 point) const {
  int found = -1;
  for (int d = 0; d < 3; ++d) {
    const bool is_below = point[d] < domain_.min[d];
    if (!is_below && !(point[d] > domain_.max[d])) continue;
    const int side = 2 * d + (is_below ? 0 : 1);
    if (domain_.sides[static_cast<std::size_t>(side)].grains == scenario::GrainSide::open) {
      found = side;
    }
  }
  return found;
}

void Departures::note(const particles::GrainRows& grains,
                      std::span<const particles::Opening> openings, double rounding,
                      const Moment& now) {
  std::array<std::vector<Grain>, 6> found;
  for (std::size_t n = 0; n < grains.count; ++n) {
    const sdk::Vec3 place = grains.centre(n);
    const int side = side_of(place);
    if (side < 0 || is_taken(openings, rounding, side, place)) continue;
    Side& through = sides_[static_cast<std::size_t>(side)];
    ++through.count;
    through.mass += grains.weight[n] / grains.inverse_mass(n);
    found[static_cast<std::size_t>(side)].push_back(
        {grains.id[n], now.step, now.time, grains.diameter(n), place});
  }
  for (std::size_t side = 0; side < found.size(); ++side) {
    auto& all = found[side];
    // Rows stand in any order.
    std::sort(all.begin(), all.end(), [](const Grain& a, const Grain& b) { return a.id < b.id; });
    auto& first = sides_[side].first;
    const std::size_t room = k_named - std::min(k_named, first.size());
    first.insert(first.end(), all.begin(),
                 all.begin() + static_cast<std::ptrdiff_t>(std::min(room, all.size())));
  }
}

void Departures::save(sdk::ArchiveWriter& archive) const {
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    const std::string name = std::string("left_by_") + scenario::k_side_names[side];
    std::vector<std::int64_t> integers{sides_[side].count};
    std::vector<double> numbers{sides_[side].mass};
    for (const Grain& g : sides_[side].first) {
      integers.insert(integers.end(), {g.id, g.step});
      numbers.insert(numbers.end(), {g.time, g.diameter, g.place.x, g.place.y, g.place.z});
    }
    archive.integers(name, integers);
    archive.numbers(name + "_numbers", numbers);
  }
}

void Departures::load(sdk::ArchiveReader& archive) {
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    const std::string name = std::string("left_by_") + scenario::k_side_names[side];
    const auto integers = archive.integers(name);
    const auto numbers = archive.numbers(name + "_numbers");
    Side& through = sides_[side];
    through.count = integers.at(0);
    through.mass = numbers.at(0);
    through.first.clear();
    for (std::size_t n = 0; 2 * n + 2 < integers.size(); ++n) {
      const double* v = &numbers.at(1 + k_numbers * n);
      through.first.push_back(
          {integers[1 + 2 * n], integers[2 + 2 * n], v[0], v[1], {v[2], v[3], v[4]}});
    }
  }
}

}  // namespace dust::run
