// SPDX-License-Identifier: Apache-2.0
// What the plugin boundary costs: a settled bed with the contact law from its library and the same
// law compiled into this program, blocks of steps in turn: whatever else the machine does slows
// neighbouring blocks alike. plugin_bench BED.csv (one thread)
#include "bench/in_tube.hpp"
#include "contact/hertz_mindlin/hertz_mindlin.cpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

using dust::particles::Dem;
using namespace dust::test;

namespace {

/// The law as this program's own code made it.
class OwnLaws : public dust::sdk::Registrar {
 public:
  void add(dust::sdk::ModelInfo info, dust::sdk::ModelFactory factory) override {
    info_ = std::move(info), factory_ = std::move(factory);
  }
  std::unique_ptr<dust::sdk::ContactLaw> make(
      const std::map<std::string, dust::sdk::Value>& values) {
    std::vector<dust::sdk::Value> row;
    for (const dust::sdk::Parameter& p : info_.parameters) {
      const auto given = values.find(p.name);
      row.push_back(given == values.end() ? dust::sdk::Value{} : given->second);
    }
    return std::unique_ptr<dust::sdk::ContactLaw>(
        static_cast<dust::sdk::ContactLaw*>(factory_(row).release()));
  }

 private:
  dust::sdk::ModelInfo info_;
  dust::sdk::ModelFactory factory_;
};

/// `rig` holds the walls, and has to outlive what it makes.
std::unique_ptr<Dem> make_bed(DemRig& rig, const Bed& bed, bool is_compiled_in) {
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.52, 0.3);
  if (is_compiled_in) {
    OwnLaws own;
    dust_register(own);
    const auto& sand_properties = rig.setup.materials.front().properties;
    rig.laws.front().contact = own.make({{"restitution", 0.9}, {"friction", 0.52}});
    rig.laws.front().contact->prepare(sand_properties, sand_properties);
  }
  rig.diameters = bed.diameters;
  rig.setup.gravity = {0, 0, -9.81};
  put_in_tube(rig, bed, sand);
  auto dem = rig.make();
  dem->insert(bed.grains);
  return dem;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: plugin_bench BED.csv\n");
    return 2;
  }
  oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Bed bed = read_bed(argv[1]);
  DemRig rigs[2];
  const std::unique_ptr<Dem> dems[2] = {make_bed(rigs[0], bed, false),
                                        make_bed(rigs[1], bed, true)};
  constexpr int k_steps = 50;
  constexpr int k_blocks = 61;
  std::vector<double> spent[2];
  std::vector<double> over;  // ours over the other's, of neighbouring blocks
  for (int block = 0; block < k_blocks; ++block) {
    double times[2];
    for (int turn = 0; turn < 2; ++turn) {
      const int n = (block + turn) % 2;
      Stepper stepper(*dems[n]);
      const auto start = std::chrono::steady_clock::now();
      stepper.step(k_steps);
      times[n] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    if (block == 0) continue;
    for (int n = 0; n < 2; ++n) spent[n].push_back(times[n]);
    over.push_back(times[0] / times[1]);
  }
  const auto quantile = [](std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double count = 1e-6 * k_steps * static_cast<double>(bed.grains.size());
  std::printf(
      "contact law as a plugin %.2f, compiled in %.2f M grain-steps/s: %+.1f %% (median of %zu "
      "pairs of blocks; middle half %+.1f to %+.1f %%)\n",
      count / quantile(spent[0], 0.5), count / quantile(spent[1], 0.5),
      100.0 * (quantile(over, 0.5) - 1.0), over.size(), 100.0 * (quantile(over, 0.25) - 1.0),
      100.0 * (quantile(over, 0.75) - 1.0));
  return 0;
}
