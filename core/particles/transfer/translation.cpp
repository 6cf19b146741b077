// SPDX-License-Identifier: Apache-2.0
#include "particles/transfer/translation.hpp"

#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace dust::particles {
namespace {

/// Numbers in `to` of the things in `from` by what names them, or -1.
template <class Things, class Key>
std::vector<std::int32_t> numbers_of(const Things& from, const Things& to, const Key& key) {
  std::map<decltype(key(to[0])), std::int32_t> number;
  for (std::size_t n = 0; n < to.size(); ++n) number.emplace(key(to[n]), n);
  std::vector<std::int32_t> numbers;
  for (const auto& thing : from) {
    const auto at = number.find(key(thing));
    numbers.push_back(at == number.end() ? -1 : at->second);
  }
  return numbers;
}

std::vector<std::string> material_names(const Conditions& conditions) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < conditions.materials.size(); ++m) {
    names.push_back(conditions.laws.material_name(static_cast<int>(m)));
  }
  return names;
}

/// [-] of the radius: feet that differ by less are the same.
constexpr double k_same_place = 1e-9;

auto wall_key(const Surface& s) { return std::pair(s.name, s.body != nullptr); }

/// A part is the same one only where its body is cut into as many.
auto surface_key(const Surface& s) {
  return std::tuple(wall_key(s), s.part, s.body != nullptr ? s.body->shape->parts() : 1);
}

}  // namespace

Translation::Translation(const Conditions& from, const Conditions& to)
    : material_(numbers_of(material_names(from), material_names(to),
                           [](const std::string& name) { return name; })),
      wall_(numbers_of(from.surfaces, to.surfaces, wall_key)),
      surface_(numbers_of(from.surfaces, to.surfaces, surface_key)),
      opening_(numbers_of(from.openings, to.openings,
                          [](const Opening& o) { return std::pair(o.name, o.side); })) {}

bool ContactTransfer::is_fine(std::int32_t row) const {
  return 2.0 * to_.particles.radius(static_cast<std::size_t>(row)) <
         to_.conditions.steps.coarse_limit;
}

bool ContactTransfer::is_in_order(std::int32_t i, std::int32_t j) const {
  if (is_fine(i) != is_fine(j)) return is_fine(i);
  return to_.particles.id(static_cast<std::size_t>(i)) <
         to_.particles.id(static_cast<std::size_t>(j));
}

ContactList ContactTransfer::translated(const ContactList& list) {
  const PairLawTable& laws = from_.conditions.laws;
  const bool is_at_surfaces = list.partners() == PartnerKind::surfaces;
  ContactList result(list.partners(), to_.conditions.laws.history_stride());
  std::vector<double> history(to_.conditions.laws.history_stride());
  const auto material = [&](std::int32_t row) {
    return from_.particles.material(static_cast<std::size_t>(row));
  };
  for (std::size_t q = 0; q < list.size(); ++q) {
    if (list.touching()[q] == 0) continue;
    const std::int32_t a = list.a()[q];
    std::int32_t b = list.b()[q];
    const bool is_pair = !is_at_surfaces && b >= 0;
    std::int32_t law = -1;
    if (is_pair) {
      law = laws.index(material(a), material(b));
    } else {
      const std::int32_t surface = is_at_surfaces ? b : -1 - b;
      law = laws.index(material(a),
                       from_.conditions.surfaces[static_cast<std::size_t>(surface)].material);
      if (names_.walls()[static_cast<std::size_t>(surface)] < 0) continue;
      const std::int32_t here = same_place(static_cast<std::size_t>(a), surface);
      if (here < 0) {
        ++contacts_;
        ++without_past_;
        continue;
      }
      b = is_at_surfaces ? here : -1 - here;
    }
    ++contacts_;
    if (is_pair && !is_in_order(a, b)) {
      ++without_past_;
      continue;
    }
    if (!translate(law, list.history(q), history.data())) ++without_past_;
    // Above 1 it is a level of the fine particles, who may have other ones here.
    result.push(a, b, history.data(), is_fine(a) ? list.touching()[q] : std::uint8_t{1});
  }
  return result;
}

/// The surface here that the particle touches where it touched that one of the other solver: where
/// spheres of other sizes come, a body is cut into other parts. -1: none.
std::int32_t ContactTransfer::same_place(std::size_t row, std::int32_t surface) const {
  const auto there = static_cast<std::size_t>(surface);
  if (names_.surfaces()[there] >= 0) return names_.surfaces()[there];
  const double* p = from_.particles.position(row);
  const sdk::Vec3 centre{p[0], p[1], p[2]};
  const auto foot = [&](const Conditions& conditions, std::size_t s) {
    const bodies::SurfacePoint point =
        conditions.surfaces[s].contact_at(conditions.time, centre, 2.0 * p[3]);
    return point.distance * point.normal;
  };
  const sdk::Vec3 before = foot(from_.conditions, there);
  const std::int32_t first = names_.walls()[there];
  std::vector<std::int32_t> parts;
  to_.conditions.surfaces[static_cast<std::size_t>(first)].find_touchable_parts(centre, 2.0 * p[3],
                                                                                0.0, parts);
  for (const std::int32_t part : parts) {
    const sdk::Vec3 here = foot(to_.conditions, static_cast<std::size_t>(first + part));
    if (norm(here - before) <= k_same_place * p[3]) return first + part;
  }
  return -1;
}

bool ContactTransfer::translate(std::int32_t number, const double* history, double* into) const {
  std::fill_n(into, to_.conditions.laws.history_stride(), 0.0);
  const LawTransfer& transfer = laws_[static_cast<std::size_t>(number)];
  if (transfer.law < 0) return false;
  const PairLaws& from = from_.conditions.laws[static_cast<std::size_t>(number)];
  const PairLaws& to = to_.conditions.laws[static_cast<std::size_t>(transfer.law)];
  struct Part {
    int from, to;
    bool is_kept;
  };
  const auto size = [](const auto& law) { return law ? law->history_size() : 0; };
  const std::array<Part, 3> parts = {
      Part{size(from.contact), size(to.contact), transfer.keeps_contact},
      Part{size(from.rolling), size(to.rolling), transfer.keeps_rolling},
      Part{size(from.cohesion), size(to.cohesion), transfer.keeps_cohesion}};
  bool has_all = true;
  for (const Part& part : parts) {
    const bool is_kept = part.is_kept && part.from == part.to;
    if (is_kept) std::copy_n(history, part.from, into);
    has_all = has_all && (is_kept || part.to == 0);
    history += part.from;
    into += part.to;
  }
  return has_all;
}

}  // namespace dust::particles
