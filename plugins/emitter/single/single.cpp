// SPDX-License-Identifier: Apache-2.0
#include <dust/sdk/placed_emitter.hpp>
#include <dust/sdk/plugin.hpp>

#include <algorithm>

namespace {

namespace sdk = dust::sdk;
using sdk::Vec3;

class Single final : public sdk::PlacedEmitter {
 public:
  struct Parameters {
    std::vector<Vec3> positions;
    std::vector<double> diameters;
    std::vector<Vec3> velocities;
    std::vector<Vec3> rotations;
    double time = 0.0;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.vectors(&Parameters::positions, "positions", dim::length, "Centres of the grains.");
    s.numbers(&Parameters::diameters, "diameters", dim::length,
              "Their diameters: one for all, or one each.")
        .above(0);
    s.vectors(&Parameters::velocities, "velocities", dim::velocity,
              "Their velocities: one for all, or one each; without it, at rest.")
        .optional();
    s.vectors(&Parameters::rotations, "rotations", dim::angular_velocity,
              "Their angular velocities: one for all, or one each; without it, none.")
        .optional();
    declare_moment(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "single",
            .version = "1.0",
            .summary = "Single grains, each with its place, size and velocity.",
            .equation = "\\mathbf x_n(0),\\ \\mathbf v_n(0),\\ \\boldsymbol\\omega_n(0)",
            .source = "own definition"};
  }

  explicit Single(const Parameters& p) : PlacedEmitter(p.time), p_(p) {
    check_length("diameters", p.diameters.size(), false);
    check_length("velocities", p.velocities.size(), true);
    check_length("rotations", p.rotations.size(), true);
  }

  [[nodiscard]] std::vector<double> diameters() const override {
    std::vector<double> d = p_.diameters;
    std::sort(d.begin(), d.end());
    d.erase(std::unique(d.begin(), d.end()), d.end());
    return d;
  }
  [[nodiscard]] double largest_speed() const override {
    double speed = 0.0;
    for (const Vec3& v : p_.velocities) speed = std::max(speed, norm(v));
    return speed;
  }
  [[nodiscard]] sdk::EmitterRequest request() const override {
    sdk::EmitterRequest r;
    r.begin = p_.time;
    r.count = static_cast<std::int64_t>(p_.positions.size());
    return r;
  }

 protected:
  void place(const sdk::EmitterContext&, std::vector<sdk::InsertionRequest>& requests) override {
    for (std::size_t n = 0; n < p_.positions.size(); ++n) {
      requests.push_back({.position = p_.positions[n],
                          .velocity = of(p_.velocities, n),
                          .angular_velocity = of(p_.rotations, n),
                          .diameter = of(p_.diameters, n)});
    }
  }

 private:
  void check_length(const char* name, std::size_t length, bool may_be_empty) const {
    if (length == 1 || length == p_.positions.size() || (length == 0 && may_be_empty)) return;
    throw sdk::ParameterError(std::string(name) + " has " + std::to_string(length) +
                              " entries for " + std::to_string(p_.positions.size()) +
                              " positions: give one for all, or one each");
  }
  template <class T>
  static T of(const std::vector<T>& list, std::size_t n) {
    return list.empty() ? T{} : list.size() == 1 ? list.front() : list[n];
  }

  Parameters p_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Single>(); }
