// SPDX-License-Identifier: Apache-2.0
#include "my_emitter.hpp"

#include <dust/sdk/plugin.hpp>

namespace {

namespace formula = my_emitter;
namespace sdk = dust::sdk;

class MyEmitter final : public sdk::Emitter {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double mass_flow = 0.0;
    double diameter = 0.0;
    double spread = 0.0;
    sdk::Vec3 point;
    sdk::Vec3 velocity;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::mass_flow, "mass_flow", sdk::dimension::mass_flow,
             "Mass released per time.")
        .symbol("\\dot m")
        .above(0);
    s.number(&Parameters::diameter, "diameter", sdk::dimension::length, "Diameter of the grains.")
        .symbol("D")
        .above(0);
    s.vector(&Parameters::point, "point", sdk::dimension::length, "Where the grains come from.");
    s.vector(&Parameters::velocity, "velocity", sdk::dimension::velocity,
             "Velocity of the grains as they pass the point.");
    s.number(&Parameters::spread, "spread", sdk::dimension::length,
             "Largest distance from the point along x and y.")
        .at_least(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_emitter",
            .version = "1.0",
            .summary = "Grains of one size, one by one, from about one point.",
            .equation = "t_n = (n + 1/2) m / \\dot m",
            .source = "own definition"};
  }

  explicit MyEmitter(const Parameters& p) : p_(p) {
    if (norm(p.velocity) == 0.0) throw sdk::ParameterError("'velocity' must not be zero");
  }

  // 3. The grains of one interval. Random numbers are a function of the grain's number: the same
  //    however the time is cut.
  void propose(const sdk::EmitterContext& context,
               std::vector<sdk::InsertionRequest>& requests) override {
    const double mass = formula::grain_mass(p_.diameter, context.grain_density);
    for (;; ++released_) {
      const double time = formula::time_of(released_, mass, p_.mass_flow);
      if (!(time < context.end)) return;
      const auto draw = [&](std::uint32_t slot) {
        return 2.0 * context.random.uniform(static_cast<std::uint64_t>(released_), 0, slot) - 1.0;
      };
      sdk::InsertionRequest request;
      request.time = time;
      request.position = p_.point + sdk::Vec3{p_.spread * draw(0), p_.spread * draw(1), 0.0};
      request.velocity = p_.velocity;
      request.diameter = p_.diameter;
      requests.push_back(request);
    }
  }
  // 4. What the core wants to know before.
  [[nodiscard]] double requested_mass_flow() const override { return p_.mass_flow; }
  [[nodiscard]] std::vector<double> diameters() const override { return {p_.diameter}; }
  [[nodiscard]] double largest_speed() const override { return norm(p_.velocity); }

  // 5. What a resumed run needs.
  void save(sdk::ArchiveWriter& archive) const override { archive.integer("released", released_); }
  void load(sdk::ArchiveReader& archive) override { released_ = archive.integer("released"); }

 private:
  Parameters p_;
  std::int64_t released_ = 0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MyEmitter>(); }
