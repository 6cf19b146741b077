// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// The leapfrog with drag integrated exactly between the kicks (Vyas et al., Comput. Phys. Commun.
/// 310 (2025) 109524, doi:10.1016/j.cpc.2025.109524), written once: for one particle (Vector is
/// sdk::Vec3, Number is double) and for vector registers (both are lanes::Lanes). With u the
/// target velocity of drag, k its rate, a the acceleration by all else and tau the time since the
/// last kick plus half a step; docs/theory/grains.md, eq. (6), (7):
///
/// \f$ v' = v E + u (1 - E) + a \phi \tau, \quad E = e^{-k \tau}, \quad
///     \phi = (1 - E) / (k \tau), \quad x' = x + \Delta t\, v' \f$
///
/// Results are written to references: the compiler warns of returned vectors that are wider than
/// the base of a kernel's clones, even where nothing is called.
namespace dust::particles::leapfrog {

/// What drag leaves of a velocity difference after some time, and on average over that time.
struct Relaxation {
  double decay = 1.0;  ///< E
  double mean = 1.0;   ///< phi
};

/// Of drag at a `rate` [1/s] over a `duration` [s].
inline Relaxation relaxation(double rate, double duration) {
  const double x = rate * duration;
  return {std::exp(-x), x > 0.0 ? -std::expm1(-x) / x : 1.0};
}

/// The kick. `push` is what it would be without drag: a tau.
template <class Vector, class Number>
__attribute__((always_inline)) inline void kick(const Vector& old, const Vector& push,
                                                const Vector& target, const Number& decay,
                                                const Number& mean, Vector& half) {
  half = old + (target - old) * (1.0 - decay) + push * mean;
}

/// The velocity for the next forces, predicted to the instant of the new positions by the change
/// of the kick. `ahead` [-]: what is left of the step after the kick, over the kick's duration,
/// times the decay where there is drag; docs/theory/grains.md, eq. (8).
template <class Vector, class Number>
__attribute__((always_inline)) inline void predict(const Vector& half, const Vector& old,
                                                   const Number& ahead, Vector& velocity) {
  velocity = half + ahead * (half - old);
}

/// The impulse [N s] received from drag, where all else has pushed by `push` [m/s].
template <class Vector, class Number>
__attribute__((always_inline)) inline void drag_impulse(const Vector& half, const Vector& old,
                                                        const Vector& push,
                                                        const Number& inverse_mass,
                                                        Vector& impulse) {
  impulse = (half - old - push) / inverse_mass;
}

/// The change of velocity by the first of many equal steps, for FreeFlight.
template <class Vector, class Number>
__attribute__((always_inline)) inline void first_change(const Vector& old, const Vector& push,
                                                        const Vector& target, const Number& decay,
                                                        const Number& mean, Vector& change) {
  change = (target - old) * (1.0 - decay) + push * mean;
}

/// `count` equal steps at once. With d the change of velocity by the first step, that of the next
/// one is E d. So, with G = 1 + E + ... + E^(count - 1) and H the sum of the first `count` G,
/// \f$ v_n = v + d G, \quad x_n = x + \Delta t\, (n v + d H) \f$; docs/theory/grains.md, eq. (14).
struct FreeFlight {
  double power = 1.0;  ///< E^count
  double g = 1.0;
  double h = 1.0;

  /// G, H and E^count come from doubling, bit by bit of `count` > 0: no root, exponential or
  /// difference of near numbers.
  __attribute__((always_inline)) static inline FreeFlight of(std::int64_t count, double decay) {
    FreeFlight f{.power = decay};
    const int highest = std::bit_width(static_cast<std::uint64_t>(count)) - 1;
    for (int bit = highest - 1; bit >= 0; --bit) {
      const auto m = static_cast<double>(count >> (bit + 1));
      f.h = f.h + m * f.g + f.power * f.h;
      f.g = f.g + f.power * f.g;
      f.power *= f.power;
      if (((count >> bit) & 1) != 0) {
        f.g = 1.0 + decay * f.g;
        f.h += f.g;
        f.power *= decay;
      }
    }
    return f;
  }
};

/// Of a solid sphere, I = 2/5 m R^2 [1/(kg m2)].
template <class Number>
__attribute__((always_inline)) inline void inverse_inertia(const Number& inverse_mass,
                                                           const Number& radius, Number& result) {
  result = 2.5 * inverse_mass / (radius * radius);
}

}  // namespace dust::particles::leapfrog
