// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/cohesion_law.hpp"
#include "dust/sdk/contact_law.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dust::particles {

/// The laws of one pair of materials; `rolling` and `cohesion` may be null.
struct PairLaws {
  int material_i = 0;
  int material_j = 0;
  std::unique_ptr<sdk::ContactLaw> contact;
  std::unique_ptr<sdk::RollingLaw> rolling;
  std::unique_ptr<sdk::CohesionLaw> cohesion;
  double range = 0.0;  ///< [m] range_of() the largest grains; set by the table

  /// How far beyond touch [m] contact and cohesion act on a pair of this R* [m].
  [[nodiscard]] double range_of(double effective_radius) const {
    const double touch = contact->range();
    return cohesion ? std::max(touch, cohesion->range(effective_radius)) : touch;
  }
  /// Numbers they keep per contact.
  [[nodiscard]] int history_size() const {
    return contact->history_size() + (rolling ? rolling->history_size() : 0) +
           (cohesion ? cohesion->history_size() : 0);
  }
};

/// The laws of all pairs of materials, by number.
class PairLawTable {
 public:
  /// Per contact, where its work is kept.
  static constexpr int k_work_columns = 2;
  /// How many numbers a contact has room for, of its laws and what is kept besides.
  [[nodiscard]] static int room();

  /// `largest_diameter` [m] of the particles that may come. Kept per contact besides the numbers of
  /// the laws: its work, with `keeps_work`, and `account_columns` of the energy account.
  PairLawTable(std::vector<PairLaws> laws, std::vector<std::string> material_names,
               double largest_diameter, bool keeps_work = false, int account_columns = 0);

  [[nodiscard]] std::size_t size() const { return laws_.size(); }
  [[nodiscard]] const PairLaws& operator[](std::size_t law) const { return laws_[law]; }
  [[nodiscard]] std::span<const PairLaws> all() const { return laws_; }
  /// The law between two materials; throws where none is declared.
  [[nodiscard]] std::int32_t index(int material_i, int material_j) const;
  [[nodiscard]] const std::string& material_name(int material) const {
    return material_names_[static_cast<std::size_t>(material)];
  }
  /// [m] beyond touch, of all laws.
  [[nodiscard]] double largest_range() const { return largest_range_; }
  /// Numbers kept per contact, a multiple of four.
  [[nodiscard]] std::size_t history_stride() const { return history_stride_; }
  /// The first of the two columns that hold work (find_dissipation): behind those of the laws.
  [[nodiscard]] std::size_t work_column() const { return work_column_; }
  /// The first of the account's columns.
  [[nodiscard]] int account_column() const { return account_column_; }

 private:
  std::size_t work_column_ = 0;
  int account_column_ = 0;
  std::vector<PairLaws> laws_;
  std::vector<std::string> material_names_;
  std::vector<std::int32_t> index_;  ///< by both materials; -1: none
  double largest_range_ = 0.0;
  std::size_t history_stride_ = 4;
};

}  // namespace dust::particles
