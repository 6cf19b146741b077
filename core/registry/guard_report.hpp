// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/finite.hpp"
#include "dust/sdk/error.hpp"
#include "registry/crash_notice.hpp"
#include "registry/registry.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace dust::registry {

/// "drag/rough (/x/rough.so)".
std::string identity_of(const Entry& entry);

/// A fault of a guarded model that knows where the scenario chooses it. Before the run that place
/// helps, during the run it is the time and the grain.
class PlacedFault : public sdk::ModelError {
 public:
  PlacedFault(const std::string& place, const std::string& fault)
      : sdk::ModelError(fault), line_(place + fault) {}
  /// "s.yaml:3:5: error: drag: drag/rough (/x/rough.so) ...".
  [[nodiscard]] const std::string& line() const { return line_; }

 private:
  std::string line_;
};

/// How a guarded model's faults are told: "drag/rough (/x/rough.so) ...; expected: ...".
class GuardReport {
 public:
  /// Columns of a batch that help to see why; null ones are left out.
  using Inputs = std::initializer_list<std::pair<const char*, const double*>>;

  explicit GuardReport(const Entry& entry, const std::string& place = {});
  [[nodiscard]] const std::string& who() const { return who_; }

  /// Calls and passes the answer on. ParameterErrors go through: they have a place in the scenario.
  template <class Call>
  std::invoke_result_t<Call> call(const char* function, const char* expected,
                                  const Call& call) const {
    const Asking asking(who_.c_str(), " was asked for ", function);
    try {
      return call();
    } catch (const sdk::ParameterError&) {
      throw;
    } catch (const std::exception& problem) {
      thrown(function, expected, problem.what());
    } catch (...) {
      thrown(function, expected, "something that is no std::exception");
    }
  }

  /// Before a batch: what the model leaves unwritten shall not look like an answer.
  static void set_unwritten(std::size_t count, double* column) {
    if (column != nullptr) std::fill_n(column, count, std::numeric_limits<double>::quiet_NaN());
  }
  /// Refuses the first number of a column that is none.
  void check(std::size_t count, const char* name, const double* column, Inputs seen) const {
    if (column == nullptr) return;
    const std::size_t bad = base::first_not_finite(column, count);
    if (bad < count) refuse_number(name, column[bad], bad, count, seen);
  }
  [[noreturn]] void refuse_number(const char* name, double value, std::size_t row,
                                  std::size_t count, Inputs seen) const;
  [[noreturn]] void refuse(const std::string& what, std::size_t row, std::size_t count, Inputs seen,
                           const std::string& expected) const;
  /// An answer outside what the core can work with.
  [[noreturn]] void refuse_answer(const char* question, double answer,
                                  const std::string& expected) const;
  /// What it gave when it was asked for something: `fault` is "gives ...; expected: ...".
  [[noreturn]] void refuse_given(const char* asked, const std::string& fault) const;
  /// A factory that gives nothing, or something of another kind.
  [[noreturn]] void refuse_made(bool is_nothing) const;

 private:
  [[noreturn]] void thrown(const char* function, const char* expected,
                           const std::string& what) const;
  [[noreturn]] void throw_fault(const std::string& fault) const;

  std::string who_;
  std::string place_;  ///< "s.yaml:3:5: error: drag: ", or empty
};

}  // namespace dust::registry
