// SPDX-License-Identifier: Apache-2.0
#include "run/summary/plant_begin.hpp"

#include "run/summary/summary_dust.hpp"

#include <algorithm>

namespace dust::run {
namespace {

using Way = PlantBegin::Key::Way;

void add_field(const DustStage& stage, std::vector<PlantBegin::Counted>& counted) {
  for (std::size_t n = 0; n < stage.field().classes(); ++n) {
    const airborne::DustBalance balance = stage.field().balance(n);
    const std::string& of_class = stage.class_names()[n];
    for (std::size_t o = 0; o < stage.openings().size(); ++o) {
      counted.push_back({{Way::outlet, stage.openings()[o].name, of_class}, balance.outlets[o]});
    }
    for (std::size_t side = 0; side < 6; ++side) {
      counted.push_back({{Way::side, scenario::k_side_names[side], of_class}, balance.left[side]});
    }
  }
}

}  // namespace

PlantBegin plant_begin_now(const Simulation& s) {
  PlantBegin begin{s.time(), s.dem().balance().mass_emitted, dust_so_far(s), {}};
  for (std::size_t o = 0; o < s.dem().openings().size(); ++o) {
    begin.counted.push_back({{Way::hood, s.dem().openings()[o].name}, drawn_by(s, o).dust});
  }
  if (s.dust_stage() != nullptr) add_field(*s.dust_stage(), begin.counted);
  if (const LiberationStage* stage = s.liberation()) {
    const std::vector<std::string>& classes = s.dust_stage()->class_names();
    for (std::size_t c = 0; c < stage->causes().size(); ++c) {
      for (std::size_t n = 0; n < classes.size(); ++n) {
        begin.counted.push_back(
            {{Way::cause, stage->causes()[c], classes[n]}, stage->set_free(c, n)});
      }
    }
  }
  return begin;
}

PlantBegin plant_begin(const RunFacts& facts) {
  return facts.start ? facts.start->before.plant : PlantBegin{};
}

double PlantBegin::mass_of(const Key& key) const {
  const auto found = std::find_if(counted.begin(), counted.end(),
                                  [&](const Counted& one) { return one.key == key; });
  return found != counted.end() ? found->mass : 0.0;
}

}  // namespace dust::run
