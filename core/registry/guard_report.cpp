// SPDX-License-Identifier: Apache-2.0
#include "registry/guard_report.hpp"

#include "base/text.hpp"

#include <cmath>

namespace dust::registry {
namespace {

std::string shown(double value) {
  return base::digits_text(std::isnan(value) ? std::abs(value) : value, 6);
}

}  // namespace

std::string identity_of(const Entry& entry) {
  return entry.info.kind + "/" + entry.info.name + " (" + entry.file.string() + ")";
}

GuardReport::GuardReport(const Entry& entry, const std::string& place)
    : who_(identity_of(entry)), place_(place) {}

void GuardReport::throw_fault(const std::string& fault) const {
  if (place_.empty()) throw sdk::ModelError(fault);
  throw PlacedFault(place_, fault);
}

void GuardReport::thrown(const char* function, const char* expected,
                         const std::string& what) const {
  throw_fault(who_ + " throws in " + function + ": " + what + "; expected: " + expected);
}

void GuardReport::refuse_number(const char* name, double value, std::size_t row, std::size_t count,
                                Inputs seen) const {
  refuse(std::string("gives ") + name + " = " + shown(value), row, count, seen, "a finite number");
}

void GuardReport::refuse(const std::string& what, std::size_t row, std::size_t count, Inputs seen,
                         const std::string& expected) const {
  std::string text = who_ + " " + what + " in row " + std::to_string(row + 1) + " of " +
                     std::to_string(count) + " of a batch";
  const char* before = " (";
  for (const auto& [name, column] : seen) {
    if (column == nullptr) continue;
    text += std::string(before) + name + " = " + shown(column[row]);
    before = ", ";
  }
  if (before[0] == ',') text += ")";
  throw_fault(text + "; expected: " + expected);
}

void GuardReport::refuse_answer(const char* question, double answer,
                                const std::string& expected) const {
  throw_fault(who_ + " answers " + shown(answer) + " to " + question + "; expected: " + expected);
}

void GuardReport::refuse_given(const char* asked, const std::string& fault) const {
  throw_fault(who_ + ", asked for " + asked + ", " + fault);
}

void GuardReport::refuse_made(bool is_nothing) const {
  throw_fault(who_ + (is_nothing ? " is made as nothing" : " is made as a model of another kind") +
              "; expected: an object of its kind from its factory");
}

}  // namespace dust::registry
