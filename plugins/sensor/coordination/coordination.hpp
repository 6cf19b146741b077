// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::model::coordination {

/// Means of the numbers of contacts of grains; no numbers where there are no grains for them.
struct Numbers {
  double mean = sdk::k_no_value;        ///< contacts per grain
  double mechanical = sdk::k_no_value;  ///< the same without grains that carry no load
  double rattlers = sdk::k_no_value;    ///< share of grains with fewer than two contacts
};

/// \f$ Z = \sum n_i / N \f$ and the mechanical coordination number of those that can carry a load,
/// \f$ Z_m = (\sum n_i - N_1) / (N - N_0 - N_1) \f$, with \f$ N_k \f$ the number of grains with k
/// contacts (Thornton, Geotechnique 50 (2000) 43, eq. 2, doi:10.1680/geot.2000.50.1.43).
/// @param contacts  numbers of contacts of each grain; walls count as one each
inline Numbers numbers_of(std::span<const std::int32_t> contacts) {
  Numbers out;
  double sum = 0.0;
  double none = 0.0;
  double one = 0.0;
  for (const std::int32_t n : contacts) {
    sum += n;
    none += n == 0 ? 1.0 : 0.0;
    one += n == 1 ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(contacts.size());
  if (!(count > 0.0)) return out;
  out.mean = sum / count;
  const double bearing = count - none - one;
  if (bearing > 0.0) out.mechanical = (sum - one) / bearing;
  out.rattlers = (none + one) / count;
  return out;
}

}  // namespace dust::model::coordination
