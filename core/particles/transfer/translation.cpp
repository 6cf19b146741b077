// SPDX-License-Identifier: Apache-2.0
#include "particles/transfer/translation.hpp"

#include "dust/sdk/vec3.hpp"

#include <algorithm>
#include <array>

namespace dust::particles {
namespace {

/// Numbers in `to` of the things in `from`, or -1.
template <class Things, class Same>
std::vector<std::int32_t> numbers_of(const Things& from, const Things& to, const Same& same) {
  std::vector<std::int32_t> numbers;
  for (const auto& thing : from) {
    const auto at =
        std::find_if(to.begin(), to.end(), [&](const auto& other) { return same(thing, other); });
    numbers.push_back(at == to.end() ? -1 : static_cast<std::int32_t>(at - to.begin()));
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

bool is_same_surface(const Surface& a, const Surface& b) {
  return a.name == b.name && a.part == b.part && (a.body == nullptr) == (b.body == nullptr);
}

bool is_same_opening(const Opening& a, const Opening& b) {
  return a.name == b.name && a.side == b.side;
}

}  // namespace

Translation::Translation(const Conditions& from, const Conditions& to)
    : material_(numbers_of(material_names(from), material_names(to), std::equal_to<>())),
      surface_(numbers_of(from.surfaces, to.surfaces, is_same_surface)),
      opening_(numbers_of(from.openings, to.openings, is_same_opening)) {}

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
      const std::int32_t here = names_.surfaces()[static_cast<std::size_t>(surface)];
      if (here < 0) continue;
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
