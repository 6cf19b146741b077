// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/emitter.hpp"
#include "dust/sdk/parameter_schema.hpp"

#include <string>
#include <vector>

namespace dust::sdk {

/// Emitters whose grains all come at one moment: the derived class says where, once.
///
/// The moment is the beginning of the fluid step in which `time` lies; at 0 the grains are there
/// before the first step. Where `time` is the end of a step but for rounding, it is the beginning
/// of the next. No grain waits for its place: one that is taken is an error.
class PlacedEmitter : public Emitter {
 public:
  void propose(const EmitterContext& context, std::vector<InsertionRequest>& requests) final {
    if (!(context.end > context.begin)) {
      check(context);
      return;
    }
    // Ends of steps are rounded: a moment that is one belongs to the step that begins there.
    const double rounding = k_step_rounding * (context.end - context.begin);
    if (is_done_ || !(time_ < context.end - rounding)) return;
    const std::size_t first = requests.size();
    place(context, requests);
    for (std::size_t n = first; n < requests.size(); ++n) requests[n].time = context.begin;
    is_done_ = true;
  }
  [[nodiscard]] double requested_mass_flow() const final { return 0.0; }
  [[nodiscard]] InsertionRule insertion_rule() const override { return {.waits = false}; }

  void save(ArchiveWriter& archive) const override { archive.integer("is_done", is_done_ ? 1 : 0); }
  void load(ArchiveReader& archive) override { is_done_ = archive.integer("is_done") != 0; }

 protected:
  explicit PlacedEmitter(double time) : time_(time) {}
  /// Appends all grains; called once. Throws ParameterError where that is impossible.
  virtual void place(const EmitterContext& context, std::vector<InsertionRequest>& requests) = 0;
  /// What can be told from the density alone, when a scenario is read.
  virtual void check(const EmitterContext&) const {}

 private:
  static constexpr double k_step_rounding = 1e-6;  ///< of an interval

  double time_;
  bool is_done_ = false;
};

/// Declares the moment; `Parameters` has a member `time`.
template <class P>
void declare_moment(SchemaOf<P>& s) {
  s.number(&P::time, "time", dimension::time, "When the grains appear; 0 = before the first step.")
      .at_least(0)
      .optional();
}

}  // namespace dust::sdk
