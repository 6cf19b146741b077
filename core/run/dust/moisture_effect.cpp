// SPDX-License-Identifier: Apache-2.0
#include "run/dust/moisture_effect.hpp"

#include "base/text.hpp"

#include <numeric>

namespace dust::run {
namespace {

/// [-] the moisture that others are compared with
constexpr double k_reference = 0.01;

/// [kg] of all classes that comes off one grain of 1 g at this moisture.
double set_free(const sdk::LiberationLaw& law, const std::vector<double>& share, double moisture) {
  const double diameter = 10e-3, mass = 1e-3;  // [m], [kg]
  // Little beside what binds a load (some 1e3 to 1e7 J/kg of dust), so that the load does not end.
  const double energy = 1e-6 * mass;       // [J]
  const double acceleration = 100 * 9.81;  // [m/s2]
  std::vector<double> load, released(share.size(), 0.0);
  for (const double s : share) load.push_back(s * mass);
  const sdk::DustyGrains grain{.count = 1,
                               .classes = share.size(),
                               .stride = 1,
                               .time_step = 1e-3,
                               .diameter = &diameter,
                               .mass = &mass,
                               .moisture = &moisture,
                               .load = load.data(),
                               .fresh = load.data(),
                               .released = released.data()};
  law.in_contacts({.grains = grain,
                   .normal_energy = &energy,
                   .tangential_energy = &energy,
                   .acceleration = &acceleration});
  return std::accumulate(released.begin(), released.end(), 0.0);
}

/// [-] the largest moisture below the reference that the law takes for none: where its fit ends.
double counts_as_dry(const sdk::LiberationLaw& law, const std::vector<double>& share) {
  constexpr int k_halvings = 40;
  const double dry = set_free(law, share, 0.0);
  double same = 0.0, other = k_reference;
  for (int n = 0; n < k_halvings; ++n) {
    const double middle = 0.5 * (same + other);
    (set_free(law, share, middle) == dry ? same : other) = middle;
  }
  return same;
}

std::string percent(double share) { return base::digits_text(100.0 * share, 3) + " %"; }

/// Begins what is said of a moisture, also of none.
std::string moisture_text(const sdk::LiberationLaw& law, const scenario::DustLoadSpec& load) {
  if (load.moisture > 0.0) return "at " + percent(load.moisture) + " of moisture";
  constexpr double k_no_floor = 1e-6;  // what the search leaves of none
  const double floor = counts_as_dry(law, load.share);
  return "no moisture given: " +
         (floor > k_no_floor ? "counts as " + percent(floor) + "," : std::string("dry,"));
}

}  // namespace

std::vector<std::string> moisture_lines(const sdk::LiberationLaw& law,
                                        const std::vector<scenario::MaterialSpec>& materials,
                                        const std::vector<scenario::DustLoadSpec>& loads) {
  std::vector<std::string> lines;
  if (!law.uses_moisture()) return lines;
  for (std::size_t m = 0; m < materials.size() && m < loads.size(); ++m) {
    const double carried = std::accumulate(loads[m].share.begin(), loads[m].share.end(), 0.0);
    if (!(carried > 0.0)) continue;
    const double there = set_free(law, loads[m].share, k_reference);
    if (!(there > 0.0)) continue;
    const double effect = set_free(law, loads[m].share, loads[m].moisture) / there;
    lines.push_back("material " + materials[m].name + ": " + moisture_text(law, loads[m]) +
                    " a gentle impact sets free " + base::digits_text(effect, 3) +
                    " of what it does at " + percent(k_reference));
  }
  return lines;
}

}  // namespace dust::run
