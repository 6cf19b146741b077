// SPDX-License-Identifier: Apache-2.0
#include "registry/guard.hpp"

#include "base/text.hpp"
#include "dust/sdk/airborne_dust.hpp"
#include "registry/checked_sinks.hpp"
#include "registry/guard_report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dust::registry {
namespace {

/// Owner of the model, and the calls that all kinds have.
template <class Kind>
class Guarded : public Kind {
 public:
  Guarded(std::unique_ptr<sdk::Model> model, GuardReport faults)
      : model_(as_kind(std::move(model), faults)), faults_(std::move(faults)) {}
  ~Guarded() override {
    const Asking asking(faults_.who().c_str(), " was asked for ", "its destructor");
    model_.reset();
  }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;
  void save(sdk::ArchiveWriter& a) const override {
    faults_.call("save", "its state", [&] { model_->save(a); });
  }
  void load(sdk::ArchiveReader& a) override {
    faults_.call("load", "its state taken back", [&] { model_->load(a); });
  }

 protected:
  /// Calls a member function of the model; `expected` ends the message if it throws.
  template <class Function, class... Arguments>
  auto ask(const char* name, const char* expected, Function function,
           Arguments&&... arguments) const {
    return faults_.call(name, expected, [&]() -> decltype(auto) {
      return ((*model_).*function)(std::forward<Arguments>(arguments)...);
    });
  }
  /// A question of the time before the run, or of no batch.
  template <class Function, class... Arguments>
  auto get(const char* name, Function function, Arguments&&... arguments) const {
    return ask(name, "an answer", function, std::forward<Arguments>(arguments)...);
  }
  /// A number of columns or cells that the core allots room by.
  template <class Function, class... Arguments>
  int number(const char* name, int least, Function function, Arguments&&... arguments) const {
    const int answer = get(name, function, std::forward<Arguments>(arguments)...);
    if (answer < least) {
      faults_.refuse_answer(name, answer, "a number from " + std::to_string(least) + " on");
    }
    return answer;
  }
  /// A length, speed or mass that the core lays out steps and searches by.
  template <class Function, class... Arguments>
  double not_negative(const char* name, Function function, Arguments&&... arguments) const {
    const double answer = get(name, function, std::forward<Arguments>(arguments)...);
    if (!(base::is_finite(answer) && answer >= 0.0)) {
      faults_.refuse_answer(name, answer, "a finite number from 0 on");
    }
    return answer;
  }
  /// A time or ratio that the core divides by; without stiffness it may be infinite.
  template <class Function, class... Arguments>
  double positive(const char* name, Function function, Arguments&&... arguments) const {
    const double answer = get(name, function, std::forward<Arguments>(arguments)...);
    if (!(answer > 0.0)) faults_.refuse_answer(name, answer, "a number above 0");
    return answer;
  }
  [[nodiscard]] const GuardReport& faults() const { return faults_; }
  [[nodiscard]] Kind& model() const { return *model_; }

 private:
  /// What a factory gives under another kind's name would be called by the wrong table.
  static std::unique_ptr<Kind> as_kind(std::unique_ptr<sdk::Model> model,
                                       const GuardReport& faults) {
    auto* const own = dynamic_cast<Kind*>(model.get());
    if (own == nullptr) faults.refuse_made(model == nullptr);
    model.release();
    return std::unique_ptr<Kind>(own);
  }

  std::unique_ptr<Kind> model_;
  GuardReport faults_;
};

/// Contact and rolling: both see the batch of a contact.
template <class Law>
class PairLaw : public Guarded<Law> {
 public:
  using Guarded<Law>::Guarded;
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    this->ask("prepare", "two materials taken, or a ParameterError", &Law::prepare, i, j);
  }
  [[nodiscard]] int history_size() const override {
    return this->number("history_size", 0, &Law::history_size);
  }
};

class Contact final : public PairLaw<sdk::ContactLaw> {
 public:
  using PairLaw::PairLaw;
  void evaluate(const sdk::ContactBatch& b) const override {
    for (double* column : {b.normal_force, b.force.x, b.force.y, b.force.z}) {
      GuardReport::set_unwritten(b.count, column);
    }
    ask("evaluate", "a force for every contact of the batch", &sdk::ContactLaw::evaluate, b);
    const GuardReport::Inputs seen = {{"overlap", b.overlap},
                                      {"effective_radius", b.effective_radius},
                                      {"effective_mass", b.effective_mass},
                                      {"velocity.x", b.velocity.x},
                                      {"velocity.y", b.velocity.y},
                                      {"velocity.z", b.velocity.z}};
    faults().check(b.count, "normal_force", b.normal_force, seen);
    faults().check(b.count, "force.x", b.force.x, seen);
    faults().check(b.count, "force.y", b.force.y, seen);
    faults().check(b.count, "force.z", b.force.z, seen);
    // Rolling laws and the energy account read them later, where nobody would look for this law.
    faults().check(b.count, "normal_stiffness", b.normal_stiffness, seen);
    faults().check(b.count, "tangential_stiffness", b.tangential_stiffness, seen);
  }
  [[nodiscard]] double collision_time(double radius, double mass, double speed) const override {
    return positive("collision_time", &sdk::ContactLaw::collision_time, radius, mass, speed);
  }
  [[nodiscard]] double half_period(double radius, double mass, double overlap) const override {
    return positive("half_period", &sdk::ContactLaw::half_period, radius, mass, overlap);
  }
  [[nodiscard]] double range() const override {
    return not_negative("range", &sdk::ContactLaw::range);
  }
  [[nodiscard]] bool has_hertz_force() const override {
    return get("has_hertz_force", &sdk::ContactLaw::has_hertz_force);
  }
};

class Rolling final : public PairLaw<sdk::RollingLaw> {
 public:
  using PairLaw::PairLaw;
  [[nodiscard]] int couple_column() const override {
    constexpr int k_components = 3;
    const int column = get("couple_column", &sdk::RollingLaw::couple_column);
    if (column < -1 || (column >= 0 && column + k_components > history_size())) {
      faults().refuse_answer("couple_column", column,
                             "the first of three of its columns of history, or -1 for none");
    }
    return column;
  }
  void evaluate(const sdk::ContactBatch& b) const override {
    ask("evaluate", "a couple for every contact of the batch", &sdk::RollingLaw::evaluate, b);
    const GuardReport::Inputs seen = {{"normal_force", b.normal_force},
                                      {"effective_radius", b.effective_radius},
                                      {"angular_velocity.x", b.angular_velocity.x},
                                      {"angular_velocity.y", b.angular_velocity.y},
                                      {"angular_velocity.z", b.angular_velocity.z}};
    faults().check(b.count, "torque.x", b.torque.x, seen);
    faults().check(b.count, "torque.y", b.torque.y, seen);
    faults().check(b.count, "torque.z", b.torque.z, seen);
  }
};

class Cohesion final : public PairLaw<sdk::CohesionLaw> {
 public:
  using PairLaw::PairLaw;
  void evaluate(const sdk::CohesionBatch& b) const override {
    ask("evaluate", "an attraction for every pair of the batch", &sdk::CohesionLaw::evaluate, b);
    const GuardReport::Inputs seen = {{"overlap", b.overlap},
                                      {"effective_radius", b.effective_radius},
                                      {"normal_velocity", b.normal_velocity}};
    faults().check(b.count, "contact_overlap", b.contact_overlap, seen);
    faults().check(b.count, "attraction", b.attraction, seen);
  }
  [[nodiscard]] double range(double radius) const override {
    return not_negative("range", &sdk::CohesionLaw::range, radius);
  }
  [[nodiscard]] double resting_overlap(double radius) const override {
    return not_negative("resting_overlap", &sdk::CohesionLaw::resting_overlap, radius);
  }
  [[nodiscard]] bool needs_hertz_force() const override {
    return get("needs_hertz_force", &sdk::CohesionLaw::needs_hertz_force);
  }
};

/// Refuses the first number of a column below 0.
void check_not_negative(const GuardReport& faults, std::size_t count, const char* name,
                        const double* column, GuardReport::Inputs seen) {
  if (column == nullptr) return;
  for (std::size_t n = 0; n < count; ++n) {
    if (column[n] >= 0.0) continue;
    faults.refuse("gives " + std::string(name) + " = " + base::digits_text(column[n], 6), n, count,
                  seen, "a number from 0 on");
  }
}

class Drag final : public Guarded<sdk::DragLaw> {
 public:
  using Guarded::Guarded;
  void evaluate(const sdk::DragBatch& b) const override {
    GuardReport::set_unwritten(b.count, b.factor);
    ask("evaluate", "a factor for every grain of the batch", &sdk::DragLaw::evaluate, b);
    faults().check(b.count, "factor", b.factor,
                   {{"reynolds", b.reynolds},
                    {"void_fraction", b.void_fraction},
                    {"size_ratio", b.size_ratio}});
    check_not_negative(faults(), b.count, "factor", b.factor,
                       {{"reynolds", b.reynolds}, {"void_fraction", b.void_fraction}});
  }
  [[nodiscard]] bool needs_size_ratio() const override {
    return get("needs_size_ratio", &sdk::DragLaw::needs_size_ratio);
  }
};

class FluidForce final : public Guarded<sdk::FluidForce> {
 public:
  using Guarded::Guarded;
  void evaluate(const sdk::FluidForceBatch& b) const override {
    ask("evaluate", "a force for every grain of the batch", &sdk::FluidForce::evaluate, b);
    const GuardReport::Inputs seen = {{"diameter", b.diameter},
                                      {"void_fraction", b.void_fraction},
                                      {"slip.x", b.slip.x},
                                      {"slip.y", b.slip.y},
                                      {"slip.z", b.slip.z}};
    faults().check(b.count, "force.x", b.force.x, seen);
    faults().check(b.count, "force.y", b.force.y, seen);
    faults().check(b.count, "force.z", b.force.z, seen);
    faults().check(b.count, "added_mass", b.added_mass, seen);
    faults().check(b.count, "resistance", b.resistance, seen);
    check_not_negative(faults(), b.count, "added_mass", b.added_mass, seen);
    check_not_negative(faults(), b.count, "resistance", b.resistance, seen);
  }
  [[nodiscard]] sdk::FluidForceNeeds needs() const override {
    const sdk::FluidForceNeeds needs = get("needs", &sdk::FluidForce::needs);
    if (!(needs.wall_reach >= 0.0)) {
      faults().refuse_answer("needs (wall_reach)", needs.wall_reach, "a number from 0 on");
    }
    return needs;
  }
  [[nodiscard]] sdk::FluidForceParts takes_over() const override {
    return get("takes_over", &sdk::FluidForce::takes_over);
  }
  [[nodiscard]] sdk::FluidForceReaction reaction() const override {
    return get("reaction", &sdk::FluidForce::reaction);
  }
  [[nodiscard]] int history_size() const override {
    return number("history_size", 0, &sdk::FluidForce::history_size);
  }
};

class Voidage final : public Guarded<sdk::VoidageRule> {
  /// Of the sum of the weights of a grain in hundreds of cells.
  static constexpr double k_rounding = 1e-9;

 public:
  using Guarded::Guarded;
  [[nodiscard]] int capacity(const sdk::GridShape& grid, double radius) const override {
    return number("capacity", 1, &sdk::VoidageRule::capacity, grid, radius);
  }
  [[nodiscard]] double largest_diameter_over_spacing() const override {
    return positive("largest_diameter_over_spacing",
                    &sdk::VoidageRule::largest_diameter_over_spacing);
  }
  void spread(const sdk::GridShape& grid, const sdk::VoidageBatch& b) const override {
    ask("spread", "the cells of every grain of the batch", &sdk::VoidageRule::spread, grid, b);
    const GuardReport::Inputs seen = {{"position.x", b.position.x},
                                      {"position.y", b.position.y},
                                      {"position.z", b.position.z},
                                      {"radius", b.radius}};
    for (std::size_t g = 0; g < b.count; ++g) {
      if (b.used[g] < 1 || b.used[g] > b.capacity) {
        faults().refuse("gives used = " + std::to_string(b.used[g]), g, b.count, seen,
                        "1 to " + std::to_string(b.capacity) + " cells, its capacity");
      }
      const double* weight = b.weight + g * static_cast<std::size_t>(b.capacity);
      double sum = 0.0;
      for (int n = 0; n < b.used[g]; ++n) {
        if (!base::is_finite(weight[n]))
          faults().refuse_number("weight", weight[n], g, b.count, seen);
        if (weight[n] < 0.0) {
          faults().refuse("gives weight = " + base::digits_text(weight[n], 6), g, b.count, seen,
                          "weights from 0 on");
        }
        sum += weight[n];
      }
      if (std::abs(sum - 1.0) > k_rounding) {
        faults().refuse("gives weights that sum to " + base::digits_text(sum, 6), g, b.count, seen,
                        "1: all of the grain's volume and no more");
      }
    }
  }
  [[nodiscard]] sdk::Vec3 reach(const sdk::GridShape& grid, double radius) const override {
    const sdk::Vec3 reach = get("reach", &sdk::VoidageRule::reach, grid, radius);
    for (int d = 0; d < 3; ++d) {
      if (reach[d] >= 0.0) continue;
      faults().refuse_answer("reach", reach[d], "lengths from 0 on along x, y and z");
    }
    return reach;
  }
};

class Boundary final : public Guarded<sdk::BoundaryCondition> {
 public:
  using Guarded::Guarded;
  [[nodiscard]] sdk::SideRules rules() const override {
    return get("rules", &sdk::BoundaryCondition::rules);
  }
  void evaluate(const sdk::SideBatch& b) const override {
    ask("evaluate", "values for every point of the batch", &sdk::BoundaryCondition::evaluate, b);
    const GuardReport::Inputs seen = {
        {"position.x", b.position.x}, {"position.y", b.position.y}, {"position.z", b.position.z}};
    const sdk::SideRules rules = model().rules();
    double* const velocity[3] = {b.velocity.x, b.velocity.y, b.velocity.z};
    const char* const names[3] = {"velocity.x", "velocity.y", "velocity.z"};
    for (int d = 0; d < 3; ++d) {
      const auto rule = b.normal[d] != 0.0 ? rules.normal_velocity : rules.tangential_velocity;
      if (rule == sdk::SideRule::fixed) faults().check(b.count, names[d], velocity[d], seen);
    }
    if (rules.pressure == sdk::SideRule::fixed || rules.pressure == sdk::SideRule::pressure) {
      faults().check(b.count, "pressure", b.pressure, seen);
    }
  }
  [[nodiscard]] bool needs_flow() const override {
    return get("needs_flow", &sdk::BoundaryCondition::needs_flow);
  }
};

class Turbulence final : public Guarded<sdk::TurbulenceModel> {
 public:
  using Guarded::Guarded;
  void evaluate(const sdk::TurbulenceBatch& b) const override {
    GuardReport::set_unwritten(b.count, b.eddy_viscosity);
    ask("evaluate", "an eddy viscosity for every cell of the batch",
        &sdk::TurbulenceModel::evaluate, b);
    faults().check(b.count, "eddy_viscosity", b.eddy_viscosity,
                   {{"strain_rate", b.strain_rate}, {"wall_distance", b.wall_distance}});
    check_not_negative(faults(), b.count, "eddy_viscosity", b.eddy_viscosity,
                       {{"strain_rate", b.strain_rate}, {"wall_distance", b.wall_distance}});
  }
};

class Liberation final : public Guarded<sdk::LiberationLaw> {
 public:
  using Guarded::Guarded;
  void prepare(const sdk::DustProperties& dust) override {
    ask("prepare", "classes of dust taken, or a ParameterError", &sdk::LiberationLaw::prepare,
        dust);
  }
  void in_contacts(const sdk::GrainImpacts& b) const override {
    set_unwritten(b.grains);
    ask("in_contacts", "what comes off each grain of the batch", &sdk::LiberationLaw::in_contacts,
        b);
    check(b.grains, {{"normal_energy", b.normal_energy},
                     {"tangential_energy", b.tangential_energy},
                     {"acceleration", b.acceleration}});
  }
  void in_wind(const sdk::GrainWind& b) const override {
    set_unwritten(b.grains);
    ask("in_wind", "what comes off each grain of the batch", &sdk::LiberationLaw::in_wind, b);
    check(b.grains, {{"slip", b.slip}, {"shear", b.shear}, {"void_fraction", b.void_fraction}});
  }
  [[nodiscard]] bool needs_wind() const override {
    return get("needs_wind", &sdk::LiberationLaw::needs_wind);
  }
  [[nodiscard]] bool uses_moisture() const override {
    return get("uses_moisture", &sdk::LiberationLaw::uses_moisture);
  }

 private:
  static void set_unwritten(const sdk::DustyGrains& g) {
    for (std::size_t k = 0; k < g.classes; ++k) {
      GuardReport::set_unwritten(g.count, g.released + k * g.stride);
    }
  }
  void check(const sdk::DustyGrains& g, GuardReport::Inputs seen) const {
    for (std::size_t k = 0; k < g.classes; ++k) {
      faults().check(g.count, "released", g.released + k * g.stride, seen);
    }
  }
};

class Emitter final : public Guarded<sdk::Emitter> {
 public:
  using Guarded::Guarded;
  void propose(const sdk::EmitterContext& context,
               std::vector<sdk::InsertionRequest>& requests) override {
    const std::size_t before = requests.size();
    ask("propose", "the grains of the interval", &sdk::Emitter::propose, context, requests);
    for (std::size_t n = before; n < requests.size(); ++n) {
      const sdk::InsertionRequest& s = requests[n];
      check(s, n - before, requests.size() - before);
      // An empty interval asks for what comes at that moment.
      if (s.time == context.begin || (s.time > context.begin && s.time < context.end)) continue;
      faults().refuse(
          "gives time = " + base::digits_text(s.time, 6), n - before, requests.size() - before, {},
          "a time from " + base::digits_text(context.begin, 6) + " s on and before " +
              base::digits_text(context.end, 6) + " s, the interval that it was asked for");
    }
  }
  [[nodiscard]] double requested_mass_flow() const override {
    return not_negative("requested_mass_flow", &sdk::Emitter::requested_mass_flow);
  }
  [[nodiscard]] std::vector<double> diameters() const override {
    std::vector<double> all = get("diameters", &sdk::Emitter::diameters);
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (base::is_finite(all[n]) && all[n] > 0.0 && (n == 0 || all[n] > all[n - 1])) continue;
      faults().refuse_answer("diameters", all[n], "diameters above 0, ascending");
    }
    return all;
  }
  [[nodiscard]] double largest_speed() const override {
    return not_negative("largest_speed", &sdk::Emitter::largest_speed);
  }
  [[nodiscard]] sdk::EmitterRequest request() const override {
    const sdk::EmitterRequest r = get("request", &sdk::Emitter::request);
    const std::pair<const char*, double> amounts[] = {
        {"request (mass_flow)", r.mass_flow},
        {"request (mass)", r.mass},
        {"request (count)", static_cast<double>(r.count)}};
    for (const auto& [name, value] : amounts) {
      if (base::is_finite(value) && value >= 0.0) continue;
      faults().refuse_answer(name, value, "a finite number from 0 on");
    }
    // A stream may go on for ever.
    if (!base::is_finite(r.begin)) {
      faults().refuse_answer("request (begin)", r.begin, "a time");
    }
    if (std::isnan(r.end)) faults().refuse_answer("request (end)", r.end, "a time, or infinity");
    return r;
  }
  [[nodiscard]] sdk::InsertionRule insertion_rule() const override {
    const sdk::InsertionRule rule = get("insertion_rule", &sdk::Emitter::insertion_rule);
    if (!(base::is_finite(rule.allowed_overlap) && rule.allowed_overlap >= 0.0)) {
      faults().refuse_answer("insertion_rule (allowed_overlap)", rule.allowed_overlap,
                             "a finite number from 0 on");
    }
    return rule;
  }
  [[nodiscard]] std::vector<std::string> materials() const override {
    return get("materials", &sdk::Emitter::materials);
  }

 private:
  /// What the core would not notice, or not tell as the emitter's fault.
  void check(const sdk::InsertionRequest& s, std::size_t row, std::size_t count) {
    const std::pair<const char*, double> numbers[] = {
        {"time", s.time},
        {"position", s.position.x + s.position.y + s.position.z},
        {"velocity", s.velocity.x + s.velocity.y + s.velocity.z},
        {"angular_velocity", s.angular_velocity.x + s.angular_velocity.y + s.angular_velocity.z},
        {"diameter", s.diameter},
        {"weight", s.weight}};
    for (const auto& [name, value] : numbers) {
      if (!base::is_finite(value)) faults().refuse_number(name, value, row, count, {});
    }
    if (!known_) known_ = Known{diameters(), materials().size()};
    // Steps, searches and levels are laid out for the sizes that were announced.
    constexpr double k_rounding = 1e-9;
    const double smallest = known_->diameters.empty() ? 0.0 : known_->diameters.front();
    const double largest = known_->diameters.empty() ? 0.0 : known_->diameters.back();
    if (!(s.diameter > 0.0 && s.diameter >= smallest * (1.0 - k_rounding) &&
          s.diameter <= largest * (1.0 + k_rounding))) {
      faults().refuse("gives diameter = " + base::digits_text(s.diameter, 6), row, count, {},
                      "one of its diameters(), which go from " + base::digits_text(smallest, 6) +
                          " to " + base::digits_text(largest, 6) + " m");
    }
    if (!(s.weight > 0.0)) {
      faults().refuse("gives weight = " + base::digits_text(s.weight, 6), row, count, {},
                      "a weight above 0");
    }
    if (s.material < -1 ||
        (s.material >= 0 && static_cast<std::size_t>(s.material) >= known_->materials)) {
      faults().refuse("gives material = " + std::to_string(s.material), row, count, {},
                      "an index into its " + std::to_string(known_->materials) +
                          " materials(), or -1 for the emitter's own");
    }
  }

  /// What it has announced.
  struct Known {
    std::vector<double> diameters;  ///< [m] ascending
    std::size_t materials = 0;
  };
  std::optional<Known> known_;
};

class Motion final : public Guarded<sdk::Motion> {
 public:
  using Guarded::Guarded;
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    for (double* column : {b.velocity.x, b.velocity.y, b.velocity.z}) {
      GuardReport::set_unwritten(b.count, column);
    }
    ask("surface_velocity", "a velocity for every point of the batch",
        &sdk::Motion::surface_velocity, b);
    const GuardReport::Inputs seen = {
        {"position.x", b.position.x}, {"position.y", b.position.y}, {"position.z", b.position.z}};
    faults().check(b.count, "velocity.x", b.velocity.x, seen);
    faults().check(b.count, "velocity.y", b.velocity.y, seen);
    faults().check(b.count, "velocity.z", b.velocity.z, seen);
  }
  [[nodiscard]] double largest_speed() const override {
    return not_negative("largest_speed", &sdk::Motion::largest_speed);
  }
  [[nodiscard]] bool moves_body() const override {
    return get("moves_body", &sdk::Motion::moves_body);
  }
  [[nodiscard]] sdk::RigidPose pose(double time) const override {
    const sdk::RigidPose p = ask("pose", "a place at every time", &sdk::Motion::pose, time);
    check(p, time);
    constexpr double k_rounding = 1e-9;
    if ((p.angle != 0.0 || p.angular_velocity != 0.0) &&
        std::abs(norm(p.axis) - 1.0) > k_rounding) {
      faults().refuse_answer("pose", norm(p.axis), "an axis of the length 1 of a pose that turns");
    }
    return p;
  }
  [[nodiscard]] double largest_angular_velocity() const override {
    return not_negative("largest_angular_velocity", &sdk::Motion::largest_angular_velocity);
  }

 private:
  /// Each number by itself: a sum would hide which of them it is.
  void check(const sdk::RigidPose& p, double time) const {
    const std::pair<const char*, sdk::Vec3> vectors[] = {
        {"shift", p.shift}, {"pivot", p.pivot}, {"axis", p.axis}, {"velocity", p.velocity}};
    for (const auto& [name, vector] : vectors) {
      for (int d = 0; d < 3; ++d) {
        if (base::is_finite(vector[d])) continue;
        refuse(std::string(name) + "." + "xyz"[d], vector[d], time);
      }
    }
    if (!base::is_finite(p.angle)) refuse("angle", p.angle, time);
    if (!base::is_finite(p.angular_velocity)) refuse("angular_velocity", p.angular_velocity, time);
  }
  [[noreturn]] void refuse(const std::string& name, double value, double time) const {
    faults().refuse_number(("pose (" + name + ")").c_str(), value, 0, 1, {{"time", &time}});
  }
};

/// Figures may be "no number yet"; their names and units are looked after, and what it throws.
class Sensor : public Guarded<sdk::Sensor> {
 public:
  using Guarded::Guarded;
  void observe(const sdk::WorldView& world) override {
    ask("observe", "a look at the world", &sdk::Sensor::observe, world);
  }
  void begin(const sdk::WorldView& world) override {
    ask("begin", "the world as it begins", &sdk::Sensor::begin, world);
  }
  [[nodiscard]] bool wants_contacts() const override {
    return get("wants_contacts", &sdk::Sensor::wants_contacts);
  }
  [[nodiscard]] bool wants_face_fluxes() const override {
    return get("wants_face_fluxes", &sdk::Sensor::wants_face_fluxes);
  }
  [[nodiscard]] bool wants_fluid() const override {
    return get("wants_fluid", &sdk::Sensor::wants_fluid);
  }
  [[nodiscard]] sdk::SurfacesWanted wanted_surfaces() const override {
    return get("wanted_surfaces", &sdk::Sensor::wanted_surfaces);
  }
  void series(sdk::FigureSink& sink) const override {
    CheckedFigures checked(sink);
    ask("series", "the columns of series.csv", &sdk::Sensor::series, checked);
    refuse_fault(checked, "series");
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view column) const override {
    return get("row_value", &sdk::Sensor::row_value, column);
  }
  void end_row() override { ask("end_row", "the beginning of another row", &sdk::Sensor::end_row); }
  void summary(sdk::FigureSink& sink) const override {
    CheckedFigures checked(sink);
    ask("summary", "the figures of summary.json", &sdk::Sensor::summary, checked);
    refuse_fault(checked, "summary");
  }
  void report(sdk::ReportSink& sink) const override {
    CheckedReport checked(sink);
    ask("report", "curves and rows of the report", &sdk::Sensor::report, checked);
    refuse_fault(checked, "report");
  }
  void fields(sdk::FieldSink& sink) const override {
    CheckedFields checked(sink);
    ask("fields", "the fields of a frame", &sdk::Sensor::fields, checked);
    refuse_fault(checked, "fields");
  }
  [[nodiscard]] bool wants_walls() const override {
    return get("wants_walls", &sdk::Sensor::wants_walls);
  }
  [[nodiscard]] bool wants_sliding() const override {
    return get("wants_sliding", &sdk::Sensor::wants_sliding);
  }

 private:
  void refuse_fault(const SinkFaults& checked, const char* asked) const {
    if (!checked.is_well()) faults().refuse_given(asked, checked.fault());
  }
};

/// A sensor that looks at airborne dust too.
class DustSensor final : public Sensor, public sdk::DustObserver {
 public:
  using Sensor::Sensor;
  void observe_dust(const sdk::WorldView& world, const sdk::DustColumns& dust) override {
    faults().call("observe_dust", "a look at the dust",
                  [&] { dynamic_cast<sdk::DustObserver&>(model()).observe_dust(world, dust); });
  }
};

template <class Guard>
std::unique_ptr<sdk::Model> make(std::unique_ptr<sdk::Model> model, GuardReport faults) {
  return std::make_unique<Guard>(std::move(model), std::move(faults));
}

}  // namespace

std::unique_ptr<sdk::Model> guarded(std::unique_ptr<sdk::Model> model, const Entry& entry,
                                    const std::string& place) {
  if (entry.info.kind == sdk::Sensor::k_kind &&
      dynamic_cast<sdk::DustObserver*>(model.get()) != nullptr) {
    return make<DustSensor>(std::move(model), GuardReport(entry, place));
  }
  using Make = std::unique_ptr<sdk::Model> (*)(std::unique_ptr<sdk::Model>, GuardReport);
  static const std::pair<const char*, Make> makers[] = {
      {sdk::ContactLaw::k_kind, make<Contact>},
      {sdk::RollingLaw::k_kind, make<Rolling>},
      {sdk::CohesionLaw::k_kind, make<Cohesion>},
      {sdk::DragLaw::k_kind, make<Drag>},
      {sdk::FluidForce::k_kind, make<FluidForce>},
      {sdk::VoidageRule::k_kind, make<Voidage>},
      {sdk::BoundaryCondition::k_kind, make<Boundary>},
      {sdk::TurbulenceModel::k_kind, make<Turbulence>},
      {sdk::LiberationLaw::k_kind, make<Liberation>},
      {sdk::Emitter::k_kind, make<Emitter>},
      {sdk::Motion::k_kind, make<Motion>},
      {sdk::Sensor::k_kind, make<Sensor>}};
  const auto found = std::find_if(std::begin(makers), std::end(makers),
                                  [&](const auto& m) { return entry.info.kind == m.first; });
  if (found == std::end(makers)) return model;
  return found->second(std::move(model), GuardReport(entry, place));
}

}  // namespace dust::registry
