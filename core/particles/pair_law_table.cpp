// SPDX-License-Identifier: Apache-2.0
#include "particles/pair_law_table.hpp"

#include "contact/batch.hpp"
#include "dust/sdk/error.hpp"

#include <utility>

namespace dust::particles {

int PairLawTable::room() { return contact::k_max_history; }

PairLawTable::PairLawTable(std::vector<PairLaws> laws, std::vector<std::string> material_names,
                           double largest_diameter, bool keeps_work, int account_columns)
    : laws_(std::move(laws)),
      material_names_(std::move(material_names)),
      index_(material_names_.size() * material_names_.size(), -1) {
  int columns = 0;
  for (std::size_t n = 0; n < laws_.size(); ++n) {
    PairLaws& law = laws_[n];
    const auto i = static_cast<std::size_t>(law.material_i);
    const auto j = static_cast<std::size_t>(law.material_j);
    index_[i * material_names_.size() + j] = index_[j * material_names_.size() + i] =
        static_cast<std::int32_t>(n);
    columns = std::max(columns, law.history_size());
    // R* is largest where the largest grain meets a wall.
    law.range = law.range_of(0.5 * largest_diameter);
    largest_range_ = std::max(largest_range_, law.range);
  }
  work_column_ = static_cast<std::size_t>(columns);
  if (keeps_work) columns += k_work_columns;
  account_column_ = columns;
  columns += account_columns;
  if (columns > contact::k_max_history) {
    throw sdk::ParameterError("contact, rolling and cohesion law" +
                              std::string(keeps_work ? " and what sets dust free" : "") +
                              (account_columns > 0 ? " and the energy account" : "") +
                              " together keep " + std::to_string(columns) +
                              " numbers per contact; at most " +
                              std::to_string(contact::k_max_history) + " are possible");
  }
  history_stride_ = static_cast<std::size_t>(std::max(4, (columns + 3) / 4 * 4));
}

std::int32_t PairLawTable::index(int material_i, int material_j) const {
  const auto i = static_cast<std::size_t>(material_i);
  const auto j = static_cast<std::size_t>(material_j);
  const std::int32_t law = index_[i * material_names_.size() + j];
  if (law < 0) {
    throw sdk::ModelError("no interaction between the materials " + material_names_[i] + " and " +
                          material_names_[j] + ": declare one under `interactions`");
  }
  return law;
}

}  // namespace dust::particles
